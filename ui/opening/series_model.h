// The series of a catalogue as a table.
#pragma once

#include <QAbstractTableModel>
#include <QPixmap>
#include <map>
#include <memory>
#include <vector>

#include "engine/series_preview.h"
#include "imaging/series.h"

namespace tidemark::ui {

// Loadable series come first, the largest on top. A picture is made when its row is first painted.
class SeriesModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { kSeries, kPatient, kModality, kDate, kSize, kSpacing, kFrame, kFiles, kNotes, kColumns };
  static constexpr int kSortRole = Qt::UserRole;
  static constexpr int kPreviewSize = 64;  // in points, wide and high

  explicit SeriesModel(QObject* parent = nullptr);

  void show(std::shared_ptr<const imaging::Catalogue> catalogue, double device_pixel_ratio);
  [[nodiscard]] const imaging::Series& series(int row) const { return *rows_[static_cast<std::size_t>(row)]; }

  // Whether several series are known to lie on one frame of reference.
  [[nodiscard]] bool has_shared_frames() const { return !shared_frames_.empty(); }

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
  [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 private:
  [[nodiscard]] QString text(const imaging::Series& series, int column) const;
  [[nodiscard]] QVariant sort_key(const imaging::Series& series, int column) const;
  [[nodiscard]] QString frame_letter(const imaging::Series& series) const;
  [[nodiscard]] QPixmap preview(int row) const;
  void keep(int row, const QImage& picture);
  [[nodiscard]] QPixmap frame(const QImage& picture) const;

  std::shared_ptr<const imaging::Catalogue> catalogue_;
  std::vector<const imaging::Series*> rows_;
  std::vector<std::string> shared_frames_;  // the UIDs of frames that several rows share: A, B, ...
  double device_pixel_ratio_ = 1.0;
  engine::SeriesPreviews* previews_;
  mutable std::map<int, QPixmap> pictures_;  // an empty frame from when it was asked for
};

}  // namespace tidemark::ui
