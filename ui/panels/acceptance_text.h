// Sentences on what became of voxels that a label was to take.
#pragma once

#include <QString>
#include <QStringList>

#include "document/labels.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {

inline QString acceptance_text(const document::Acceptance& acceptance) {
  QStringList sentences{tr("%1 took %2 voxels.", nullptr, form_of(acceptance.added))
                            .arg(QString::fromStdString(acceptance.label), count_text(acceptance.added))};
  if (acceptance.given_up > 0)
    sentences << tr("It gave up %1 voxels.", nullptr, form_of(acceptance.given_up))
                     .arg(count_text(acceptance.given_up));
  if (!acceptance.kept.empty())
    sentences << tr("It is a label of its own, as %1 has no voxel in common with the surface.")
                     .arg(QString::fromStdString(acceptance.kept));
  if (acceptance.from_others > 0)
    sentences << tr("%1 of them had another label.", nullptr, form_of(acceptance.from_others))
                     .arg(count_text(acceptance.from_others));
  if (acceptance.left > 0)
    sentences << tr("%1 voxels stayed with other labels.", nullptr, form_of(acceptance.left))
                     .arg(count_text(acceptance.left));
  return sentences.join(u' ');
}

}  // namespace tidemark::ui
