#include "ui/panels/window_controls.h"

#include <QComboBox>
#include <QCoreApplication>
#include <cmath>

#include "ui/panels/value_unit.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {
namespace {

constexpr double kFarFromValues =
    1000.0;  // windows may lie far from what a study holds: a lung's for a phantom of water

}  // namespace

std::vector<WindowPreset> window_presets(const Volume& volume, const engine::SourceSummary& summary) {
  const auto text = [](const char* name) { return QCoreApplication::translate("WindowPresets", name); };
  std::vector<WindowPreset> presets;
  if (volume.modality == "CT") {
    presets = {{text(QT_TRANSLATE_NOOP("WindowPresets", "Soft tissue")), {40.0, 400.0}},
               {text(QT_TRANSLATE_NOOP("WindowPresets", "Lung")), {-600.0, 1500.0}},
               {text(QT_TRANSLATE_NOOP("WindowPresets", "Liver")), {90.0, 150.0}},
               {text(QT_TRANSLATE_NOOP("WindowPresets", "Bone")), {480.0, 2500.0}},
               {text(QT_TRANSLATE_NOOP("WindowPresets", "Brain")), {40.0, 80.0}}};
  }
  if (volume.window) {
    presets.push_back({text(QT_TRANSLATE_NOOP("WindowPresets", "As in the file")), *volume.window});
  }
  const double lowest = summary.lowest;
  const double highest = summary.highest;
  presets.push_back({text(QT_TRANSLATE_NOOP("WindowPresets", "Full range")),
                     {(lowest + highest) / 2.0, span_between(lowest, highest)}});
  return presets;
}

WindowControls::WindowControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Window"));
  preset_ = form.choice(tr("Preset"), tr("Windows for tissues, and for all values of the study."));
  width_ = form.slider(tr("Width"), tr("From black to white."));
  level_ = form.slider(tr("Level"), tr("The middle grey."));
  connect(preset_, &QComboBox::activated, this, [this](int index) {
    if (index == 0 || index > static_cast<int>(presets_.size())) return refresh();
    const WindowLevel window = presets_[static_cast<std::size_t>(index) - 1].window;
    change_display([&](engine::DisplaySettings& settings) { settings.window = window; });
  });
  connect(width_, &SliderNumber::edited, this, [this](double value) {
    change_display([=](engine::DisplaySettings& settings) { settings.window.width = value; });
  });
  connect(level_, &SliderNumber::edited, this, [this](double value) {
    change_display([=](engine::DisplaySettings& settings) { settings.window.centre = value; });
  });
}

void WindowControls::attach() {
  if (!proxy()) return;
  const engine::SourceSummary& summary = proxy()->summary();
  const QString unit = value_unit(proxy()->volume());
  presets_ = window_presets(proxy()->volume(), summary);
  preset_->clear();
  preset_->addItem(tr("Own"));
  preset_->setItemData(0, tr("As set below, or in a view"), Qt::ToolTipRole);
  for (const WindowPreset& preset : presets_) preset_->addItem(preset.name);

  const double span = span_between(summary.low, summary.high);
  const double all = std::max<double>(summary.highest - summary.lowest, span);
  const int decimals = decimals_for(span);
  const double smallest = std::pow(10.0, -decimals);
  for (SliderNumber* number : {width_, level_}) {
    number->set_decimals(decimals);
    number->set_unit(unit);
  }
  width_->set_range(std::max(smallest, span / 500.0), 1.5 * span, smallest, kFarFromValues * all,
                    SliderNumber::Scale::logarithmic);
  level_->set_range(summary.low, summary.high, summary.lowest - kFarFromValues * all,
                    summary.highest + kFarFromValues * all);
}

void WindowControls::refresh() {
  if (!proxy()) return;
  const WindowLevel& window = proxy()->display().settings().window;
  width_->set_value(window.width);
  level_->set_value(window.centre);
  int chosen = 0;
  for (std::size_t index = 0; index < presets_.size() && chosen == 0; ++index) {
    if (presets_[index].window == window) chosen = static_cast<int>(index) + 1;
  }
  preset_->setCurrentIndex(chosen);
}

}  // namespace tidemark::ui
