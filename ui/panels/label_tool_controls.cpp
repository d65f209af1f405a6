#include "ui/panels/label_tool_controls.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <array>
#include <cmath>

#include "ui/widgets/form.h"
#include "ui/widgets/into_sight.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {
namespace {

using document::LabelTool;

constexpr int kSoonMs = 150;  // a slider that moves asks for one preview, not for each of its places

enum class Amount { none, mm, ml };

struct ToolText {
  LabelTool tool;
  const char* name;
  const char* tip;
  Amount amount = Amount::none;
  double first = 0.0;  // the amount that it begins with
  double most = 0.0;
};

constexpr std::array kTools{
    ToolText{
        LabelTool::largest_island, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Keep the largest island"),
        QT_TRANSLATE_NOOP("tidemark::LabelTool", "Parts that do not touch it across a voxel's face go.")},
    ToolText{
        LabelTool::island_here, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Keep the island under the cross"),
        QT_TRANSLATE_NOOP("tidemark::LabelTool", "Put the cross of the slice views into it; all others go.")},
    ToolText{LabelTool::small_islands, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Remove small islands"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool", "Islands below this volume go."), Amount::ml, 0.1,
             100.0},
    ToolText{LabelTool::holes, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Fill holes"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool", "What the label encloses on all sides belongs to it.")},
    ToolText{LabelTool::slice_holes, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Fill holes in slices"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool",
                               "What the label encloses in an acquired slice belongs to it.")},
    ToolText{
        LabelTool::grow, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Grow"),
        QT_TRANSLATE_NOOP("tidemark::LabelTool", "A margin around the label, the same in all directions."),
        Amount::mm, 2.0, 30.0},
    ToolText{LabelTool::shrink, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Shrink"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool",
                               "Takes a margin away. At the end of the volume nothing is taken."),
             Amount::mm, 2.0, 30.0},
    ToolText{LabelTool::median, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Smooth by the median"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool", "Rounds edges; what is thinner than the radius goes."),
             Amount::mm, 2.0, 10.0},
    ToolText{LabelTool::gaussian, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Smooth and keep the volume"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool", "By a Gaussian, at the level that keeps the volume."),
             Amount::mm, 1.5, 10.0},
    ToolText{LabelTool::slices, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Fill between slices"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool",
                               "Empty slices between drawn ones, by the distances to both outlines.")},
    ToolText{LabelTool::add, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Add"),
             QT_TRANSLATE_NOOP(
                 "tidemark::LabelTool",
                 "The inside of the surface, or another label, of which voxels are taken only if the box "
                 "above is ticked.")},
    ToolText{LabelTool::subtract, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Subtract"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool", "What lies inside of the surface, too, goes.")},
    ToolText{LabelTool::intersect, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Intersect"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool", "What does not lie inside of the surface goes.")},
    ToolText{LabelTool::split, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Split at the clip plane"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool",
                               "What the plane of the 3D view cuts off becomes a label of its own.")},
    ToolText{LabelTool::watershed, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Split at necks"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool",
                               "Paint a seed of another label into each part, and choose that label below. "
                               "Parts meet where the label is thin.")},
    ToolText{LabelTool::mirror, QT_TRANSLATE_NOOP("tidemark::LabelTool", "Mirror"),
             QT_TRANSLATE_NOOP("tidemark::LabelTool", "At the middle of the volume.")},
};

QString text_of(const char* words) {
  return QCoreApplication::translate("tidemark::LabelTool", words);
}

const ToolText& text_of(LabelTool tool) {
  return *std::find_if(kTools.begin(), kTools.end(), [&](const ToolText& text) { return text.tool == tool; });
}

bool has_axis(LabelTool tool) {
  return tool == LabelTool::slices || tool == LabelTool::mirror;
}

bool has_other_label(LabelTool tool) {
  return tool == LabelTool::add || tool == LabelTool::watershed;
}

// The axis of the grid that runs most along an axis of the patient.
int grid_axis(const Geometry& grid, int patient_axis) {
  int best = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(grid.direction[axis][patient_axis]) > std::abs(grid.direction[best][patient_axis]))
      best = axis;
  }
  return best;
}

}  // namespace

