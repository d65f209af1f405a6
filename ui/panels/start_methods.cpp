#include "ui/panels/start_methods.h"

#include <QComboBox>
#include <QLabel>
#include <QSignalBlocker>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "solver/speed/speed_registry.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/refine_choice.h"
#include "ui/panels/value_unit.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {
namespace {

QToolButton* make_button(const QString& text, const QString& tip) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setToolTip(tip);
  button->setAccessibleName(text);
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button->setIconSize({kIconSmall, kIconSmall});
  button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  button->setFocusPolicy(Qt::StrongFocus);
  return button;
}

Index3 nearest_voxel(const glm::dvec3& voxel) {
  return {std::llround(voxel.x), std::llround(voxel.y), std::llround(voxel.z)};
}

// How many voxels have a value in [low, high], from the histogram.
double count_between(const engine::SourceSummary& summary, double low, double high) {
  const double width = (static_cast<double>(summary.highest) - summary.lowest) / engine::SourceSummary::kBins;
  double count = 0.0;
  for (std::size_t bin = 0; bin < summary.values.size(); ++bin) {
    const double left = summary.lowest + static_cast<double>(bin) * width;
    const double common = std::min(high, left + width) - std::max(low, left);
    const double share = width > 0.0 ? std::clamp(common / width, 0.0, 1.0) : (common >= 0.0 ? 1.0 : 0.0);
    count += share * static_cast<double>(summary.values[bin]);
  }
  return count;
}

}  // namespace

// Spheres.

SphereStartMethod::SphereStartMethod(QWidget* parent) : StartMethod(parent) {
  Form form(this);
  form.note(
      tr("Click and drag in a view to place a sphere: press at its centre, drag to its radius. Or place "
         "one by numbers, around the crosshair."));
  draw_ = make_button(tr("Draw in a view"), tr("Gives the left mouse button the tool that places spheres."));
  draw_->setIcon(icon(u"tool-seed"));
  draw_->setCheckable(true);
  form.wide(draw_);
  connect(draw_, &QToolButton::clicked, this, [this] {
    if (proxy()) proxy()->display().choose_tool(engine::Tool::seed);
    draw_->setChecked(true);
  });
  radius_ = form.slider(tr("Radius"), tr("Of the sphere around the crosshair."));
  radius_->set_decimals(1);
  radius_->set_range(0.5, 100.0, SliderNumber::Scale::logarithmic);
  radius_->set_unit(tr("mm"));
  radius_->set_value(10.0);
  connect(radius_, &SliderNumber::edited, this, &StartMethod::changed);
}

QString SphereStartMethod::sentence() const {
  return tr("Places one sphere of %1 around the crosshair.").arg(number_text(radius_->value(), 1, tr("mm")));
}

bool SphereStartMethod::can_start() const {
  return proxy() != nullptr;
}

void SphereStartMethod::start(int levels) {
  document::Start start;
  start.seeds.push_back({proxy()->display().settings().cursor_mm, radius_->value()});
  start.levels = levels;
  proxy()->begin(start);
}

void SphereStartMethod::refresh() {
  draw_->setChecked(proxy()->display().settings().tool == engine::Tool::seed);
}

// Values.

ValueStartMethod::ValueStartMethod(Extent extent, QWidget* parent) : StartMethod(parent), extent_(extent) {
  Form form(this);
  form.note(
      extent == Extent::everywhere
          ? tr("Takes all voxels whose value lies in a range.")
          : tr("Takes the voxels whose value lies in a range and that are connected to the crosshair."));
  if (extent == Extent::connected) here_ = form.figure(tr("At the crosshair"), tr("Where the flood begins."));
  low_ = form.slider(tr("From"), tr("The smallest value that is taken."));
  high_ = form.slider(tr("To"), tr("The largest value that is taken."));
  auto* tent = make_button(tr("Take T − ε to T + ε"), tr("The values for which the surface would grow."));
  form.wide(tent);
  connect(tent, &QToolButton::clicked, this, [this] {
    take_tent();
    keep();
  });
  connect(low_, &SliderNumber::edited, this, &ValueStartMethod::keep);
  connect(high_, &SliderNumber::edited, this, &ValueStartMethod::keep);
}

QString ValueStartMethod::title() const {
  return extent_ == Extent::everywhere ? tr("Threshold") : tr("Flood fill");
}

void ValueStartMethod::attach() {
  if (!proxy()) return;
  const engine::SourceSummary& summary = proxy()->summary();
  const double lowest = summary.lowest;
  const double highest = summary.highest;
  const QString unit = value_unit(proxy()->volume());
  for (SliderNumber* number : {low_, high_}) {
    number->set_decimals(decimals_for(summary.high - summary.low));
    number->set_range(summary.low, summary.high, lowest, highest);
    number->set_unit(unit);
  }
  take_tent();
  const auto& known = proxy()->study().start;
  const auto* values = chosen_.find(proxy());
  if (!values && known && known->threshold) values = &*known->threshold;
  if (!values) return;
  low_->set_value(values->first);
  high_->set_value(values->second);
}

void ValueStartMethod::take_tent() {
  if (!proxy()) return;
  const solver::Parameters& parameters = proxy()->parameters();
  low_->set_value(parameters.target - parameters.range);
  high_->set_value(parameters.target + parameters.range);
}

void ValueStartMethod::keep() {
  if (proxy()) chosen_[*proxy()] = {low_->value(), high_->value()};
  emit changed();
}

