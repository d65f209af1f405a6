#include "engine/shown_speed.h"

#include <utility>

namespace tidemark::engine {

Result<bool> ShownSpeed::follow(const Speed& driving, bool rests, const ReadPhi& read_phi) {
  if (!rests || driving == nullptr || !driving->follows_surface()) {
    phi_ = nullptr;
    driving_ = function_ = driving;
    return false;
  }
  auto phi = read_phi();
  if (!phi) return pass_on(phi);
  if (driving_ == driving && phi_ == *phi) return false;
  auto following = driving->following(**phi);
  driving_ = driving;
  phi_ = std::move(*phi);
  function_ = following != nullptr ? following : driving;
  return true;
}

}  // namespace tidemark::engine
