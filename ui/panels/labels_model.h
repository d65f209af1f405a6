// The labels of a case as rows of a table.
#pragma once

#include <QAbstractTableModel>
#include <vector>

#include "engine/case_state.h"

namespace tidemark::ui {

class LabelsModel : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { visible, locked, colour, name, volume, columns };
  using QAbstractTableModel::QAbstractTableModel;

  // Rows keep edits until the case has another list.
  void show(const std::vector<document::Label>& labels,
            const std::vector<document::RegionStatistics>& statistics);
  [[nodiscard]] const document::Label* label(int row) const;  // null: there is no such row
  void set_colour(int row, const QColor& chosen);
  void set_meaning(int row, const std::optional<imaging::SegmentMeaning>& chosen);

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
  bool setData(const QModelIndex& index, const QVariant& value, int role) override;
  [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override;
  [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

 signals:
  void edited(const document::Label& label);  // by the user

 private:
  [[nodiscard]] QVariant text(const document::Label& label, int row, int column) const;
  void announce(int row);

  std::vector<document::Label> labels_;
  std::vector<document::Label> given_;
  std::vector<document::RegionStatistics> statistics_;
};

}  // namespace tidemark::ui
