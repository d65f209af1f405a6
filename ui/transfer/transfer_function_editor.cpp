#include "ui/transfer/transfer_function_editor.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <utility>

#include "core/atomic_file.h"
#include "engine/message_text.h"
#include "ui/settings.h"
#include "ui/transfer/histogram_plot.h"
#include "ui/transfer/joint_histogram_plot.h"
#include "ui/transfer/panel_scroll.h"
#include "ui/transfer/preset_picker.h"
#include "ui/transfer/primitive_page.h"
#include "ui/widgets/cancel_dialogs.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/save_file.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {
namespace {

// Equality of what the editor shows; it does not depend on the camera.
bool look_the_same(const engine::DisplaySettings& a, const engine::DisplaySettings& b) {
  return a.transfer == b.transfer && a.chosen_primitive == b.chosen_primitive && a.region == b.region &&
         a.clip_on == b.clip_on && a.show_source == b.show_source;
}

}  // namespace

TransferFunctionEditor::TransferFunctionEditor(QWidget* parent)
    : QWidget(parent), message_(new QLabel(this)), tabs_(new QTabWidget(this)) {
  setWindowTitle(tr("Transfer function"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(6, 6, 6, 6);
  top_row_ = make_top_row();
  column->addWidget(top_row_);
  message_->setWordWrap(true);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  message_->setAccessibleName(tr("Message"));
  message_->hide();
  column->addWidget(message_);
  tabs_->addTab(make_volume_tab(), tr("Volume data"));
  tabs_->addTab(make_surface_tab(), tr("Surface"));
  column->addWidget(tabs_, 1);
  set_display(nullptr, nullptr);
}

QWidget* TransferFunctionEditor::make_top_row() {
  auto* row = new QWidget(this);
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  presets_ = new PresetPicker(row);
  auto* load_button = new QPushButton(tr("Load…"), row);
  load_button->setToolTip(tr("Reads a transfer function from a file"));
  save_ = new QPushButton(tr("Save…"), row);
  save_->setToolTip(tr("Writes the transfer function to a file"));
  // One above the other: names of presets are long, and their pictures high.
  auto* buttons = new QVBoxLayout;
  buttons->setSpacing(2);
  buttons->addWidget(load_button);
  buttons->addWidget(save_);
  presets_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  layout->addWidget(presets_, 1);
  layout->addLayout(buttons);
  connect(presets_, &PresetPicker::picked, this, &TransferFunctionEditor::replace);
  connect(load_button, &QPushButton::clicked, this, &TransferFunctionEditor::ask_load);
  connect(save_, &QPushButton::clicked, this, &TransferFunctionEditor::ask_save);
  return row;
}

QWidget* TransferFunctionEditor::make_volume_tab() {
  auto* tab = new QWidget;
  auto* column = new QVBoxLayout(tab);
  column->setContentsMargins(6, 6, 6, 6);
  show_source_ = new QCheckBox(tr("Show the volume in 3D"), tab);
  show_source_->setToolTip(tr("Draws the values of the volume by this function"));
  column->addWidget(show_source_);
  histogram_ = new HistogramPlot;
  joint_ = new JointHistogramPlot(
      tr("Primitives by value and gradient magnitude, over how often both occur together"));
  volume_page_ =
      new PrimitivePage(PrimitiveKind::source, 3, tr("No primitives: nothing of the volume shows."), tab);
  volume_page_->add_plot(tr("Value"), histogram_);
  volume_page_->add_plot(tr("Value × gradient"), joint_);
  column->addWidget(volume_page_, 1);
  region_ = new QComboBox(tab);
  region_->addItem(tr("Everywhere"), static_cast<int>(renderer::Region::everywhere));
  region_->addItem(tr("Only inside"), static_cast<int>(renderer::Region::inside));
  region_->addItem(tr("Only outside"), static_cast<int>(renderer::Region::outside));
  region_->addItem(tr("Everywhere, the inside tinted"), static_cast<int>(renderer::Region::tinted));
  region_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);  // its texts are long
  region_->setMinimumContentsLength(8);
  guard_wheel(region_);
  region_->setAccessibleName(tr("Level set as region of interest"));
  region_->setToolTip(tr("Where the volume shows: the level set is a region of interest"));
  auto* region_name = new QLabel(tr("Level set as region of interest"), tab);
  region_name->setBuddy(region_);
  column->addWidget(region_name);
  column->addWidget(region_);
  connect(show_source_, &QCheckBox::toggled, this, [this](bool on) {
    if (display_) display_->change([&](engine::DisplaySettings& s) { s.show_source = on; });
  });
  connect(region_, &QComboBox::activated, this, [this] {
    const auto region = static_cast<renderer::Region>(region_->currentData().toInt());
    if (display_) display_->change([&](engine::DisplaySettings& s) { s.region = region; });
  });
  connect(volume_page_, &PrimitivePage::edited, this,
          [this](const auto& primitives, int chosen) { edit(PrimitiveKind::source, primitives, chosen); });
  return new PanelScroll(tab);
}

QWidget* TransferFunctionEditor::make_surface_tab() {
  auto* tab = new QWidget;
  auto* column = new QVBoxLayout(tab);
  column->setContentsMargins(6, 6, 6, 6);
  surface_plane_ =
      new JointHistogramPlot(tr("Primitives of the surface by intensity and distance from the clip plane"));
  surface_page_ = new PrimitivePage(PrimitiveKind::surface, 2,
                                    tr("No primitives: the whole surface has its plain colour."), tab);
  surface_page_->add_plot(tr("Intensity × distance"), surface_plane_);
  column->addWidget(surface_page_, 1);
  connect(surface_page_, &PrimitivePage::edited, this,
          [this](const auto& primitives, int chosen) { edit(PrimitiveKind::surface, primitives, chosen); });
  return new PanelScroll(tab);
}

void TransferFunctionEditor::set_display(engine::Display* display, const engine::SourceSummary* summary,
                                         const QString& unit) {
  if (display != display_) cancel_dialogs(*this);
  // A colour that is just being chosen goes back to the case that it belongs to.
  for (PrimitivePage* page : {volume_page_, surface_page_}) page->form()->set_primitive(std::nullopt);
  if (display_) display_->disconnect(this);
  display_ = summary ? display : nullptr;
  summary_ = display_ ? *summary : engine::SourceSummary();
  unit_ = unit;
  surface_chosen_ = 0;
  shown_.reset();
  new_volume_ = true;
  top_row_->setEnabled(!display_.isNull());
  tabs_->setEnabled(!display_.isNull());
  if (display_.isNull()) {
    for (PrimitivePage* page : {volume_page_, surface_page_}) page->set_primitives({}, -1);
    presets_->setCurrentIndex(-1);
    return say(tr("Open a study to choose how its volume and its surface show."));
  }
  say({});
  connect(display_, &engine::Display::changed, this, &TransferFunctionEditor::refresh);
  connect(display_, &QObject::destroyed, this, [this] { set_display(nullptr, nullptr); });
  refresh();
}

void TransferFunctionEditor::showEvent(QShowEvent* event) {
  QWidget::showEvent(event);
  refresh();
}

void TransferFunctionEditor::show_volume() {
  presets_->set_summary(summary_);
  histogram_->set_counts(summary_.values, {summary_.lowest, summary_.highest});
  joint_->set_counts(summary_.value_gradient, engine::SourceSummary::kBins, {summary_.low, summary_.high},
                     {0.0, summary_.steepest});
}

void TransferFunctionEditor::refresh_axes() {
  const double low = summary_.low;
  const double high = summary_.high;
  const double margin = 0.05 * (high - low);
  const QString slope = unit_.isEmpty() ? QString() : tr("%1/mm").arg(unit_);
  const PrimitiveAxis value{tr("Value"), unit_, low - margin, high + margin, {}};
  volume_page_->set_axes({value,
                          {tr("Gradient"), slope, 0.0, summary_.steepest, {}},
                          {tr("Inside"), tr("voxels"), -2.0, 2.0, {}}});
  const QString why = tr("Without a clip plane every distance is 0: switch it on to use the distance axis.");
  constexpr double kUsualDistance = 50.0;
  surface_page_->set_axes(
      {{tr("Intensity"), unit_, value.low, value.high, {}},
       {tr("Distance"), tr("mm"), 0.0, kUsualDistance, display_->settings().clip_on ? QString() : why}});
}

void TransferFunctionEditor::refresh() {
  if (!display_ || !isVisible()) return;
  const engine::DisplaySettings& now = display_->settings();
  if (shown_ && look_the_same(*shown_, now)) return;
  const bool is_new = std::exchange(new_volume_, false);
  if (is_new) show_volume();
  const bool new_axes = !shown_ || now.clip_on != shown_->clip_on;
  shown_ = now;
  if (new_axes) refresh_axes();
  const renderer::TransferFunction function = now.transfer.for_range(summary_.low, summary_.high);
  volume_page_->set_primitives(primitives_of(function, PrimitiveKind::source), now.chosen_primitive);
  surface_page_->set_primitives(primitives_of(function, PrimitiveKind::surface), surface_chosen_);
  presets_->show_function(function);
  save_->setEnabled(!function.source.empty() || !function.surface.empty());
  const QSignalBlocker quiet(show_source_);
  show_source_->setChecked(now.show_source);
  region_->setCurrentIndex(region_->findData(static_cast<int>(now.region)));
  if (!is_new) return;
  volume_page_->reset_zoom();
  surface_page_->reset_zoom();
}

void TransferFunctionEditor::edit(PrimitiveKind kind, const std::vector<AxisPrimitive>& primitives,
                                  int chosen) {
  if (!display_) return;
  if (kind == PrimitiveKind::surface) {
    surface_chosen_ = chosen;
    shown_.reset();
  }
  display_->change([&](engine::DisplaySettings& s) {
    renderer::TransferFunction next = s.transfer.for_range(summary_.low, summary_.high);
    if (primitives_of(next, kind) != primitives) {
      set_primitives(next, kind, primitives);
      s.transfer = next;
    }
    if (kind == PrimitiveKind::source) s.chosen_primitive = chosen;
  });
  refresh();
}

void TransferFunctionEditor::replace(const renderer::TransferFunction& function) {
  if (!display_) return;
  say({});
  surface_chosen_ = 0;
  display_->change([&](engine::DisplaySettings& s) {
    s.transfer = function;
    s.chosen_primitive = 0;
    // A user who chooses a function wants to see its effect.
    if (!function.source.empty()) s.show_source = true;
  });
}

void TransferFunctionEditor::say(const QString& message) {
  message_->setText(message);
  message_->setVisible(!message.isEmpty());
}

void TransferFunctionEditor::load(const std::filesystem::path& file) {
  const auto function = renderer::TransferFunction::load(file);
  if (!function) return say(engine::message_text(function.error()));
  replace(*function);
}

void TransferFunctionEditor::save(const std::filesystem::path& file) {
  if (!display_) return;
  renderer::TransferFunction function = display_->settings().transfer;
  function.name = file.stem().string();
  const Status written = write_file(file, function.to_json());
  say(written ? QString() : engine::message_text(written.error()));
}

void TransferFunctionEditor::ask_load() {
  const QString file =
      QFileDialog::getOpenFileName(this, tr("Load transfer function"), settings::save_folder().get(),
                                   tr("Transfer functions (*.json);;All files (*)"));
  if (!file.isEmpty()) load(path_of(file));
}

void TransferFunctionEditor::ask_save() {
  const QString file =
      ask_where_to_save(*this, tr("Save transfer function"), {}, tr("Transfer functions (*.json)"));
  if (!file.isEmpty()) save(path_of(file));
}

}  // namespace tidemark::ui
