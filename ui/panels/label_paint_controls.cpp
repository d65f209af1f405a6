#include "ui/panels/label_paint_controls.h"

#include <QGridLayout>
#include <QToolButton>
#include <algorithm>

#include "ui/look/theme.h"
#include "ui/panels/value_unit.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"
#include "ui/widgets/wide_button.h"

namespace tidemark::ui {

LabelPaintControls::LabelPaintControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.wide(make_buttons());
  low_ = form.slider(tr("From"), tr("Voxels with lower values stay as they are."));
  high_ = form.slider(tr("Up to"), tr("Voxels with higher values stay as they are."));
  for (SliderNumber* number : {low_, high_})
    connect(number, &SliderNumber::edited, this, &LabelPaintControls::read_values);
  rows_ = form.layout();
  show_brush();
}

QWidget* LabelPaintControls::make_buttons() {
  auto* buttons = new QWidget;
  auto* grid = new QGridLayout(buttons);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(kSpaceTight);
  brush_ = make_wide_button(
      tr("Brush"), u"tool-label",
      tr("Paints the chosen label, or a new one. Left button: adds. Right button: takes away. With "
         "Shift a ball "
         "through slices, with Ctrl only voxels as bright as the first one, within ε."));
  outline_ = make_wide_button(
      tr("Outline"), u"label-outline",
      tr("Paints what the mouse goes around in a slice, or a polygon by clicks, which a double "
         "click ends. Left "
         "button: adds. Right button: takes away."));
  livewire_ = make_wide_button(
      tr("Livewire"), u"label-livewire",
      tr("Paints what lines along edges go around, from click to click in a slice. A double click ends them. "
         "Left button: adds. Right button: takes away."));
  limited_ = make_wide_button(
      tr("Only values"), u"label-values",
      tr("Brush, outline and livewire change voxels with certain values alone, T ± ε at first."));
  for (QToolButton* button : {brush_, outline_, livewire_, limited_}) {
    button->setCheckable(true);
    grid->addWidget(button, grid->count() / 2, grid->count() % 2);
  }
  connect(brush_, &QToolButton::clicked, this, [this] { choose(engine::LabelWay::brush); });
  connect(outline_, &QToolButton::clicked, this, [this] { choose(engine::LabelWay::outline); });
  connect(livewire_, &QToolButton::clicked, this, [this] { choose(engine::LabelWay::livewire); });
  connect(limited_, &QToolButton::clicked, this, &LabelPaintControls::limit_values);
  return buttons;
}

template <class Change>
void LabelPaintControls::change_brush(Change&& apply) {
  if (!proxy()) return;
  engine::LabelBrush brush = proxy()->display().label_brush();
  apply(brush);
  proxy()->display().set_label_brush(brush);
}

void LabelPaintControls::choose(engine::LabelWay way) {
  change_brush([&](engine::LabelBrush& brush) { brush.way = way; });
  if (proxy()) proxy()->display().choose_tool(engine::Tool::label);
  show_brush();
}

void LabelPaintControls::limit_values(bool on) {
  change_brush([&](engine::LabelBrush& brush) {
    const auto& parameters = proxy()->parameters();
    brush.values.reset();
    if (on) brush.values = {parameters.target - parameters.range, parameters.target + parameters.range};
  });
  show_brush();
}

// The end that was not moved gives way.
void LabelPaintControls::read_values() {
  const bool low_moved = sender() == low_;
  change_brush([&](engine::LabelBrush& brush) {
    brush.values = {low_->value(), high_->value()};
    if (low_moved) brush.values->high = std::max(brush.values->low, brush.values->high);
    if (!low_moved) brush.values->low = std::min(brush.values->low, brush.values->high);
  });
  show_brush();
}

void LabelPaintControls::set_label(std::uint8_t label) {
  change_brush([&](engine::LabelBrush& brush) { brush.label = label; });
}

void LabelPaintControls::set_take(document::Take take) {
  change_brush([&](engine::LabelBrush& brush) { brush.take = take; });
}

void LabelPaintControls::attach() {
  if (!proxy()) return show_brush();
  const engine::SourceSummary& summary = proxy()->summary();
  // T ± ε may reach beyond all values.
  const double all = summary.highest - summary.lowest;
  for (SliderNumber* number : {low_, high_}) {
    number->set_decimals(value_decimals(summary.high - summary.low));
    number->set_range(summary.low, summary.high, summary.lowest - all, summary.highest + all);
    number->set_unit(value_unit(proxy()->volume()));
  }
  show_brush();
}

void LabelPaintControls::refresh() {
  show_brush();
}

void LabelPaintControls::show_brush() {
  const bool paints = proxy() && proxy()->display().settings().tool == engine::Tool::label;
  const engine::LabelBrush brush = proxy() ? proxy()->display().label_brush() : engine::LabelBrush{};
  brush_->setChecked(paints && brush.way == engine::LabelWay::brush);
  outline_->setChecked(paints && brush.way == engine::LabelWay::outline);
  livewire_->setChecked(paints && brush.way == engine::LabelWay::livewire);
  limited_->setChecked(brush.values.has_value());
  for (SliderNumber* number : {low_, high_}) show_row(*rows_, number, brush.values.has_value());
  if (!brush.values) return;
  low_->set_value(brush.values->low);
  high_->set_value(brush.values->high);
}

}  // namespace tidemark::ui
