#include "document/change.h"

namespace tidemark::document {

bool is_of_labels(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::start:
    case ChangeKind::paint:
    case ChangeKind::erase:
    case ChangeKind::target:
    case ChangeKind::range:
    case ChangeKind::smoothing:
    case ChangeKind::parameters:
    case ChangeKind::evolution:
    case ChangeKind::step_back:
    case ChangeKind::restart:
    case ChangeKind::sweep:
    case ChangeKind::source:
    case ChangeKind::examples:
    case ChangeKind::constraints:
    case ChangeKind::speed:
      return false;
    case ChangeKind::new_label:
    case ChangeKind::label_settings:
    case ChangeKind::remove_label:
    case ChangeKind::import_labels:
    case ChangeKind::accept:
    case ChangeKind::finish:
    case ChangeKind::label_brush:
      return true;
  }
  return false;
}

std::string describe(const ChangeDescription& change) {
  const char* const plural = change.steps == 1 ? "" : "s";
  switch (change.kind) {
    case ChangeKind::start:
      return "start";
    case ChangeKind::paint:
      return "paint";
    case ChangeKind::erase:
      return "erase";
    case ChangeKind::target:
      return "T";
    case ChangeKind::range:
      return "range";
    case ChangeKind::smoothing:
      return "smoothing";
    case ChangeKind::parameters:
      return "parameters";
    case ChangeKind::evolution:
      return fmt::format("evolution, {} step{}", change.steps, plural);
    case ChangeKind::step_back:
      return fmt::format("{} step{} back", change.steps, plural);
    case ChangeKind::restart:
      return "restart";
    case ChangeKind::sweep:
      return fmt::format("run of a sweep, {} step{}", change.steps, plural);
    case ChangeKind::source:
      return "smoothing of the volume";
    case ChangeKind::examples:
      return "examples";
    case ChangeKind::constraints:
      return "walls and anchors";
    case ChangeKind::speed:
      return "speed function";
    case ChangeKind::new_label:
      return fmt::format("new label {}", change.name);
    case ChangeKind::label_settings:
      return fmt::format("settings of {}", change.name);
    case ChangeKind::remove_label:
      return fmt::format("remove {}", change.name);
    case ChangeKind::import_labels:
      return fmt::format("import of {}", change.name);
    case ChangeKind::accept:
      return fmt::format("accept into {}", change.name);
    case ChangeKind::finish:
      return fmt::format("finishing of {}", change.name);
    case ChangeKind::label_brush:
      return fmt::format("brush on {}", change.name);
  }
  return {};
}

}  // namespace tidemark::document