LabelToolControls::LabelToolControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Finish"));
  tool_ = form.choice(
      tr("Tool"),
      tr("What is done with the chosen labels. All views show the outcome before it is applied."));
  tool_->addItem(tr("None"));
  for (const ToolText& text : kTools) tool_->addItem(text_of(text.name), static_cast<int>(text.tool));
  connect(tool_, &QComboBox::activated, this, &LabelToolControls::choose_tool);
  hint_ = form.note({});
  amount_ = form.slider(tr("Amount"), tr("Of the chosen tool."));
  amount_->set_decimals(1);
  connect(amount_, &SliderNumber::edited, this, &LabelToolControls::look_again);
  axis_ = form.choice(tr("Direction"), tr("Which slices were drawn, or which sides change places."));
  axis_->addItem(tr("Axial"), 2);
  axis_->addItem(tr("Coronal"), 1);
  axis_->addItem(tr("Sagittal"), 0);
  connect(axis_, &QComboBox::activated, this, &LabelToolControls::look_again);
  other_ = form.choice(tr("With"), tr("Whose voxels are added, taken away, kept, or seeds."));
  connect(other_, &QComboBox::activated, this, &LabelToolControls::look_again);
  work_ = new WorkLine;
  form.wide(work_);
  connect(work_, &WorkLine::cancelled, this, [this] {
    if (finisher()) finisher()->cancel();
  });
  apply_ = new QPushButton(tr("Apply to labels"));
  form.wide(apply_);
  connect(apply_, &QPushButton::clicked, this, [this] {
    if (!finisher()) return;
    finisher()->apply();
    tool_->setCurrentIndex(0);
    choose_tool();
  });
  rows_ = form.layout();
  soon_.setSingleShot(true);
  soon_.setInterval(kSoonMs);
  connect(&soon_, &QTimer::timeout, this, &LabelToolControls::look);
  choose_tool();
}

engine::LabelFinisher* LabelToolControls::finisher() const {
  return proxy() ? &proxy()->label_finisher() : nullptr;
}

std::optional<LabelTool> LabelToolControls::tool() const {
  const QVariant chosen = tool_->currentData();
  if (!chosen.isValid()) return std::nullopt;
  return static_cast<LabelTool>(chosen.toInt());
}

document::LabelToolUse LabelToolControls::use() const {
  document::LabelToolUse use;
  use.tool = *tool();
  use.amount = amount_->value();
  const Geometry& grid = proxy()->volume().geometry;
  use.axis = grid_axis(grid, axis_->currentData().toInt());
  use.other = static_cast<std::uint8_t>(other_->currentData().toInt());
  // The preview follows the cross or the plane of a tool that works there. To others they make no difference.
  const engine::DisplaySettings& settings = proxy()->display().settings();
  if (use.tool == LabelTool::island_here) {
    use.voxel = Index3(glm::round(grid.to_voxel(settings.cursor_mm)));
  } else if (use.tool == LabelTool::split) {
    use.normal = settings.clip.normal;
    use.point_mm = settings.clip.normal * settings.clip.offset_mm;
  }
  return use;
}

void LabelToolControls::choose_tool() {
  const auto chosen = tool();
  const ToolText* text = chosen ? &text_of(*chosen) : nullptr;
  hint_->setText(text ? text_of(text->tip) : QString());
  if (text && text->amount != Amount::none) {
    amount_->set_unit(text->amount == Amount::mm ? tr("mm") : tr("ml"));
    amount_->set_range(0.1, text->most, SliderNumber::Scale::logarithmic);
    amount_->set_value(text->first);
  }
  show_row(*rows_, hint_, text != nullptr);
  show_row(*rows_, amount_, text && text->amount != Amount::none);
  show_row(*rows_, axis_, chosen && has_axis(*chosen));
  show_row(*rows_, other_, chosen && document::has_other(*chosen));
  show_row(*rows_, work_, text != nullptr);
  work_->end({});
  show_row(*rows_, apply_, text != nullptr);
  if (!chosen && finisher()) finisher()->clear();
  // Once the rows have their places.
  if (chosen) QTimer::singleShot(0, this, [this] { bring_into_sight(*apply_); });
  if (proxy()) fill_others();
  look_again();
}

