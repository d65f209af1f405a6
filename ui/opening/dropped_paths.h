// The paths of dragged files and folders from outside.
#pragma once

#include <QMimeData>
#include <QStringList>

namespace tidemark::ui {

// The folders and files of this machine among the URLs; empty when there are none.
QStringList dropped_paths(const QMimeData& data);

}  // namespace tidemark::ui
