#include "solver/speed/speed_kinds.h"
#include "solver/speed/tent_speed.h"

namespace tidemark::solver {
namespace {

Result<std::shared_ptr<const SpeedFunction>> make_tent(const SpeedInputs& inputs,
                                                       const std::map<std::string, double>& /*values*/,
                                                       const Progress& /*progress*/) {
  return std::make_shared<TentSpeed>(inputs.source, inputs.parameters);
}

}  // namespace

const SpeedKind& tent_kind() {
  static const SpeedKind kind{
      .name = "tent",
      .title = "Brightness",
      .text = "Grows where the brightness differs from T by less than epsilon, and shrinks elsewhere.",
      .make = make_tent,
      .cached = false};
  return kind;
}

}  // namespace tidemark::solver
