// The equation over the whole volume: what a program without a narrow band computes.
#include <algorithm>
#include <chrono>

#include "bench/peers/contestants.h"
#include "bench/peers/dense_kernel.h"
#include "core/thread_pool.h"

#include "solver/speed/tent_speed.h"

namespace tidemark::bench {
namespace {

class DenseStencil final : public Contestant {
 public:
  explicit DenseStencil(const Problem& problem)
      : geometry_(problem.source->geometry),
        tent_(problem.source, problem.parameters),
        model_(geometry_, problem.parameters, tent_),
        constants_(model_.constants<float>()),
        pool_(kThreads) {
    row_ = kDenseMargin + geometry_.size.x + kDenseMargin;
    slice_ = row_ * (geometry_.size.y + 2);
    const auto count = static_cast<std::size_t>(slice_ * (geometry_.size.z + 2));
    data_.resize(count);
    for (auto& phi : phi_) phi.resize(count);
    std::vector<double> speed(static_cast<std::size_t>(geometry_.voxel_count()));
    tent_.evaluate({Index3(0), geometry_.size}, speed.data());
    const auto constants = model_.constants<double>();
    const double weight = constants.time_step * constants.data_weight;
    copy_in({speed.begin(), speed.end()}, data_);
    std::transform(data_.begin(), data_.end(), data_.begin(),
                   [&](float value) { return static_cast<float>(weight * double{value}); });
    copy_in(start_distance(problem, model_.band()), phi_[0]);
    repeat_border(phi_[0]);
  }

  Result<Cost> advance(std::int64_t steps) override {
    const auto start = std::chrono::steady_clock::now();
    for (std::int64_t i = 0; i < steps; ++i) step();
    Cost cost;
    cost.steps = steps;
    cost.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    cost.voxel_updates = steps * geometry_.voxel_count();
    return cost;
  }

  Mask finish() override {
    Mask mask{geometry_, std::vector<std::uint8_t>(static_cast<std::size_t>(geometry_.voxel_count()))};
    for_each_row([&](std::int64_t y, std::int64_t z) {
      const float* from = phi_[0].data() + at(0, y, z);
      std::uint8_t* to = mask.voxels.data() + geometry_.offset({0, y, z});
      for (std::int64_t x = 0; x < geometry_.size.x; ++x) to[x] = from[x] > 0.0F ? 1 : 0;
    });
    return mask;
  }

 private:
  [[nodiscard]] std::int64_t at(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return x + kDenseMargin + (y + 1) * row_ + (z + 1) * slice_;
  }

  template <class Visit>
  void for_each_row(Visit visit) const {
    for (std::int64_t z = 0; z < geometry_.size.z; ++z) {
      for (std::int64_t y = 0; y < geometry_.size.y; ++y) visit(y, z);
    }
  }

  void copy_in(const std::vector<float>& from, std::vector<float>& to) const {
    for_each_row([&](std::int64_t y, std::int64_t z) {
      std::copy_n(from.data() + geometry_.offset({0, y, z}), geometry_.size.x, to.data() + at(0, y, z));
    });
  }

  // Neumann: the voxels around the volume repeat its outermost ones.
  void repeat_border(std::vector<float>& phi) const {
    const Index3 size = geometry_.size;
    for_each_row([&](std::int64_t y, std::int64_t z) {
      float* row = phi.data() + at(0, y, z);
      row[-1] = row[0];
      std::fill_n(row + size.x, kDenseMargin, row[size.x - 1]);
    });
    for (std::int64_t z = 0; z < size.z; ++z) {
      float* first = phi.data() + at(0, 0, z) - kDenseMargin;
      std::copy_n(first, row_, first - row_);
      std::copy_n(first + (size.y - 1) * row_, row_, first + size.y * row_);
    }
    std::copy_n(phi.data() + slice_, slice_, phi.data());
    std::copy_n(phi.data() + size.z * slice_, slice_, phi.data() + (size.z + 1) * slice_);
  }

  // Pieces of rows and slices that stay in the second-level cache.
  void step() {
    constexpr std::int64_t kRows = 32;
    constexpr std::int64_t kSlices = 16;
    const Index3 size = geometry_.size;
    const DenseStep work{phi_[0].data() + at(0, 0, 0),
                         data_.data() + at(0, 0, 0),
                         phi_[1].data() + at(0, 0, 0),
                         row_,
                         slice_,
                         size.x,
                         &constants_};
    const std::int64_t across = (size.y + kRows - 1) / kRows;
    const std::int64_t deep = (size.z + kSlices - 1) / kSlices;
    pool_.for_each(across * deep, 1, [&](std::int64_t first, std::int64_t last, int) {
      for (std::int64_t piece = first; piece < last; ++piece) {
        const Index3 begin(0, piece % across * kRows, piece / across * kSlices);
        const Index3 end(size.x, std::min(begin.y + kRows, size.y), std::min(begin.z + kSlices, size.z));
        step_dense(work, begin, end);
      }
    });
    phi_[0].swap(phi_[1]);
    repeat_border(phi_[0]);
  }

  Geometry geometry_;
  solver::TentSpeed tent_;
  solver::Model model_;
  solver::StepConstants<float> constants_;
  ThreadPool pool_;
  std::int64_t row_ = 0;
  std::int64_t slice_ = 0;
  std::vector<float> data_;
  std::vector<float> phi_[2];
};

}  // namespace

ContestantKind dense_stencil() {
  ContestantKind kind;
  kind.name = "dense";
  kind.description = "dense stencil, whole volume, 2 threads";
  kind.make = [](const Problem& problem) -> Result<std::unique_ptr<Contestant>> {
    return std::make_unique<DenseStencil>(problem);
  };
  return kind;
}

}  // namespace tidemark::bench
