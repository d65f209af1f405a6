// The paths of dragged files and folders from outside, and of series from the browser.
#pragma once

#include <QMimeData>
#include <QString>
#include <QStringList>
#include <optional>

namespace tidemark::ui {

inline constexpr char kSeriesMimeType[] = "application/x-tidemark-series";

// The folders and files of this machine among the URLs; empty when there are none.
QStringList dropped_paths(const QMimeData& data);

// A series that is dragged from the browser to a view.
struct DraggedSeries {
  QString path;  // StudyLoader::place_of()
  QString uid;
};
void put_series(QMimeData& data, const DraggedSeries& series);
std::optional<DraggedSeries> dropped_series(const QMimeData& data);

}  // namespace tidemark::ui
