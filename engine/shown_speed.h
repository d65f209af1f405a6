// The speed function that views of a case show.
#pragma once

#include <functional>
#include <memory>

#include "core/result.h"
#include "solver/field.h"
#include "solver/speed/speed_function.h"

namespace tidemark::engine {

// An executor asks for the function of its phi only when it steps; at rest D is to be seen as well.
class ShownSpeed {
 public:
  using Speed = std::shared_ptr<const solver::SpeedFunction>;
  using ReadPhi = std::function<Result<std::shared_ptr<const solver::Field>>()>;

  // `driving` drives the executor (null: the tent); at rest, one that follows the surface is shown as it
  // follows the phi that `read_phi` gives. Returns whether views must be drawn anew for it. Fails as
  // `read_phi` does.
  Result<bool> follow(const Speed& driving, bool rests, const ReadPhi& read_phi);
  [[nodiscard]] const Speed& function() const { return function_; }  // null: the tent

 private:
  Speed driving_;
  std::shared_ptr<const solver::Field> phi_;  // that it follows
  Speed function_;
};

}  // namespace tidemark::engine
