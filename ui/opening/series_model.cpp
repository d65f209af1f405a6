#include "ui/opening/series_model.h"

#include <QApplication>
#include <QIcon>
#include <QPainter>
#include <QPalette>
#include <QStyle>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "engine/message_text.h"
#include "engine/study_loader.h"
#include "ui/opening/grid_text.h"

namespace tidemark::ui {
namespace {

const QVariant kAlignment = QVariant::fromValue(Qt::Alignment(Qt::AlignLeft | Qt::AlignVCenter));
constexpr int kIconPixels = 64;  // enough for every scale; the painter chooses the size

bool has_grid(const imaging::Series& series) {
  return series.geometry.voxel_count() > 0;
}

QString notes_text(const imaging::Series& series) {
  if (series.fillable()) return SeriesModel::tr("Irregular slices");
  if (!series.loadable) return SeriesModel::tr("Cannot be loaded");
  const auto warnings = static_cast<int>(series.warnings.size());
  const auto changes = static_cast<int>(series.changes.size());
  if (warnings > 0) return SeriesModel::tr("%n warnings", nullptr, warnings);
  if (changes > 0) return SeriesModel::tr("%n changes", nullptr, changes);
  return SeriesModel::tr("Ready");
}

// Worse is larger.
int severity(const imaging::Series& series) {
  if (series.fillable()) return 2;
  if (!series.loadable) return 3;
  if (!series.warnings.empty()) return 2;
  return series.changes.empty() ? 0 : 1;
}

// An icon that selecting its row does not colour.
QIcon untinted(const QPixmap& pixmap) {
  QIcon icon(pixmap);
  icon.addPixmap(pixmap, QIcon::Selected);
  return icon;
}

QIcon notes_icon(const imaging::Series& series) {
  constexpr QStyle::StandardPixmap kIcons[] = {QStyle::SP_DialogApplyButton, QStyle::SP_MessageBoxInformation,
                                               QStyle::SP_MessageBoxWarning, QStyle::SP_MessageBoxCritical};
  const QIcon icon = QApplication::style()->standardIcon(kIcons[severity(series)]);
  return untinted(icon.pixmap(kIconPixels));
}

}  // namespace

SeriesModel::SeriesModel(QObject* parent)
    : QAbstractTableModel(parent), previews_(new engine::SeriesPreviews(this)) {
  connect(previews_, &engine::SeriesPreviews::made, this, &SeriesModel::keep);
}

void SeriesModel::show(std::shared_ptr<const imaging::Catalogue> catalogue, double device_pixel_ratio) {
  beginResetModel();
  previews_->forget();
  pictures_.clear();
  rows_.clear();
  device_pixel_ratio_ = device_pixel_ratio;
  catalogue_ = std::move(catalogue);
  for (const imaging::Series& series : catalogue_->series) rows_.push_back(&series);
  std::stable_sort(rows_.begin(), rows_.end(), [](const imaging::Series* a, const imaging::Series* b) {
    const auto rank = [](const imaging::Series& series) {
      return std::tuple(series.loadable, series.fillable(), series.geometry.voxel_count());
    };
    return rank(*a) > rank(*b);
  });
  shared_frames_.clear();
  for (const imaging::Series* series : rows_) {
    const std::string& frame = series->frame_of_reference_uid;
    const bool is_known =
        std::find(shared_frames_.begin(), shared_frames_.end(), frame) != shared_frames_.end();
    if (!is_known && !catalogue_->on_the_frame_of(*series).empty()) shared_frames_.push_back(frame);
  }
  endResetModel();
}

int SeriesModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(rows_.size());
}

int SeriesModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : kColumns;
}

// A, B, ..., Z, then numbers; empty where no other series lies on the frame.
QString SeriesModel::frame_letter(const imaging::Series& series) const {
  constexpr auto kLetters = 26;
  const auto found = std::find(shared_frames_.begin(), shared_frames_.end(), series.frame_of_reference_uid);
  if (found == shared_frames_.end()) return {};
  const auto index = static_cast<int>(found - shared_frames_.begin());
  return index < kLetters ? QString(QChar('A' + index)) : QString::number(index + 1);
}

