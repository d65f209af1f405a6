#include "ui/panels/labels_model.h"

#include <QColor>
#include <QIcon>

#include "ui/look/icons.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr int kLongestName = 64;  // characters, as other systems have it

QColor to_colour(const document::Label& label) {
  return {label.colour[0], label.colour[1], label.colour[2]};
}

}  // namespace

void LabelsModel::show(const std::vector<document::Label>& labels,
                       const std::vector<document::RegionStatistics>& statistics) {
  const bool same_rows =
      labels.size() == labels_.size() &&
      std::equal(labels.begin(), labels.end(), labels_.begin(),
                 [](const document::Label& a, const document::Label& b) { return a.id == b.id; });
  if (!same_rows) {
    beginResetModel();
    labels_ = given_ = labels;
    statistics_ = statistics;
    endResetModel();
    return;
  }
  // No signal for rows that did not change: the view would put back a name that is being typed.
  const int first_changed = labels == given_ ? volume : 0;
  if (labels != given_) labels_ = given_ = labels;
  statistics_ = statistics;
  if (!labels_.empty()) emit dataChanged(index(0, first_changed), index(rowCount() - 1, columns - 1));
}

const document::Label* LabelsModel::label(int row) const {
  return row >= 0 && row < rowCount() ? &labels_[static_cast<std::size_t>(row)] : nullptr;
}

int LabelsModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(labels_.size());
}

int LabelsModel::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QVariant LabelsModel::text(const document::Label& label, int row, int column) const {
  switch (column) {
    case name:
      return QString::fromStdString(label.name);
    case volume:
      return static_cast<std::size_t>(row) < statistics_.size()
                 ? size_text(statistics_[static_cast<std::size_t>(row)].volume_ml, 1)
                 : QString();
    default:
      return {};
  }
}

QVariant LabelsModel::data(const QModelIndex& index, int role) const {
  const document::Label* found = label(index.row());
  if (!found) return {};
  switch (role) {
    case Qt::DisplayRole:
    case Qt::EditRole:
      return text(*found, index.row(), index.column());
    case Qt::DecorationRole:
      return index.column() == colour ? QVariant(to_colour(*found)) : QVariant();
    case Qt::CheckStateRole:
      if (index.column() == visible) return found->visible ? Qt::Checked : Qt::Unchecked;
      if (index.column() == locked) return found->locked ? Qt::Checked : Qt::Unchecked;
      return {};
    case Qt::TextAlignmentRole:
      return index.column() == volume ? QVariant(Qt::AlignRight | Qt::AlignVCenter) : QVariant();
    case Qt::AccessibleTextRole:
    case Qt::ToolTipRole: {
      if (index.column() == colour) return to_colour(*found).name();
      const QVariant shown = text(*found, index.row(), index.column());
      return shown.isValid() ? shown : headerData(index.column(), Qt::Horizontal, Qt::ToolTipRole);
    }
    default:
      return {};
  }
}

bool LabelsModel::setData(const QModelIndex& index, const QVariant& value, int role) {
  if (!label(index.row())) return false;
  document::Label& edited = labels_[static_cast<std::size_t>(index.row())];
  const bool checked = value.toInt() == Qt::Checked;
  if (role == Qt::CheckStateRole && index.column() == visible) {
    edited.visible = checked;
  } else if (role == Qt::CheckStateRole && index.column() == locked) {
    edited.locked = checked;
  } else if (role == Qt::EditRole && index.column() == name && !value.toString().trimmed().isEmpty()) {
    edited.name = value.toString().trimmed().left(kLongestName).toStdString();
  } else {
    return false;
  }
  announce(index.row());
  return true;
}

void LabelsModel::set_colour(int row, const QColor& chosen) {
  if (!label(row)) return;
  labels_[static_cast<std::size_t>(row)].colour = {static_cast<std::uint8_t>(chosen.red()),
                                                   static_cast<std::uint8_t>(chosen.green()),
                                                   static_cast<std::uint8_t>(chosen.blue())};
  announce(row);
}

void LabelsModel::set_meaning(int row, const std::optional<imaging::SegmentMeaning>& chosen) {
  if (!label(row)) return;
  labels_[static_cast<std::size_t>(row)].meaning = chosen;
  announce(row);
}

void LabelsModel::announce(int row) {
  emit dataChanged(index(row, 0), index(row, columns - 1));
  emit edited(document::Label(labels_[static_cast<std::size_t>(row)]));
}

Qt::ItemFlags LabelsModel::flags(const QModelIndex& index) const {
  const Qt::ItemFlags all = Qt::ItemIsSelectable | Qt::ItemIsEnabled;
  switch (index.column()) {
    case visible:
    case locked:
      return all | Qt::ItemIsUserCheckable;
    case name:
      return all | Qt::ItemIsEditable;
    default:
      return all;
  }
}

QVariant LabelsModel::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal) return {};
  if (role == Qt::DecorationRole) {
    if (section == visible) return icon(u"eye");
    if (section == locked) return icon(u"lock");
    if (section == colour) return icon(u"colour");
    return {};
  }
  if (role == Qt::DisplayRole) {
    if (section == name) return tr("Name");
    if (section == volume) return tr("ml");
    return {};
  }
  if (role == Qt::TextAlignmentRole) {
    return QVariant((section == volume ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
  }
  if (role != Qt::ToolTipRole && role != Qt::AccessibleTextRole) return {};
  const QString tips[] = {tr("Shown in views"), tr("Locked: other labels do not take its voxels"),
                          tr("Colour"), tr("Name"), tr("Volume in ml")};
  return tips[section];
}

}  // namespace tidemark::ui
