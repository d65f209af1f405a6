#include "ui/panels/history_model.h"

#include <algorithm>
#include <utility>

#include "engine/change_text.h"
#include "engine/message_text.h"
#include "solver/speed/speed_registry.h"
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

// Of a tent the numbers say more than its name.
QString text_of_function(const std::string& name, const solver::Parameters& parameters) {
  if (name == "tent")
    return HistoryModel::tr("T %1  ε %2")
        .arg(general_text(parameters.target, 5), general_text(parameters.range, 4));
  const solver::SpeedKind* kind = solver::speed_kind(name);
  return engine::message_text(kind ? std::string(kind->title) : name);
}

QString text_of_drive(const document::DriveSummary& drive, const solver::Parameters& parameters) {
  QStringList parts;
  for (const solver::SpeedTerm& term : drive.setting.terms)
    parts << text_of_function(term.function, parameters);
  if (parts.size() > 1) {
    const bool is_least = drive.setting.combine == solver::Combine::least;
    const QString joined = is_least ? HistoryModel::tr("Least") : HistoryModel::tr("Product");
    parts = {joined + QStringLiteral(" (") + parts.join(QStringLiteral(", ")) + QLatin1Char(')')};
  }
  if (drive.has_walls) parts << HistoryModel::tr("Walls");
  if (drive.has_anchors) parts << HistoryModel::tr("Anchors");
  return parts.join(QStringLiteral(", "));
}

QString text_of_steering(const document::Steering& steering) {
  return text_of_drive(steering.drive, steering.parameters) + QStringLiteral("  ") +
         HistoryModel::tr("α %1").arg(general_text(steering.parameters.alpha, 3));
}

HistoryItem item_of(const document::HistoryState& state, const std::optional<engine::StateFigures>& figures) {
  HistoryItem item;
  item.id = state.id;
  item.change = text_of_change(state);
  if (!state.steering.begun) return item;
  item.figures = HistoryModel::tr("Step %1").arg(count_text(state.steering.step));
  if (figures) {
    item.figures += QStringLiteral(" · ") + size_text(figures->volume_ml, 1, HistoryModel::tr("ml"));
    item.picture = figures->picture;
  }
  item.steering = text_of_steering(state.steering);
  return item;
}

}  // namespace

const engine::HistoryRow& HistoryModel::Shown::row(int number) const {
  if (open && number == 0) return *open;
  return (*history)[static_cast<std::size_t>(rows() - 1 - number)];
}

bool HistoryModel::Shown::is_present(int number) const {
  return open ? number == 0 : row(number).state.id == present;
}

std::vector<TreeRow> HistoryModel::Shown::tree() const {
  std::vector<TreeRow> tree;
  for (int number = 0; number < rows(); ++number)
    tree.push_back({row(number).state.id, row(number).state.parent});
  return tree;
}

void HistoryModel::show(const engine::CaseState& state, std::optional<std::uint64_t> compared) {
  Shown now{state.history, state.history_state, std::nullopt, compared};
  if (state.open_change) now.open = engine::HistoryRow{*state.open_change, std::nullopt};
  if (now == shown_) return;
  std::vector<TreeRow> tree = now.tree();
  if (tree != tree_) {
    beginResetModel();
    shown_ = std::move(now);
    tree_ = std::move(tree);
    row_lanes_ = lanes_of(tree_);
    lanes_ = 1;
    for (const RowLanes& row : row_lanes_) lanes_ = std::max(lanes_, row.lane + 1);
    endResetModel();
    return;
  }
  const Shown before = std::exchange(shown_, std::move(now));
  for (int number = 0; number < rowCount(); ++number) {
    const engine::HistoryRow& row = shown_.row(number);
    const engine::HistoryRow& was = before.row(number);
    if ((&row != &was && row != was) || shown_.is_present(number) != before.is_present(number) ||
        shown_.is_compared(number) != before.is_compared(number))
      emit dataChanged(index(number), index(number));
  }
}

void HistoryModel::clear() {
  beginResetModel();
  shown_ = {};
  tree_.clear();
  row_lanes_.clear();
  endResetModel();
}

std::optional<HistoryItem> HistoryModel::item(const QModelIndex& index) const {
  if (!index.isValid() || index.row() >= rowCount()) return std::nullopt;
  const engine::HistoryRow& row = shown_.row(index.row());
  HistoryItem item = item_of(row.state, row.figures);
  item.lanes = row_lanes_[static_cast<std::size_t>(index.row())];
  item.present = shown_.is_present(index.row());
  item.open = shown_.open && index.row() == 0;
  item.compared = shown_.is_compared(index.row());
  return item;
}

QModelIndex HistoryModel::index_of(std::uint64_t id) const {
  const auto row =
      std::find_if(tree_.begin(), tree_.end(), [id](const TreeRow& one) { return one.id == id; });
  return row == tree_.end() ? QModelIndex() : index(static_cast<int>(row - tree_.begin()));
}

int HistoryModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : shown_.rows();
}

QVariant HistoryModel::data(const QModelIndex& index, int role) const {
  const std::optional<HistoryItem> shown = item(index);
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