// A list that is open stays so while nothing in it changes.
void LabelToolControls::fill_others() {
  std::vector<std::pair<QString, std::uint8_t>> others;
  const auto chosen = tool();
  if (chosen != LabelTool::watershed) others.emplace_back(tr("Surface"), document::kTheSurface);
  for (const document::Label& label : proxy()->state().labels) {
    // Labels do not overlap: there is nothing to take away from one another.
    if (!chosen || !has_other_label(*chosen) || labels_ == std::vector{label.id}) continue;
    others.emplace_back(QString::fromStdString(label.name), label.id);
  }
  std::vector<std::pair<QString, std::uint8_t>> known;
  for (int n = 0; n < other_->count(); ++n)
    known.emplace_back(other_->itemText(n), static_cast<std::uint8_t>(other_->itemData(n).toInt()));
  if (others == known) return;
  const QVariant was = other_->currentData();
  other_->clear();
  for (const auto& [name, id] : others) other_->addItem(name, id);
  other_->setCurrentIndex(std::max(other_->findData(was), 0));
}

void LabelToolControls::set_labels(const std::vector<std::uint8_t>& labels) {
  if (labels == labels_) return;
  labels_ = labels;
  if (proxy()) fill_others();
  look_again();
}

void LabelToolControls::set_take(document::Take take) {
  take_ = take;
  look_again();
}

void LabelToolControls::look_again() {
  if (proxy() && tool()) soon_.start();
  show_buttons();
}

void LabelToolControls::look() {
  if (!finisher() || !tool()) return;
  if (labels_.empty()) return say(tr("Choose a label in the table."));
  if (tool() == LabelTool::watershed && other_->count() == 0)
    return say(tr("Add another label and paint the seeds with it."));
  if (proxy()->state().playing && document::has_surface(use()))
    return say(tr("Pause the surface: it moves while it is looked at."));
  work_->begin(tr("Preview"));
  finisher()->begin(use(), labels_, take_);
  show_buttons();
}

void LabelToolControls::show_preview() {
  const auto& preview = finisher() ? finisher()->preview() : nullptr;
  if (!preview || !tool()) return say({});
  if (!preview->changes) return say(tr("It would change nothing."));
  const double change = preview->after_ml - preview->before_ml;
  say(tr("%1 ml become %2 ml (%3%4 ml).")
          .arg(number_text(preview->before_ml, 2), number_text(preview->after_ml, 2),
               change < 0.0 ? QStringLiteral("−") : QStringLiteral("+"), number_text(std::abs(change), 2)));
}

void LabelToolControls::say(const QString& text) {
  work_->end(text);
  show_buttons();
}

bool LabelToolControls::is_looked_at() const {
  if (!finisher() || !tool() || !finisher()->is_current()) return false;
  const engine::LabelPreview& preview = *finisher()->preview();
  return preview.use == use() && preview.labels == labels_ && preview.take == take_;
}

void LabelToolControls::show_buttons() {
  apply_->setEnabled(is_looked_at() && finisher()->preview()->changes && !finisher()->busy());
}

void LabelToolControls::attach() {
  if (shown_) {
    disconnect(shown_, nullptr, this, nullptr);
    shown_->clear();
  }
  shown_ = finisher();
  tool_->setCurrentIndex(0);
  choose_tool();
  if (!shown_) return;
  connect(shown_, &engine::LabelFinisher::changed, this, &LabelToolControls::show_preview);
  connect(shown_, &engine::LabelFinisher::failed, this, [this](const QString& message) {
    shown_->clear();
    say(message);
  });
  connect(shown_, &engine::LabelFinisher::cancelled, this, &LabelToolControls::show_preview);
  connect(shown_, &engine::LabelFinisher::progressed, work_, &WorkLine::set_progress);
}

void LabelToolControls::refresh() {
  fill_others();
  if (tool() && !soon_.isActive() && !finisher()->asked_is_current(use())) return look_again();
  show_buttons();
}

}  // namespace tidemark::ui
