#include "ui/transfer/preset_picker.h"

#include <QEvent>
#include <QListView>
#include <QStylePainter>
#include <algorithm>

#include "ui/transfer/preset_thumbnail.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {

PresetPicker::PresetPicker(QWidget* parent) : QComboBox(parent) {
  setAccessibleName(tr("Preset"));
  setToolTip(tr("Replaces the transfer function by a preset"));
  setIconSize(kThumbnailSize);
  setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  setMinimumContentsLength(8);
  setPlaceholderText(tr("Custom"));
  for (const std::string& name : renderer::preset_names()) {
    auto one = renderer::preset(name);
    if (!one) continue;
    presets_.push_back(std::move(*one));
    addItem(QString::fromStdString(presets_.back().name));
    setItemData(count() - 1, itemText(count() - 1), Qt::ToolTipRole);
  }
  // Room between the pictures.
  auto* list = new QListView(this);
  list->setSpacing(2);
  list->setIconSize(kThumbnailSize);
  setView(list);
  guard_wheel(this);
  setCurrentIndex(-1);
  draw_pictures();
  connect(this, &QComboBox::activated, this,
          [this](int index) { emit picked(presets_[static_cast<std::size_t>(index)]); });
}

void PresetPicker::set_summary(const engine::SourceSummary& summary) {
  summary_ = summary;
  draw_pictures();
}

void PresetPicker::show_function(const renderer::TransferFunction& function) {
  const auto same = [&](const renderer::TransferFunction& preset) {
    const renderer::TransferFunction own = preset.for_range(summary_.low, summary_.high);
    return own.source == function.source && own.surface == function.surface;
  };
  const auto found = std::find_if(presets_.begin(), presets_.end(), same);
  setCurrentIndex(found == presets_.end() ? -1 : static_cast<int>(found - presets_.begin()));
}

// As the box does it, but with an ellipsis where a name is longer than there is room.
void PresetPicker::paintEvent(QPaintEvent* /*event*/) {
  QStylePainter painter(this);
  QStyleOptionComboBox option;
  initStyleOption(&option);
  if (currentIndex() < 0) option.currentText = placeholderText();
  const QRect field =
      style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this);
  constexpr int kAroundText = 12;
  const int room = field.width() - (option.currentIcon.isNull() ? 0 : iconSize().width()) - kAroundText;
  option.currentText = fontMetrics().elidedText(option.currentText, Qt::ElideRight, room);
  painter.drawComplexControl(QStyle::CC_ComboBox, option);
  painter.drawControl(QStyle::CE_ComboBoxLabel, option);
}

void PresetPicker::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) draw_pictures();
  QComboBox::changeEvent(event);
}

void PresetPicker::draw_pictures() {
  for (int i = 0; i < count(); ++i) {
    const renderer::TransferFunction own =
        presets_[static_cast<std::size_t>(i)].for_range(summary_.low, summary_.high);
    setItemIcon(i, QIcon(preset_thumbnail(own, summary_, palette(), devicePixelRatioF())));
  }
}

}  // namespace tidemark::ui
