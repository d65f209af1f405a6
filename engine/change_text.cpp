#include "engine/change_text.h"

#include <QCoreApplication>

namespace tidemark::engine {

QString change_text(const document::ChangeDescription& change) {
  const auto tr = [](const char* text, int count = -1) {
    return QCoreApplication::translate("Change", text, nullptr, count);
  };
  const int steps = static_cast<int>(change.steps);
  const QString name = QString::fromStdString(change.name);
  switch (change.kind) {
    case document::ChangeKind::start:
      return tr("placing the surface");
    case document::ChangeKind::paint:
      return tr("paint");
    case document::ChangeKind::erase:
      return tr("erase");
    case document::ChangeKind::target:
      return tr("change of T");
    case document::ChangeKind::range:
      return tr("change of ε");
    case document::ChangeKind::smoothing:
      return tr("change of α");
    case document::ChangeKind::parameters:
      return tr("change of parameters");
    case document::ChangeKind::evolution:
      return tr("evolution, %n steps", steps);
    case document::ChangeKind::step_back:
      return tr("%n steps back", steps);
    case document::ChangeKind::restart:
      return tr("restart");
    case document::ChangeKind::sweep:
      return tr("run of a sweep, %n steps", steps);
    case document::ChangeKind::source:
      return tr("smoothing of the source");
    case document::ChangeKind::examples:
      return tr("examples");
    case document::ChangeKind::constraints:
      return tr("walls and anchors");
    case document::ChangeKind::speed:
      return tr("change of the speed function");
    case document::ChangeKind::new_label:
      return tr("new label %1").arg(name);
    case document::ChangeKind::label_settings:
      return tr("settings of label %1").arg(name);
    case document::ChangeKind::remove_label:
      return tr("removal of label %1").arg(name);
    case document::ChangeKind::import_labels:
      return tr("import of %1").arg(name);
    case document::ChangeKind::accept:
      return tr("accept into %1").arg(name);
    case document::ChangeKind::finish:
      return tr("finishing of %1").arg(name);
    case document::ChangeKind::label_brush:
      return tr("brush on %1").arg(name);
  }
  return {};
}

}  // namespace tidemark::engine
