// The canvas of a picture: a texture, filled in pieces so that nobody waits long for the GPU.
#pragma once

#include "core/progress.h"
#include "gpu/draw.h"
#include "gpu/framebuffer.h"
#include "gpu/texture.h"
#include "renderer/picture.h"

namespace tidemark::renderer {

// The cost of drawing a picture.
struct DrawReport {
  double seconds = 0.0;          // in all
  double prepare_seconds = 0.0;  // of these, until the driver had compiled what it needs
  double longest_piece_seconds = 0.0;
  std::int64_t pieces = 0;
};

// On a processor that plays the GPU, contexts share one rasteriser, which finishes one draw before the next:
// pieces are small enough to take less than kLongestPiece each. A GPU gets the whole picture at
// once.
class Canvas {
 public:
  static constexpr double kLongestPiece = 0.020;  // seconds
  // What a piece is to take leaves room for the next one to be harder.
  static constexpr double kWantedPiece = 0.3 * kLongestPiece;

  Canvas() = default;
  // `filter`: for reading its texture between texels.
  static Result<Canvas> create(gpu::Device& device, PictureSize size, gpu::TexelFormat format,
                               gpu::Filter filter = gpu::Filter::nearest);

  [[nodiscard]] PictureSize size() const { return {colour_.width(), colour_.height()}; }
  [[nodiscard]] const gpu::Texture2D& colour() const { return colour_; }

  // Draws a triangle over the picture with the program in use; without blending the old picture is lost.
  // Fails (ErrorKind::cancelled) between two pieces on a request to stop.
  Status fill(gpu::Device& device, const Progress& progress, gpu::Blending blending = gpu::Blending::replace);
  // Waits for the GPU.
  Result<Picture> read() const;
  [[nodiscard]] const DrawReport& report() const { return report_; }

 private:
  gpu::Texture2D colour_;
  gpu::Framebuffer framebuffer_;
  gpu::VertexArray vertices_;
  DrawReport report_;
};

}  // namespace tidemark::renderer
