#include "ui/panels/image_controls.h"

#include <QBoxLayout>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <QSignalBlocker>
#include <QToolButton>
#include <cmath>

#include "ui/panels/registration_dialog.h"
#include "ui/panels/value_unit.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {
namespace {

constexpr double kFarFromImage = 1000.0;  // windows may lie far from what an image holds
constexpr int kRows = 3;                  // of the list

}  // namespace

ImageControls::ImageControls(QWidget* parent) : CaseWidget(parent), content_(new QWidget(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins({});
  layout->addWidget(content_);
  Form form(content_);
  form.heading(tr("Images over the slices"));
  add_list(form);
  add_numbers(form);
  content_->hide();
}

void ImageControls::add_list(Form& form) {
  list_ = new QListWidget;
  list_->setAccessibleName(tr("Images over the slices"));
  list_->setToolTip(tr("Images with a check mark are shown, the last one on top."));
  list_->setFixedHeight(kRows * (fontMetrics().lineSpacing() + 8));
  form.wide(list_);
  connect(list_, &QListWidget::currentRowChanged, this, [this] { show_chosen(); });
  connect(list_, &QListWidget::itemChanged, this, [this](const QListWidgetItem* item) {
    const auto row = static_cast<std::size_t>(list_->row(item));
    const bool visible = item->checkState() == Qt::Checked;
    change_display([=](engine::DisplaySettings& settings) {
      if (row < settings.images.size()) settings.images[row].visible = visible;
    });
  });
  place_ = form.note({});
  register_ = new QToolButton;
  register_->setText(tr("Register image…"));
  register_->setToolTip(
      tr("Turns and shifts the chosen image onto the study; you see it before you accept."));
  register_->setAccessibleName(tr("Register image"));
  register_->setFocusPolicy(Qt::StrongFocus);
  connect(register_, &QToolButton::clicked, this, [this] {
    if (const engine::ShownImage* image = chosen()) {
      (new RegistrationDialog(*proxy(), *image, window()))->open();
    }
  });
  remove_ = new QToolButton;
  remove_->setText(tr("Remove image"));
  remove_->setToolTip(tr("Takes the chosen image out of the case; its file stays."));
  remove_->setAccessibleName(remove_->text());
  remove_->setFocusPolicy(Qt::StrongFocus);
  auto* buttons = new QHBoxLayout;
  buttons->addWidget(register_);
  buttons->addWidget(remove_);
  buttons->addStretch();
  form.wide(buttons);
  connect(remove_, &QToolButton::clicked, this, [this] {
    const int row = list_->currentRow();
    change_display([=](engine::DisplaySettings& settings) {
      if (row >= 0 && row < static_cast<int>(settings.images.size())) {
        settings.images.erase(settings.images.begin() + row);
      }
    });
  });
}

void ImageControls::add_numbers(Form& form) {
  used_ = form.check(tr("Used by the speed function"),
                     tr("Examples learn from the chosen image, too, on the voxels of the study."));
  connect(used_, &QCheckBox::clicked, this,
          [this](bool used) { change_chosen([=](engine::ShownImage& image) { image.used = used; }); });
  colours_ = form.choice(tr("Colours"), tr("Of the chosen image. Hot and cool let low values fade away."));
  colours_->addItems({tr("Grey"), tr("Inverted grey"), tr("Hot"), tr("Cool")});
  connect(colours_, &QComboBox::activated, this, [this](int index) {
    change_chosen(
        [=](engine::ShownImage& image) { image.colours = static_cast<engine::ImageColours>(index); });
  });
  opacity_ = form.slider(tr("Image opacity"), tr("Of the chosen image over what is below it."));
  opacity_->set_decimals(0);
  opacity_->set_range(0.0, 100.0);
  opacity_->set_unit(QStringLiteral("%"));
  connect(opacity_, &SliderNumber::edited, this, [this](double value) {
    change_chosen([=](engine::ShownImage& image) { image.opacity = value / 100.0; });
  });
  width_ = form.slider(tr("Image width"), tr("From the lowest colour to the highest."));
  level_ = form.slider(tr("Image level"), tr("The middle of the colours."));
  connect(width_, &SliderNumber::edited, this, [this](double value) {
    change_chosen([=](engine::ShownImage& image) { image.window.width = value; });
  });
  connect(level_, &SliderNumber::edited, this, [this](double value) {
    change_chosen([=](engine::ShownImage& image) { image.window.centre = value; });
  });
  swipe_ = form.check(tr("Swipe line"), tr("Left of the line slices show the study alone, right of it with "
                                           "the images. Drag it in a slice."));
  connect(swipe_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.swipe = on; });
  });
}

