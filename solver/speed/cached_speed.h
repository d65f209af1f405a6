// A cache before a speed function that takes long to evaluate. Executors, views and the GPU read the same
// quantised D from it.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/paging/page_layout.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// D in [-1, 1] as q / kSpeedSteps.
inline constexpr double kSpeedSteps = 32767.0;
[[nodiscard]] std::int16_t quantised_speed(double speed);
[[nodiscard]] inline double speed_of(std::int16_t quantised) {
  return quantised / kSpeedSteps;
}

// Writes D of the box's voxels, quantised: from its pages where the function is a CachedSpeed.
void evaluate_quantised(const SpeedFunction& function, const VoxelBox& box, std::int16_t* speed);

// A function that follows the surface and changes with it in places alone.
class LocallyFollowing {
 public:
  virtual ~LocallyFollowing() = default;
  // Whether D of the box has the same bits as that of the function that this one followed.
  [[nodiscard]] virtual bool is_as_before(const VoxelBox& box) const = 0;
};

// Keeps D by pages of 8^3 voxels, two bytes a voxel that was asked for. A page is evaluated once, also when
// several threads ask for it. Boxes that take little of each page, as slices do, are answered from pages that
// are there; the rest of them is evaluated anew each time, quantised in the same way.
class CachedSpeed final : public SpeedFunction {
 public:
  static constexpr int kPageVoxels = 512;

  // A function whose D is in [-1, 1], on a grid of that size.
  CachedSpeed(std::shared_ptr<const SpeedFunction> function, Index3 grid_size);
  ~CachedSpeed() override;
  CachedSpeed(const CachedSpeed&) = delete;
  CachedSpeed& operator=(const CachedSpeed&) = delete;

  void evaluate(const VoxelBox& box, double* speed) const override;
  void evaluate_once(const VoxelBox& box, double* speed) const override;
  // The same before it is divided by kSpeedSteps.
  void quantised(const VoxelBox& box, std::int16_t* speed) const;

  [[nodiscard]] bool advects() const override { return function_->advects(); }
  void evaluate_advection(const VoxelBox& box, glm::vec3* velocity) const override {
    function_->evaluate_advection(box, velocity);
  }
  [[nodiscard]] double fastest_advection() const override { return function_->fastest_advection(); }

  [[nodiscard]] bool has_doubt() const override { return function_->has_doubt(); }
  void evaluate_doubt(const VoxelBox& box, double* doubt) const override {
    function_->evaluate_doubt(box, doubt);
  }

  // The function that follows has a cache of its own, with what is there of pages that are as before.
  [[nodiscard]] bool follows_surface() const override { return function_->follows_surface(); }
  [[nodiscard]] std::shared_ptr<const SpeedFunction> following(const Field& phi) const override;

  [[nodiscard]] std::int64_t memory() const;  // bytes
  [[nodiscard]] const SpeedFunction& function() const { return *function_; }

 private:
  struct Page;

  void take_over(const CachedSpeed& former, const LocallyFollowing& function);
  [[nodiscard]] VoxelBox box_of(Index3 page) const;
  [[nodiscard]] std::atomic<Page*>& entry(Index3 page) const;
  // What is there; null while it is missing or being evaluated.
  [[nodiscard]] const Page* ready(Index3 page) const;
  // The same, once a thread that has claimed the page is done; null when it failed.
  [[nodiscard]] const Page* waited_for(Index3 page) const;
  // Whether this thread is the one that has to evaluate the page.
  [[nodiscard]] bool claim(Index3 page) const;
  // Whether a box takes so much of a page that all of it is evaluated and kept.
  [[nodiscard]] bool takes_most(const VoxelBox& box, Index3 page) const;
  [[nodiscard]] bool is_mostly_missing(const VoxelBox& box) const;

  void evaluate_pages(Index3 first, std::int64_t count) const;
  // For the pages of a box from `first` along x.
  void evaluate_what_is_missing(const VoxelBox& box, Index3 first, std::int64_t end_x) const;
  void answer(const VoxelBox& box, Index3 first, std::int64_t end_x, std::int16_t* speed) const;

  std::shared_ptr<const SpeedFunction> function_;
  PageLayout layout_;
  mutable std::vector<std::atomic<Page*>> pages_;
  mutable std::atomic<std::int64_t> kept_pages_{0};
};

}  // namespace tidemark::solver
