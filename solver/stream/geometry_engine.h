// Pages as geometry (paper sections 3.3 and 3.4): drawing it makes a fragment for each voxel, with the
// addresses that it reads.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/draw.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "solver/gl/packed_layout.h"
#include "solver/paging/paged_memory.h"

namespace tidemark::solver {

// The ways to draw pages. The first three are the nine substreams: inner texels, four edges, four corners;
// their fragments find their neighbours' pages in the same places relative to their own.
enum class Substream { interior, edges, corners, whole_page, blocks, page_point };

// A list of pages in a form that the vertex stage reads: for each page the addresses of its own and of 18
// neighbouring physical pages. Pages are drawn in runs of the list, with one call for all pages of a run.
class GeometryEngine {
 public:
  // Pages lie side by side in the intermediate buffers and in the message.
  static constexpr std::int64_t kPlacesPerRow = 32;
  static constexpr std::int64_t kPageSide = 16;

  GeometryEngine() = default;
  static GeometryEngine create(gpu::Device& device, const PackedLayout& layout);

  // Replaces the list. Fails (ErrorKind::capability) when memory is short.
  Status describe(gpu::Device& device, const PagedMemory<3>& memory, std::span<const PhysicalPage> pages);

  // Draws `count` pages of the list from `first` on into a framebuffer of that size, with a program made for
  // the substream and in use; textures are bound from unit 1 on.
  void draw(const gpu::Program& program, Substream substream, std::int64_t first, std::int64_t count,
            glm::ivec2 target_size) const;

  [[nodiscard]] std::int64_t size() const { return size_; }
  // Voxels inside the volume that the pages of the list hold.
  [[nodiscard]] std::int64_t voxels() const { return voxels_; }
  [[nodiscard]] std::int64_t bytes() const { return buffer_.bytes(); }
  [[nodiscard]] static std::int64_t bytes_for(std::int64_t pages);

  // The vertex shader of a substream and its defines.
  [[nodiscard]] static const char* vertex_shader(Substream substream);
  [[nodiscard]] gpu::Defines defines(Substream substream) const;

 private:
  void append(const PagedMemory<3>& memory, PhysicalPage page);
  [[nodiscard]] std::int32_t address(PhysicalPage page) const;

  PackedLayout layout_;
  gpu::VertexArray vertices_;
  gpu::Buffer buffer_;
  gpu::BufferTexture records_;
  std::vector<std::int32_t> staging_;
  std::int64_t size_ = 0;
  std::int64_t voxels_ = 0;
};

}  // namespace tidemark::solver
