// Cases that play together: always at the same step.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/progress.h"

namespace tidemark::engine {

class CaseRunner;

// Belongs to the engine's thread. A case that joins behind the others catches up first; those that are ahead
// wait for it. One that does not play is not waited for.
class LockStep : public std::enable_shared_from_this<LockStep> {
 public:
  void add(const std::shared_ptr<CaseRunner>& runner);
  void remove(const CaseRunner& runner);

  // A turn of `runner`: computes the steps up to the group's next goal, none when it is there already and
  // others are not.
  Status advance(CaseRunner& runner, const Progress& progress);
  // A command to one is a command to all. Cases that played pause at the same step.
  void set_playing(bool playing);
  void set_pace(double steps_per_second);
  // Whether a surface waits for the speed function that is to drive it.
  [[nodiscard]] bool any_holds_steps();
  // Pauses all that have begun, and takes each so many steps further; none while one of them holds its steps.
  Status step(std::int64_t steps, const Progress& progress);

 private:
  using Members = std::vector<std::shared_ptr<CaseRunner>>;
  [[nodiscard]] Members members();
  [[nodiscard]] Members players();
  void complete_leap();

  std::vector<std::weak_ptr<CaseRunner>> members_;
  std::int64_t leap_ = 0;  // steps by which the first of them last went ahead
};

}  // namespace tidemark::engine
