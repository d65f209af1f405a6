// The virtual memory of the compute executor: tables and lists in buffers that its shaders change by
// themselves (resources/shaders/solver/compute/page_memory.glsl).
#pragma once

#include <cstdint>
#include <vector>

#include "gpu/buffer.h"
#include "solver/convergence.h"
#include "solver/field.h"
#include "solver/gl/packed_field.h"

namespace tidemark::solver {

// Work groups of a dispatch stand in rows of so many, as in page_memory.glsl.
inline constexpr std::uint32_t kGroupsPerRow = 32768;

// The layout of the shaders (std430).
struct ComputeControl {
  std::uint32_t active_groups[3];  // dispatch arguments
  std::uint32_t active_ready;
  std::uint32_t active_count;
  std::uint32_t steps_done;
  std::uint32_t starved;
  std::uint32_t converged;
  std::uint32_t stop_at_convergence;
  std::uint32_t free_head;
  std::uint32_t free_tail;
  std::uint32_t free_tail_ready;
  std::uint32_t voxel_updates[2];
  std::uint32_t quiet_pages;
  std::int32_t window;
  std::int32_t first_window;
  std::uint32_t moving_so_far;
  float speed_so_far;
  std::uint32_t moving_pages;
  float surface_speed;
  std::uint32_t step_ran;
  std::uint32_t list_is_rebuilt;
  std::uint32_t pages_wanted;

  [[nodiscard]] std::int64_t free_pages() const { return free_tail - free_head; }
};
static_assert(sizeof(ComputeControl) == 96);

struct ComputePageState {
  std::uint32_t flags;
  std::uint32_t code;
  std::uint32_t constant_steps;
  std::uint32_t samples;
  std::uint32_t near_voxels;
  float change;
  float content;
  float anchor;
  std::int32_t since = -1;
  std::int32_t moved = -1;

  [[nodiscard]] bool is_asleep() const { return (flags & 1U) != 0; }
};
static_assert(sizeof(ComputePageState) == 40);

class PageMemory {
 public:
  PageMemory() = default;
  // Holds `phi`, every resident page active. Room for `capacity` physical pages at least. Fails
  // (ErrorKind::capability) when it does not fit.
  static Result<PageMemory> create(gpu::Device& device, const PackedLayout& layout, const Field& phi,
                                   std::int64_t capacity);

  // Room for more pages, by copy; `control` is the present one, before and after. On failure all is as
  // before.
  Status grow(gpu::Device& device, std::int64_t capacity, ComputeControl& control);

  // Makes `phi` what the given buffer holds. Waits for the GPU.
  Status download(int buffer, Field& phi) const;
  // The tables agree both ways, used and free pages make up the capacity, and no page is there twice.
  Status validate() const;

  [[nodiscard]] const PackedField& field() const { return field_; }
  [[nodiscard]] const gpu::Buffer& page_table() const { return page_table_; }
  // The virtual pages that are resident, and those of them that are quiet. Waits for the GPU.
  [[nodiscard]] std::vector<std::int64_t> resident_pages() const;
  [[nodiscard]] std::vector<std::int64_t> sleeping_pages() const;
  // Those in which the surface moved in the last full window. Waits for the GPU.
  [[nodiscard]] std::vector<std::int64_t> moving_pages(const RestRule& rule) const;
  [[nodiscard]] const gpu::Buffer& control() const { return control_; }
  [[nodiscard]] ComputeControl read_control() const;
  void write_control(const ComputeControl& control);

  // Binds the tables and lists where the shaders expect them.
  void bind() const;

  [[nodiscard]] std::int64_t capacity() const { return field_.capacity(); }
  // Bytes that so many pages need, tables and lists included.
  [[nodiscard]] static std::int64_t bytes_for(const PackedLayout& layout, std::int64_t capacity);

 private:
  template <class Wanted>
  [[nodiscard]] std::vector<std::int64_t> pages_where(Wanted wanted) const;
  Status allocate_lists(gpu::Device& device, std::int64_t capacity);
  void list_free_pages(const std::vector<std::int32_t>& pages, ComputeControl& control);
  [[nodiscard]] std::vector<std::int32_t> free_pages(const ComputeControl& control) const;

  PackedField field_;
  gpu::Buffer page_table_;
  gpu::Buffer inverse_table_;
  gpu::Buffer states_;
  gpu::Buffer active_list_;
  gpu::Buffer free_list_;
  gpu::Buffer control_;
};

}  // namespace tidemark::solver
