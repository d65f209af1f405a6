// G of the stream executor: the packed field, its framebuffers, and each physical page's motion.
#pragma once

#include <array>

#include "gpu/framebuffer.h"
#include "solver/gl/packed_field.h"

namespace tidemark::solver {

// The motion of a page in a window of steps: a texel.
struct PageMotion {
  float change = 0.0F;  // the sum of the largest changes beside the surface (StepConstants::near)
  float content = 0.0F;
  float near_voxels = 0.0F;
  float samples = 0.0F;  // of these two, as PageContent has them
};

class PhysicalMemory {
 public:
  PhysicalMemory() = default;
  // Fails (ErrorKind::capability) when it does not fit.
  static Result<PhysicalMemory> create(gpu::Device& device, const PackedLayout& layout, std::int64_t capacity,
                                       float band);
  // By copy. On failure it is as before.
  Status grow(gpu::Device& device, std::int64_t capacity);

  [[nodiscard]] PackedField& field() { return field_; }
  [[nodiscard]] const PackedField& field() const { return field_; }
  [[nodiscard]] std::int64_t capacity() const { return field_.capacity(); }
  // Of a layer.
  [[nodiscard]] glm::ivec2 size() const { return {field_.phi(0).width(), field_.phi(0).height()}; }
  [[nodiscard]] std::int64_t layers() const { return field_.phi(0).layers(); }

  // Drawing goes to a layer of one texture of phi, of both, to the motion (a texel a page).
  enum class Target { first, second, both };
  [[nodiscard]] static Target target(int buffer) { return buffer == 0 ? Target::first : Target::second; }
  void draw_into(Target target, std::int64_t layer) const {
    layers_[static_cast<std::size_t>(layer)].targets[static_cast<std::size_t>(target)].bind();
  }
  void draw_into_motion() const { motion_target_.bind(); }
  [[nodiscard]] const gpu::Texture2D& motion() const { return motion_; }
  [[nodiscard]] glm::ivec2 motion_size() const { return {motion_.width(), motion_.height()}; }
  // By physical page. Waits for the GPU.
  [[nodiscard]] Result<std::vector<PageMotion>> read_motion() const;

  // Of one page. They wait for the GPU.
  [[nodiscard]] Result<std::vector<float>> read_page(PhysicalPage page, int buffer) const;
  [[nodiscard]] Result<PageMotion> read_motion(PhysicalPage page) const;

  // What a step writes: phi of some pages in a buffer, and their motion.
  struct Kept {
    std::vector<PhysicalPage> pages;
    std::vector<std::vector<float>> phi;
    std::vector<PageMotion> motion;
  };
  [[nodiscard]] Result<Kept> keep(std::span<const PhysicalPage> pages, int buffer) const;
  void put_back(const Kept& kept, int buffer);

  // Bytes of so many pages.
  [[nodiscard]] static std::int64_t bytes_for(const PackedLayout& layout, std::int64_t capacity);

 private:
  struct Motion {
    gpu::Texture2D texture;
    gpu::Framebuffer target;
  };
  static Result<Motion> make_motion(gpu::Device& device, const PackedLayout& layout, std::int64_t capacity);
  Status make_targets(gpu::Device& device);
  [[nodiscard]] gpu::TexelRect motion_texel(PhysicalPage page) const;

  PackedField field_;
  gpu::Texture2D motion_;
  struct Layer {
    std::array<gpu::Framebuffer, 3> targets;
  };
  std::vector<Layer> layers_;
  gpu::Framebuffer motion_target_;
};

}  // namespace tidemark::solver
