// The implementations that are compared, behind one interface.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "bench/peers/problem.h"
#include "solver/executor.h"

namespace tidemark::bench {

// Threads for everything that can use more than one.
inline constexpr int kThreads = 2;

// The cost of a number of steps. Zero where a contestant does not count it.
struct Cost {
  std::int64_t steps = 0;  // fewer than asked for when the contestant has ended by itself
  double seconds = 0.0;
  std::int64_t voxel_updates = 0;
  double paging_seconds = 0.0;
};

// A level set that evolves a problem from its start. Each calls its own set-up in its constructor.
class Contestant {
 public:
  Contestant() = default;
  virtual ~Contestant() = default;
  Contestant(const Contestant&) = delete;
  Contestant& operator=(const Contestant&) = delete;

  // Computes the next steps.
  virtual Result<Cost> advance(std::int64_t steps) = 0;
  // The voxels inside. ITK's filters end with it: no step can follow.
  virtual Mask finish() = 0;
  // What is resident; null where nothing of the kind exists.
  [[nodiscard]] virtual const solver::Executor* executor() const { return nullptr; }
};

// A run from the start to where the contestant's own criterion stops it.
struct Convergence {
  std::int64_t steps = 0;
  bool converged = false;
  double seconds = 0.0;  // wall time from the source in memory to the mask, set-up included
  Mask result;
};

struct ContestantKind {
  std::string name;         // for --only and JSON
  std::string description;  // its name and its threads
  // Empty: takes part in runs to convergence alone.
  std::function<Result<std::unique_ptr<Contestant>>(const Problem&)> make;
  std::function<Result<Convergence>(const Problem&)> converge;  // empty: has no criterion of its own
};

// ITK's criterion: the root mean square change of phi over the active layer in a step.
inline constexpr double kItkMaximumRmsError = 0.02;
// No run to convergence takes longer than this.
inline constexpr std::int64_t kMostSteps = 5000;

ContestantKind itk_threshold();
ContestantKind itk_parallel_sparse();
ContestantKind openvdb_tracker();
ContestantKind dense_stencil();
// The host executor; users get it with skip_quiet_pages.
ContestantKind tidemark_host(bool skip_quiet_pages);
// The same coarse to fine, for runs to convergence alone.
ContestantKind tidemark_levels();

// All of them, ours last.
std::vector<ContestantKind> all_contestants();

}  // namespace tidemark::bench
