#include "ui/opening/dropped_paths.h"

#include <QDataStream>
#include <QIODevice>
#include <QUrl>

namespace tidemark::ui {

QStringList dropped_paths(const QMimeData& data) {
  QStringList paths;
  for (const QUrl& url : data.urls()) {
    if (url.isLocalFile()) paths.push_back(url.toLocalFile());
  }
  return paths;
}

void put_series(QMimeData& data, const DraggedSeries& series) {
  QByteArray bytes;
  QDataStream stream(&bytes, QIODevice::WriteOnly);
  stream.setVersion(QDataStream::Qt_6_4);
  stream << series.path << series.uid;
  data.setData(kSeriesMimeType, bytes);
}

std::optional<DraggedSeries> dropped_series(const QMimeData& data) {
  QDataStream stream(data.data(kSeriesMimeType));
  stream.setVersion(QDataStream::Qt_6_4);
  DraggedSeries series;
  stream >> series.path >> series.uid;
  if (stream.status() != QDataStream::Ok || series.path.isEmpty()) return std::nullopt;
  return series;
}

}  // namespace tidemark::ui
