// Lines that follow edges from one place of a slice to another (Mortensen and Barrett 1998, "livewire").
#pragma once

#include <cstdint>
#include <memory>
#include <queue>
#include <vector>

#include "core/volume.h"
#include "engine/slice_slab.h"

namespace tidemark::engine {

// Of all ways between two voxels of the slice, the one of least cost: its length, where each piece counts the
// less the steeper the source is there.
class Livewire {
 public:
  // How far a way may go from where it begins, in voxels along either axis of the slice.
  static constexpr std::int64_t kReach = 128;

  // The source must have the slab's grid.
  Livewire(SliceSlab slab, std::shared_ptr<const Volume> source);

  // Places are points of the slice (LPS, mm).
  void begin_at(glm::dvec3 place_mm);
  // From the place where it began to that one, without the first and with the last. Beyond kReach a straight
  // line goes on.
  [[nodiscard]] std::vector<glm::dvec3> way_to(glm::dvec3 place_mm);

 private:
  struct Step {
    double cost = 0.0;
    std::int64_t voxel = 0;
    bool operator>(const Step& other) const { return cost > other.cost; }
  };
  [[nodiscard]] std::int64_t at(std::int64_t u, std::int64_t v) const {
    return (v - low_v_) * width_ + u - low_u_;
  }
  [[nodiscard]] std::vector<float> values() const;
  void find_resistances();
  void search(std::int64_t target);

  SliceSlab slab_;
  std::shared_ptr<const Volume> source_;
  std::int64_t low_u_ = 0;  // of the window that is searched
  std::int64_t low_v_ = 0;
  std::int64_t width_ = 0;
  std::int64_t height_ = 0;
  std::vector<float> resistances_;  // of the window's voxels: the cost of a way of length 1
  std::vector<double> costs_;       // from where it began, the least so far
  std::vector<std::int64_t> before_;
  std::vector<bool> is_final_;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open_;
};

}  // namespace tidemark::engine