QString SeriesModel::text(const imaging::Series& series, int column) const {
  switch (column) {
    case kSeries:
      return engine::StudyLoader::name_of(series);
    case kPatient:
      return QString::fromStdString(series.patient.name);
    case kModality:
      return QString::fromStdString(series.modality);
    case kDate:
      return QString::fromStdString(series.date);
    case kSize:
      return has_grid(series) ? size_text(series.geometry) : QString();
    case kSpacing:
      return has_grid(series) ? spacing_text(series.geometry) : QString();
    case kFrame:
      return frame_letter(series);
    case kFiles:
      return QString::number(series.files.size());
    default:
      return notes_text(series);
  }
}

QVariant SeriesModel::sort_key(const imaging::Series& series, int column) const {
  switch (column) {
    case kSize:
      return static_cast<qlonglong>(series.geometry.voxel_count());
    case kSpacing: {
      const glm::dvec3& spacing = series.geometry.spacing_mm;
      return has_grid(series) ? spacing.x * spacing.y * spacing.z : 0.0;
    }
    case kFiles:
      return static_cast<qlonglong>(series.files.size());
    case kNotes:
      return severity(series);
    default:
      return text(series, column);
  }
}

QVariant SeriesModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const imaging::Series& one = series(index.row());
  switch (role) {
    case Qt::DisplayRole:
      return text(one, index.column());
    case kSortRole:
      return sort_key(one, index.column());
    case Qt::DecorationRole:
      if (index.column() == kSeries) return untinted(preview(index.row()));
      return index.column() == kNotes ? QVariant(notes_icon(one)) : QVariant();
    case Qt::ForegroundRole:
      if (one.loadable || one.fillable() || index.column() == kNotes) return {};
      return QApplication::palette().brush(QPalette::Disabled, QPalette::Text);
    case Qt::ToolTipRole:
      return one.loadable ? QVariant() : QVariant(engine::message_text(one.reason));
    case Qt::TextAlignmentRole:
      return kAlignment;
    default:
      return {};
  }
}

QVariant SeriesModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (role == Qt::TextAlignmentRole) return kAlignment;
  if (role == Qt::ToolTipRole && section == kFrame) {
    return tr("Series with the same letter share a frame of reference: they lie in place on one another");
  }
  if (role != Qt::DisplayRole) return {};
  const QString titles[kColumns] = {tr("Series"), tr("Patient"), tr("Modality"),
                                    tr("Date"),   tr("Voxels"),  tr("Spacing (mm)"),
                                    tr("Frame"),  tr("Files"),   tr("Notes")};
  return titles[section];
}

QPixmap SeriesModel::preview(int row) const {
  const auto known = pictures_.find(row);
  if (known != pictures_.end()) return known->second;
  const imaging::Series& one = series(row);
  if (one.loadable) {
    previews_->request(row, one, static_cast<int>(std::ceil(kPreviewSize * device_pixel_ratio_)));
  }
  return pictures_.emplace(row, frame({})).first->second;
}

void SeriesModel::keep(int row, const QImage& picture) {
  pictures_[row] = frame(picture);
  const QModelIndex changed = index(row, kSeries);
  emit dataChanged(changed, changed, {Qt::DecorationRole});
}

// The picture in the middle of a black square, as films are; without one a faint square.
QPixmap SeriesModel::frame(const QImage& picture) const {
  const int side = static_cast<int>(std::ceil(kPreviewSize * device_pixel_ratio_));
  QPixmap square(side, side);
  if (picture.isNull()) {
    QColor faint = QApplication::palette().color(QPalette::Text);
    faint.setAlphaF(0.08F);
    square.fill(Qt::transparent);
    QPainter(&square).fillRect(square.rect(), faint);
  } else {
    square.fill(Qt::black);
    QPainter(&square).drawImage((side - picture.width()) / 2, (side - picture.height()) / 2, picture);
  }
  square.setDevicePixelRatio(device_pixel_ratio_);
  return square;
}

}  // namespace tidemark::ui
