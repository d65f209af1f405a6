// The history of a case as rows of a list, the newest on top.
#pragma once

#include <QAbstractListModel>
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
  QString steering;  // "T 150  ε 80  α 0.3"
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
  [[nodiscard]] const HistoryItem* item(const QModelIndex& index) const;  // null: there is no such row
  [[nodiscard]] QModelIndex index_of(std::uint64_t id) const;             // invalid: there is no such row

  [[nodiscard]] int lanes() const { return lanes_; }  // of all rows: at least 1

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;

 private:
  // What the rows were made of.
  struct Shown {
    std::shared_ptr<const engine::HistoryRows> history;
    std::uint64_t present = 0;
    std::optional<document::HistoryState> open;
    std::optional<std::uint64_t> compared;

    bool operator==(const Shown&) const = default;
  };

  Shown shown_;
  std::vector<HistoryItem> items_;
  int lanes_ = 1;
};

}  // namespace tidemark::ui