template <class Change>
void ImageControls::change_chosen(Change&& apply) {
  const int row = list_->currentRow();
  change_display([&](engine::DisplaySettings& settings) {
    if (row >= 0 && row < static_cast<int>(settings.images.size())) {
      apply(settings.images[static_cast<std::size_t>(row)]);
    }
  });
}

const engine::ShownImage* ImageControls::chosen() const {
  if (!proxy()) return nullptr;
  const auto& images = proxy()->display().settings().images;
  const int row = list_->currentRow();
  return row >= 0 && row < static_cast<int>(images.size()) ? &images[static_cast<std::size_t>(row)] : nullptr;
}

void ImageControls::attach() {
  ranged_.reset();
  if (!proxy()) content_->hide();
}

void ImageControls::refresh() {
  if (!proxy()) return;
  fill_list();
  swipe_->setChecked(proxy()->display().settings().swipe);
  content_->setVisible(list_->count() > 0);
  show_chosen();
}

void ImageControls::fill_list() {
  const auto& images = proxy()->display().settings().images;
  const QSignalBlocker quiet(list_);
  const auto count = static_cast<int>(images.size());
  const bool grown = list_->count() < count;
  while (list_->count() > count) delete list_->takeItem(list_->count() - 1);
  while (list_->count() < count) list_->addItem(new QListWidgetItem);
  for (int row = 0; row < count; ++row) {
    const engine::ShownImage& image = images[static_cast<std::size_t>(row)];
    QListWidgetItem* item = list_->item(row);
    const QString name = QString::fromStdString(image.image->name);
    item->setText(image.image->volume ? name : tr("%1 (not found)").arg(name));
    item->setCheckState(image.visible ? Qt::Checked : Qt::Unchecked);
  }
  if (grown || list_->currentRow() < 0) list_->setCurrentRow(count - 1);
}

void ImageControls::show_chosen() {
  const engine::ShownImage* image = chosen();
  if (!image) return;
  used_->setChecked(image->used);
  const bool is_there = image->image->volume != nullptr;
  for (QWidget* control : std::initializer_list<QWidget*>{colours_, opacity_, width_, level_, register_})
    control->setEnabled(is_there);
  if (!is_there) {
    place_->setText(tr("Its file is not where it was. Add it again, or remove it."));
    return;
  }
  if (ranged_ != image->image) {
    ranged_ = image->image;
    const auto [low, high] = ranged_->volume->common_range();
    const double span = span_between(low, high);
    const int decimals = decimals_for(span);
    const double smallest = std::pow(10.0, -decimals);
    for (SliderNumber* number : {width_, level_}) {
      number->set_decimals(decimals);
      number->set_unit(value_unit(*ranged_->volume));
    }
    width_->set_range(std::max(smallest, span / 500.0), 1.5 * span, smallest, kFarFromImage * span,
                      SliderNumber::Scale::logarithmic);
    level_->set_range(low, high, static_cast<double>(low) - kFarFromImage * span,
                      static_cast<double>(high) + kFarFromImage * span);
  }
  place_->setText(engine::is_placed(*image->image, proxy()->study())
                      ? image->image->to_case != glm::dmat4(1.0)
                            ? tr("In place: it was registered.")
                            : tr("In place: it has the study's frame of reference.")
                      : tr("Its place is not sure: no common frame of reference is known."));
  colours_->setCurrentIndex(static_cast<int>(image->colours));
  opacity_->set_value(100.0 * image->opacity);
  width_->set_value(image->window.width);
  level_->set_value(image->window.centre);
}

}  // namespace tidemark::ui