QString ValueStartMethod::range_text() const {
  const QString unit = value_unit(proxy()->volume());
  const int decimals = decimals_for(proxy()->summary().high - proxy()->summary().low);
  return tr("%1 to %2")
      .arg(number_text(low_->value(), decimals), number_text(high_->value(), decimals, unit));
}

std::optional<Index3> ValueStartMethod::voxel() const {
  const Geometry& geometry = proxy()->volume().geometry;
  const Index3 voxel = nearest_voxel(geometry.to_voxel(proxy()->display().settings().cursor_mm));
  if (!geometry.contains(voxel)) return std::nullopt;
  return voxel;
}

QString ValueStartMethod::everywhere_text() const {
  // The histogram is of the study as it was opened.
  if (proxy()->state().smoothed_mm > 0.0)
    return tr("Places the surface around the voxels from %1.").arg(range_text());
  const Volume& volume = proxy()->volume();
  const double count = count_between(proxy()->summary(), low_->value(), high_->value());
  const double share = 100.0 * count / static_cast<double>(volume.geometry.voxel_count());
  return tr("Places the surface around the voxels from %1: about %2 of the study, %3.")
      .arg(range_text(), number_text(share, share < 10.0 ? 1 : 0, QStringLiteral("%")),
           number_text(count * volume.geometry.voxel_volume_ml(), 1, tr("ml")));
}

QString ValueStartMethod::connected_text() const {
  if (!voxel()) return tr("The crosshair is outside the study.");
  const double here = proxy()->source()->value(*voxel());
  if (here < low_->value() || here > high_->value()) {
    return tr("The value at the crosshair is not from %1.").arg(range_text());
  }
  return tr("Places the surface around the voxels from %1 that are connected to the crosshair.")
      .arg(range_text());
}

QString ValueStartMethod::sentence() const {
  if (!proxy()) return {};
  if (low_->value() > high_->value()) return tr("The first value is larger than the second.");
  return extent_ == Extent::everywhere ? everywhere_text() : connected_text();
}

bool ValueStartMethod::can_start() const {
  if (!proxy() || low_->value() > high_->value()) return false;
  if (extent_ == Extent::everywhere) return true;
  if (!voxel()) return false;
  const double here = proxy()->source()->value(*voxel());
  return here >= low_->value() && here <= high_->value();
}

void ValueStartMethod::start(int levels) {
  document::Start start;
  if (extent_ == Extent::everywhere) {
    start.from = document::ThresholdStart{low_->value(), high_->value()};
  } else {
    start.from = document::FloodStart{*voxel(), low_->value(), high_->value()};
  }
  start.levels = levels;
  proxy()->begin(start);
}

void ValueStartMethod::refresh() {
  if (here_) {
    const auto at = voxel();
    here_->setText(at ? number_text(proxy()->source()->value(*at),
                                    decimals_for(proxy()->summary().high - proxy()->summary().low),
                                    value_unit(proxy()->volume()))
                      : QStringLiteral("–"));
  }
  emit changed();
}

// The speed.

SpeedStartMethod::SpeedStartMethod(QWidget* parent) : StartMethod(parent) {
  Form form(this);
  form.note(
      tr("Takes all voxels where the speed is above 0: every part of what is wanted, also those that no "
         "sphere or stroke has touched. The speed map shows them."));
}

QString SpeedStartMethod::sentence() const {
  if (!proxy()) return {};
  if (!is_known()) {
    return tr("What drives the surface depends on where it is: place one in another way first.");
  }
  return tr("Places the surface around all voxels where it would grow.");
}

bool SpeedStartMethod::is_known() const {
  return !solver::any_has(proxy()->drive().setting, &solver::SpeedKind::follows_surface);
}

bool SpeedStartMethod::can_start() const {
  return proxy() && is_known();
}

void SpeedStartMethod::start(int levels) {
  document::Start start;
  start.from = document::SpeedStart{};
  start.levels = levels;
  proxy()->begin(start);
}

// Labels.

LabelStartMethod::LabelStartMethod(QWidget* parent) : StartMethod(parent) {
  Form form(this);
  form.note(tr("Takes what was segmented before."));
  label_ = form.choice(tr("Label"), tr("The surface begins around its voxels."));
  connect(label_, &QComboBox::activated, this, &StartMethod::changed);
  refine_ = new RefineChoice;
  form.wide(refine_);
  connect(refine_, &RefineChoice::changed, this, &StartMethod::changed);
}

void LabelStartMethod::attach() {
  shown_.clear();
  label_->clear();
}

void LabelStartMethod::refresh() {
  const std::vector<document::Label>& labels = proxy()->state().labels;
  if (labels == shown_) return;
  shown_ = labels;
  const QVariant chosen = label_->currentData();
  label_->clear();
  for (const document::Label& label : labels) label_->addItem(QString::fromStdString(label.name), label.id);
  label_->setCurrentIndex(std::max(0, label_->findData(chosen)));
  emit changed();
}

QString LabelStartMethod::sentence() const {
  if (label_->count() == 0) return tr("There are no labels yet.");
  if (const auto within_mm = refine_->within_mm()) {
    return tr("Refines “%1”: the surface stays within %2 of it.")
        .arg(label_->currentText(), number_text(*within_mm, 1, tr("mm")));
  }
  return tr("Places the surface around the voxels of “%1”.").arg(label_->currentText());
}

bool LabelStartMethod::can_start() const {
  return proxy() && label_->count() > 0;
}

void LabelStartMethod::start(int levels) {
  proxy()->begin_from_label(static_cast<std::uint8_t>(label_->currentData().toUInt()), refine_->within_mm(),
                            levels);
}

}  // namespace tidemark::ui
