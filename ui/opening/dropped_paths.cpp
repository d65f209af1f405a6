#include "ui/opening/dropped_paths.h"

#include <QUrl>

namespace tidemark::ui {

QStringList dropped_paths(const QMimeData& data) {
  QStringList paths;
  for (const QUrl& url : data.urls()) {
    if (url.isLocalFile()) paths.push_back(url.toLocalFile());
  }
  return paths;
}

}  // namespace tidemark::ui
