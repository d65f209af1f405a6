// The history of a case as rows of a list, the newest on top.
#pragma once

#include <QAbstractListModel>
#include <memory>
#include <optional>
#include <vector>

#include "engine/case_state.h"
#include "ui/panels/history_lanes.h"

namespace tidemark::ui {

// A row as it is drawn.
struct HistoryItem {
  std::uint64_t id = 0;
  QString change;    // that led to it: "Evolution, 120 steps"
  QString figures;   // "Step 120 · 34.2 ml"
  QString steering;  // "T 150  ε 80  α 0.3", "Least (Examples, Edges), Walls  α 0.3"
  QImage picture;    // null: there is none, or none yet
  RowLanes lanes;
  bool present = false;  // the case is there
  bool open = false;     // it is being made
  bool compared = false;
};

class HistoryModel : public QAbstractListModel {
  Q_OBJECT
 public:
  using QAbstractListModel::QAbstractListModel;

  void show(const engine::CaseState& state, std::optional<std::uint64_t> compared);
  void clear();
  // None, or an invalid one: there is no such row.
  [[nodiscard]] std::optional<HistoryItem> item(const QModelIndex& index) const;
  [[nodiscard]] QModelIndex index_of(std::uint64_t id) const;

  [[nodiscard]] int lanes() const { return lanes_; }  // of all rows: from 1 to kMostLanes

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;

 private:
  // What is shown. Words are made of it for the rows that are seen alone.
  struct Shown {
    std::shared_ptr<const engine::HistoryRows> history = std::make_shared<const engine::HistoryRows>();
    std::uint64_t present = 0;
    std::optional<engine::HistoryRow> open;
    std::optional<std::uint64_t> compared;

    bool operator==(const Shown&) const = default;
    [[nodiscard]] int rows() const { return static_cast<int>(history->size()) + (open ? 1 : 0); }
    [[nodiscard]] const engine::HistoryRow& row(int number) const;  // the newest first
    [[nodiscard]] bool is_present(int number) const;
    [[nodiscard]] bool is_compared(int number) const { return row(number).state.id == compared; }
    [[nodiscard]] std::vector<TreeRow> tree() const;
  };

  Shown shown_;
  std::vector<TreeRow> tree_;  // of the rows
  std::vector<RowLanes> row_lanes_;
  int lanes_ = 1;
};

}  // namespace tidemark::ui
