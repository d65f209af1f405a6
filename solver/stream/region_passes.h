// The render passes over the pages of a list, sub-region by sub-region, in pooled intermediate buffers (paper
// sections 4.3 to 4.5).
#pragma once

#include <array>
#include <vector>

#include "gpu/framebuffer.h"
#include "solver/gl/drive_textures.h"
#include "solver/stream/geometry_engine.h"
#include "solver/stream/page_message.h"
#include "solver/stream/physical_memory.h"

namespace tidemark::solver {

struct PassRecord;

class RegionPasses {
 public:
  // Pages of the largest sub-region: 512 x 512 texels, as in the paper. Where the processor plays the GPU,
  // buffers that stay in its cache are a fifth faster.
  static constexpr std::int64_t kLargestRegion = 1024;
  static constexpr std::int64_t kLargestRegionInCache = 128;
  // Pages whose messages are made at a time, from buffers with a texel for 16 voxels.
  static constexpr std::int64_t kLargestMessage = 16384;

  RegionPasses() = default;
  // `largest_region` in pages, rounded up to a whole row of places.
  static Result<RegionPasses> create(gpu::Device& device, const GeometryEngine& geometry,
                                     const DriveTextures& drive, const Model& model,
                                     std::int64_t largest_region);
  // Makes the variants of the passes that the model and what drives the surface need, if they are others.
  Status compile_step(gpu::Device& device, const GeometryEngine& geometry, const DriveTextures& drive,
                      const Model& model);
  // Buffers for a list of so many pages. Fails (ErrorKind::capability) when memory is short.
  Status reserve(gpu::Device& device, std::int64_t pages);

  // One step of phi in all pages of the list: reads phi from buffer `now`, writes the other one.
  void step(const GeometryEngine& geometry, const PhysicalMemory& memory, const DriveTextures& drive,
            const StepConstants<float>& constants, int now, bool measure_motion) const;
  // The messages of the pages of the list, about phi in the given buffer. Waits for the GPU.
  Result<std::vector<PageMessage>> message(const GeometryEngine& geometry, const PhysicalMemory& memory,
                                           int buffer, float band, float quiet_change);

  // Of the first page of a list that is one sub-region: the buffers that step() and message() have left.
  Status read_first_page(PassRecord& record) const;

  // The pages of the list: both buffers become `value`, and their motion 0.
  void fill(const GeometryEngine& geometry, const PhysicalMemory& memory, float value) const;
  // ... the other buffer becomes equal to `now`.
  void copy(const GeometryEngine& geometry, const PhysicalMemory& memory, int now) const;
  // ... both buffers are combined with `values`, 256 a page: the larger or the smaller remains.
  Status paint(gpu::Device& device, const GeometryEngine& geometry, const PhysicalMemory& memory,
               std::span<const float> values, gpu::Blending blending) const;

 private:
  struct Region {
    std::int64_t first;
    std::int64_t count;
  };
  [[nodiscard]] static std::vector<Region> regions(std::int64_t pages, std::int64_t largest);
  static void draw_into_memory(const gpu::Program& program, const GeometryEngine& geometry, Region region,
                               const PhysicalMemory& memory, PhysicalMemory::Target target);
  [[nodiscard]] glm::ivec2 size() const { return {upwind_.width(), upwind_.height()}; }

  struct Pooled {
    gpu::Texture2D& texture;
    gpu::TexelFormat format;
    std::int64_t divisor;
    bool mipmaps;
    const char* label;
  };
  static std::int64_t pool_size(std::int64_t pages, std::int64_t largest, std::int64_t present);
  static Status make_pool(gpu::Device& device, std::int64_t pages, std::initializer_list<Pooled> textures);
  Status reserve_message(gpu::Device& device, std::int64_t pages);

  // Uses a program, and sets its sizes of texels.
  void use(const gpu::Program& program, const PhysicalMemory& memory) const;
  void differentiate(const GeometryEngine& geometry, const PhysicalMemory& memory,
                     const StepConstants<float>& constants, int now, bool measure_motion,
                     Region region) const;
  void compute_speeds(const GeometryEngine& geometry, const PhysicalMemory& memory,
                      const DriveTextures& drive, const StepConstants<float>& constants, Region region) const;
  void update(const GeometryEngine& geometry, const PhysicalMemory& memory, const DriveTextures& drive,
              const StepConstants<float>& constants, int next, Region region) const;
  void add_motion(const GeometryEngine& geometry, const PhysicalMemory& memory,
                  const StepConstants<float>& constants, int next, Region region) const;
  void note_neighbours(const GeometryEngine& geometry, const PhysicalMemory& memory, int buffer, float band,
                       Region region) const;
  void encode(const GeometryEngine& geometry, const PhysicalMemory& memory, float quiet_change,
              Region region);
  Result<std::vector<PageMessage>> read_message(std::int64_t pages) const;

  std::int64_t largest_region_ = kLargestRegion;
  gpu::Defines step_defines_;                // of the programs of a step
  std::array<gpu::Program, 3> derivatives_;  // interior, edges, corners
  gpu::Program speeds_, update_, motion_blocks_, motion_pages_, neighbours_, page_message_;
  gpu::Program fill_, fill_points_, copy_, paint_;

  // Of the pools of a step and of the message, in pages.
  std::int64_t capacity_ = 0;
  std::int64_t message_capacity_ = 0;
  gpu::Texture2D upwind_, central_, second_, mixed_, speed_terms_, blocks_, in_slice_, slices_, message_;
  gpu::Framebuffer differences_target_, speeds_target_, blocks_target_, neighbours_target_, message_target_;
};

}  // namespace tidemark::solver
