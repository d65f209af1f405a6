#include "ui/panels/history_model.h"

#include <algorithm>

#include "engine/change_text.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

QString capitalised(QString text) {
  if (!text.isEmpty()) text[0] = text[0].toUpper();
  return text;
}

QString text_of_change(const document::HistoryState& state) {
  if (state.parent) return capitalised(engine::change_text(state.change));
  return state.steering.begun ? HistoryModel::tr("Oldest known state")
                              : HistoryModel::tr("Before there was a surface");
}

QString text_of_steering(const document::Steering& steering) {
  const QString alpha = HistoryModel::tr("α %1").arg(general_text(steering.parameters.alpha, 3));
  const QString drive = QString::fromStdString(steering.drive);
  // Of a tent the numbers say more than its name.
  if (!drive.startsWith(QLatin1String("tent"))) return drive + QStringLiteral("  ") + alpha;
  return HistoryModel::tr("T %1  ε %2")
             .arg(general_text(steering.parameters.target, 5), general_text(steering.parameters.range, 4)) +
         QStringLiteral("  ") + alpha;
}

HistoryItem item_of(const document::HistoryState& state, const std::optional<engine::StateFigures>& figures) {
  HistoryItem item;
  item.id = state.id;
  item.change = text_of_change(state);
  if (!state.steering.begun) return item;
  item.figures = HistoryModel::tr("Step %1").arg(count_text(state.steering.step));
  if (figures) {
    item.figures += QStringLiteral(" · ") + number_text(figures->volume_ml, 1, HistoryModel::tr("ml"));
    item.picture = figures->picture;
  }
  item.steering = text_of_steering(state.steering);
  return item;
}

std::vector<HistoryItem> items_of(const engine::HistoryRows& history, const document::HistoryState* open) {
  std::vector<HistoryItem> items;
  std::vector<TreeRow> tree;
  if (open) {
    items.push_back(item_of(*open, std::nullopt));
    items.back().open = true;
    tree.push_back({open->id, open->parent});
  }
  for (auto row = history.rbegin(); row != history.rend(); ++row) {
    items.push_back(item_of(row->state, row->figures));
    tree.push_back({row->state.id, row->state.parent});
  }
  const std::vector<RowLanes> lanes = lanes_of(tree);
  for (std::size_t i = 0; i < items.size(); ++i) items[i].lanes = lanes[i];
  return items;
}

}  // namespace

void HistoryModel::show(const engine::CaseState& state, std::optional<std::uint64_t> compared) {
  Shown now{state.history, state.history_state, state.open_change, compared};
  if (now == shown_) return;
  // While steps are computed, nothing but the row that is being made changes.
  const bool goes_on = now.open && shown_.open && now.open->id == shown_.open->id &&
                       now.history == shown_.history && now.compared == shown_.compared;
  shown_ = std::move(now);
  if (goes_on) {
    const RowLanes lanes = items_.front().lanes;
    items_.front() = item_of(*shown_.open, std::nullopt);
    items_.front().lanes = lanes;
    items_.front().open = items_.front().present = true;
    emit dataChanged(index(0), index(0));
    return;
  }
  std::vector<HistoryItem> items = items_of(*shown_.history, shown_.open ? &*shown_.open : nullptr);
  for (HistoryItem& item : items) {
    item.present = shown_.open ? item.open : item.id == shown_.present;
    item.compared = item.id == shown_.compared;
  }
  lanes_ = 1;
  for (const HistoryItem& item : items) lanes_ = std::max(lanes_, item.lanes.lane + 1);
  const bool same_rows = std::equal(items.begin(), items.end(), items_.begin(), items_.end(),
                                    [](const HistoryItem& a, const HistoryItem& b) { return a.id == b.id; });
  if (!same_rows) beginResetModel();
  items_ = std::move(items);
  if (!same_rows) {
    endResetModel();
  } else if (!items_.empty()) {
    emit dataChanged(index(0), index(rowCount() - 1));
  }
}

void HistoryModel::clear() {
  beginResetModel();
  shown_ = {};
  items_.clear();
  endResetModel();
}

const HistoryItem* HistoryModel::item(const QModelIndex& index) const {
  if (!index.isValid() || index.row() >= rowCount()) return nullptr;
  return &items_[static_cast<std::size_t>(index.row())];
}

QModelIndex HistoryModel::index_of(std::uint64_t id) const {
  for (int row = 0; row < rowCount(); ++row) {
    if (items_[static_cast<std::size_t>(row)].id == id) return index(row);
  }
  return {};
}

int HistoryModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(items_.size());
}

QVariant HistoryModel::data(const QModelIndex& index, int role) const {
  const HistoryItem* shown = item(index);
  if (!shown) return {};
  if (role == Qt::DisplayRole) return shown->change;
  if (role != Qt::AccessibleTextRole && role != Qt::ToolTipRole) return {};
  QStringList lines{shown->change};
  if (!shown->figures.isEmpty()) lines << shown->figures << shown->steering;
  if (shown->present) lines << tr("The case is here.");
  if (shown->compared) lines << tr("It is compared with the surface.");
  return lines.join(QLatin1Char('\n'));
}

}  // namespace tidemark::ui
