#include "ui/transfer/preset_picker.h"

#include <QEvent>
#include <algorithm>

#include "ui/transfer/preset_thumbnail.h"

namespace tidemark {

PresetPicker::PresetPicker(QWidget* parent) : QComboBox(parent) {
  setAccessibleName(tr("Preset"));
  setToolTip(tr("Replaces the transfer function by a preset"));
  setIconSize(kThumbnailSize);
  setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  setMinimumContentsLength(8);
  setPlaceholderText(tr("Own function"));
  for (const std::string& name : preset_names()) {
    auto one = preset(name);
    if (!one) continue;
    presets_.push_back(std::move(*one));
    addItem(QString::fromStdString(presets_.back().name));
    setItemData(count() - 1, itemText(count() - 1), Qt::ToolTipRole);
  }
  setCurrentIndex(-1);
  draw_pictures();
  connect(this, &QComboBox::activated, this,
          [this](int index) { emit picked(presets_[static_cast<std::size_t>(index)]); });
}

void PresetPicker::set_summary(const SourceSummary& summary) {
  summary_ = summary;
  draw_pictures();
}

void PresetPicker::show_function(const TransferFunction& function) {
  const auto same = [&](const TransferFunction& preset) {
    const TransferFunction own = preset.for_range(summary_.low, summary_.high);
    return own.source == function.source && own.surface == function.surface;
  };
  const auto found = std::find_if(presets_.begin(), presets_.end(), same);
  setCurrentIndex(found == presets_.end() ? -1 : static_cast<int>(found - presets_.begin()));
}

void PresetPicker::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) draw_pictures();
  QComboBox::changeEvent(event);
}

void PresetPicker::draw_pictures() {
  for (int i = 0; i < count(); ++i) {
    const TransferFunction own = presets_[static_cast<std::size_t>(i)].for_range(summary_.low, summary_.high);
    setItemIcon(i, QIcon(preset_thumbnail(own, summary_, palette(), devicePixelRatioF())));
  }
}

}  // namespace tidemark
