#include "renderer/gl/canvas.h"

#include <algorithm>
#include <cmath>

#include "core/stopwatch.h"

namespace tidemark::renderer {
namespace {

// The rasteriser's threads take squares of 64 pixels; two of them side by side keep two processors busy.
constexpr std::int64_t kPieceColumns = 128;
// Few rows at most, as behind an empty row a hard one may come.
constexpr std::int64_t kLeastRows = 4;
constexpr std::int64_t kMostRows = 16;

}  // namespace

Result<Canvas> Canvas::create(gpu::Device& device, PictureSize size, gpu::TexelFormat format,
                              gpu::Filter filter) {
  Canvas canvas;
  auto colour = gpu::Texture2D::create(device, format, size.width, size.height, "picture");
  if (!colour) return pass_on(colour);
  canvas.colour_ = std::move(*colour);
  canvas.colour_.set_filter(filter);
  auto framebuffer = gpu::Framebuffer::create(device, {&canvas.colour_}, "picture");
  if (!framebuffer) return pass_on(framebuffer);
  canvas.framebuffer_ = std::move(*framebuffer);
  canvas.vertices_ = gpu::VertexArray::create(device);
  // A picture replaces the one before by blending: what is multiplied by 0 must be numbers.
  canvas.framebuffer_.bind();
  gpu::begin_exact_drawing();
  gpu::clear_colours(1);
  return canvas;
}

Status Canvas::fill(gpu::Device& device, const Progress& progress, gpu::Blending blending) {
  framebuffer_.bind();
  vertices_.bind();
  gpu::begin_exact_drawing();
  report_ = {};
  const Stopwatch whole;
  // Also where nothing is blended: without, llvmpipe compiles two functions, one for blocks of pixels that
  // are covered in full.
  const gpu::BlendScope blend(blending);
  if (!device.capabilities().software) {
    gpu::draw(gpu::Primitive::triangles, 3);
    report_.pieces = 1;
    report_.longest_piece_seconds = report_.seconds = whole.seconds();
    return device.check("drawing a picture");
  }
  gpu::prepare_draw();
  report_.prepare_seconds = whole.seconds();
  const auto [width, height] = size();
  // Begins with little: the cost of this picture is not known.
  std::int64_t wanted_rows = kLeastRows;
  for (std::int64_t top = 0; top < height;) {
    const std::int64_t rows = std::min(wanted_rows, height - top);
    double longest = 0.0;
    for (std::int64_t left = 0; left < width; left += kPieceColumns) {
      if (progress.cancelled()) return cancelled_error();
      const Stopwatch piece;
      const gpu::ScissorScope scissor({left, top, std::min(kPieceColumns, width - left), rows});
      gpu::draw(gpu::Primitive::triangles, 3);
      TIDEMARK_TRY(gpu::Fence::insert(device).wait());
      longest = std::max(longest, piece.seconds());
      ++report_.pieces;
    }
    report_.longest_piece_seconds = std::max(report_.longest_piece_seconds, longest);
    top += rows;
    progress(static_cast<double>(top) / static_cast<double>(height), "drawing");
    const double wanted =
        static_cast<double>(rows) * std::clamp(kWantedPiece / std::max(longest, 1e-6), 0.1, 1.5);
    wanted_rows = std::clamp(static_cast<std::int64_t>(std::ceil(wanted)), kLeastRows, kMostRows);
  }
  report_.seconds = whole.seconds();
  return device.check("drawing a picture");
}

Result<Picture> Canvas::read() const {
  const auto [width, height] = size();
  Picture picture{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(4 * width * height))};
  TIDEMARK_TRY(colour_.download({0, 0, width, height}, std::as_writable_bytes(std::span(picture.pixels))));
  // OpenGL's rows begin at the bottom.
  const std::int64_t row = 4 * width;
  for (std::int64_t y = 0; y < height / 2; ++y) {
    std::swap_ranges(picture.pixels.begin() + y * row, picture.pixels.begin() + (y + 1) * row,
                     picture.pixels.begin() + (height - 1 - y) * row);
  }
  return picture;
}

}  // namespace tidemark::renderer
