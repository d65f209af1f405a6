// The level set for pictures: phi's packed pages and their page table on the GPU.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "gpu/draw.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "solver/field.h"
#include "solver/gl/packed_field.h"
#include "solver/gl/packed_view.h"
#include "solver/paging/paged_memory.h"

namespace tidemark::renderer {

// A copy of phi that follows a level set computed elsewhere: only pages that changed since the last picture
// go up, through one buffer and one draw that scatters them to their places.
class PhiPicture {
 public:
  PhiPicture() = default;
  static Result<PhiPicture> create(gpu::Device& device, const PageLayout& layout, double band);

  // `phi` has the layout and the band of create(). `quiet`: virtual pages that are not computed at present.
  // Fails (ErrorKind::capability) when memory is short; the picture of phi is then undefined until the
  // next call that succeeds.
  Status update(gpu::Device& device, const solver::Field& phi, std::span<const std::int64_t> quiet);

  // Draws from an executor's own memory from now on; to be called again after each run of steps. With `quiet`
  // the page table is read back, so that pictures of pages are right. The view has the
  // layout and the band of create().
  Status look_at(gpu::Device& device, const solver::PackedView& view,
                 const std::optional<std::vector<std::int64_t>>& quiet);

  // The uniforms of solver/phi.glsl and render/page_state.glsl, on three units from `unit`.
  void set_uniforms(const gpu::Program& program, int unit) const;

  [[nodiscard]] const solver::PackedLayout& layout() const { return field_.layout(); }
  // The physical page of each virtual one; of an executor's memory, read back.
  [[nodiscard]] std::vector<solver::PhysicalPage> page_entries() const;
  [[nodiscard]] double band() const { return band_; }
  [[nodiscard]] std::int64_t pages_uploaded() const { return pages_uploaded_; }  // by the last update
  // Physical memory G, packed like an executor's.
  [[nodiscard]] const solver::PackedField& field() const { return field_; }
  [[nodiscard]] const solver::PagedMemory<3>& pages() const { return pages_; }

 private:
  // A buffer and the texture that shaders see it through.
  struct Array {
    gpu::Buffer buffer;
    gpu::BufferTexture texture;
    static Result<Array> create(gpu::Device& device, std::int64_t texels, gpu::TexelFormat format,
                                std::string_view label);
  };
  struct Change {
    std::int64_t page;  // virtual
    solver::PhysicalPage physical;
  };

  std::vector<Change> follow(const solver::Field& phi);
  Status upload(gpu::Device& device, const solver::Field& phi, std::span<const Change> changes);
  void upload_tables(std::span<const std::int64_t> quiet);
  void upload_flags(std::span<const std::int64_t> quiet, std::int64_t resident);

  solver::PagedMemory<3> pages_;
  double band_ = 0.0;
  std::optional<SharedPages> shown_;  // what is on the GPU; unset: that is not known
  solver::PackedField field_;
  Array page_table_;
  Array page_flags_;
  std::vector<std::int64_t> new_pages_;
  gpu::Program scatter_;
  gpu::VertexArray vertices_;
  std::int64_t most_staged_ = 0;  // pages that one draw can scatter
  std::int64_t pages_uploaded_ = 0;

  struct Viewed {
    solver::PackedView view;
    gpu::BufferTexture table;
    std::vector<solver::PhysicalPage> entries;  // when pages were last asked after
  };
  std::optional<Viewed> viewed_;
};

}  // namespace tidemark::renderer
