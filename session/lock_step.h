// Cases that play together: always at the same step.
#pragma once

#include <memory>
#include <vector>

#include "core/progress.h"

namespace tidemark {

class CaseRunner;

// Belongs to the engine's thread. A case that joins behind the others catches up first; those that are ahead
// wait for it.
class LockStep : public std::enable_shared_from_this<LockStep> {
 public:
  void add(const std::shared_ptr<CaseRunner>& runner);

  // A turn of `runner`: computes as many steps as take it to where the group goes next, none when it is there
  // already and others are not.
  Status advance(CaseRunner& runner, const Progress& progress);
  // What one does, all do.
  void set_playing(bool playing);

 private:
  [[nodiscard]] std::vector<std::shared_ptr<CaseRunner>> members();
  std::vector<std::weak_ptr<CaseRunner>> members_;
};

}  // namespace tidemark
