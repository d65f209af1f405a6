#include "engine/change_text.h"

#include <QCoreApplication>

namespace tidemark {

QString change_text(const ChangeDescription& change) {
  const auto tr = [](const char* text) { return QCoreApplication::translate("Change", text); };
  const QString name = QString::fromStdString(change.name);
  switch (change.kind) {
    case ChangeKind::start:
      return tr("placing the surface");
    case ChangeKind::paint:
      return tr("paint");
    case ChangeKind::erase:
      return tr("erase");
    case ChangeKind::target:
      return tr("change of T");
    case ChangeKind::range:
      return tr("change of ε");
    case ChangeKind::smoothing:
      return tr("change of α");
    case ChangeKind::parameters:
      return tr("change of parameters");
    case ChangeKind::evolution:
      return tr("evolution, %1 steps").arg(change.steps);
    case ChangeKind::step_back:
      return tr("%1 steps back").arg(change.steps);
    case ChangeKind::restart:
      return tr("restart");
    case ChangeKind::source:
      return tr("smoothing of the source");
    case ChangeKind::new_label:
      return tr("new label %1").arg(name);
    case ChangeKind::label_settings:
      return tr("settings of label %1").arg(name);
    case ChangeKind::remove_label:
      return tr("removal of label %1").arg(name);
    case ChangeKind::import_labels:
      return tr("import of %1").arg(name);
    case ChangeKind::accept:
      return tr("accept into %1").arg(name);
  }
  return {};
}

}  // namespace tidemark
