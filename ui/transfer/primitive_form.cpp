#include "ui/transfer/primitive_form.h"

#include <QColorDialog>
#include <QGridLayout>
#include <QHBoxLayout>

#include "ui/transfer/primitive_list.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {

PrimitiveForm::PrimitiveForm(PrimitiveKind kind, int axes, QWidget* parent)
    : QWidget(parent), opacity_(new NumberBox(this)), colour_(new QPushButton(this)) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setColumnStretch(1, 1);
  for (int axis = 0; axis < axes; ++axis) {
    auto* name = new QLabel(this);
    auto* editor = new FactorEditor(this);
    name->setBuddy(editor->kind_box());
    name->setMinimumHeight(editor->kind_box()->sizeHint().height());
    grid->addWidget(name, axis, 0, Qt::AlignTop);  // beside the kind
    grid->addWidget(editor, axis, 1);
    names_.push_back(name);
    factors_.push_back(editor);
    connect(editor, &FactorEditor::edited, this, [this, axis](const renderer::TransferFactor& factor) {
      primitive_.factors[static_cast<std::size_t>(axis)] = factor;
      emit edited(primitive_);
    });
  }
  const bool source = kind == PrimitiveKind::source;
  auto* name = new QLabel(source ? tr("Opacity per mm") : tr("Opacity"), this);
  name->setBuddy(opacity_);
  opacity_->setAccessibleName(name->text());
  opacity_->setToolTip(source ? tr("How much of the light one mm takes where the primitive shows fully")
                              : tr("1: nothing is seen through the surface"));
  opacity_->setRange(0.0, source ? 100.0 : 1.0);
  opacity_->setDecimals(4);
  opacity_->setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
  guard_wheel(opacity_);
  opacity_->setMinimumWidth(64);
  opacity_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  colour_->setToolTip(tr("The colour that the primitive gives"));
  auto* row = new QHBoxLayout;
  row->setSpacing(4);
  row->addWidget(opacity_, 1);
  row->addWidget(colour_);
  grid->addWidget(name, axes, 0);
  grid->addLayout(row, axes, 1);
  connect(opacity_, &NumberBox::valueChanged, this, [this](double opacity) {
    primitive_.opacity = opacity;
    emit edited(primitive_);
  });
  connect(colour_, &QPushButton::clicked, this, &PrimitiveForm::choose_colour);
}

void PrimitiveForm::set_axes(const std::vector<PrimitiveAxis>& axes) {
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    const PrimitiveAxis& axis = axes[i];
    names_[i]->setText(axis.unit.isEmpty() ? axis.name : tr("%1 (%2)").arg(axis.name, axis.unit));
    factors_[i]->set_axis(axis);
  }
}

void PrimitiveForm::set_primitive(const std::optional<AxisPrimitive>& primitive) {
  setEnabled(primitive.has_value());
  if (!primitive) {
    if (dialog_) dialog_->reject();
    for (FactorEditor* editor : factors_) editor->set_factor({});
    return;
  }
  primitive_ = *primitive;
  for (std::size_t i = 0; i < factors_.size(); ++i) factors_[i]->set_factor(primitive_.factors[i]);
  show_number(*opacity_, primitive_.opacity);
  const QColor colour = to_qcolor(primitive_.colour);
  colour_->setIcon(colour_swatch(colour, *this));
  colour_->setAccessibleName(tr("Colour %1").arg(colour.name()));
}

void PrimitiveForm::choose_colour() {
  if (dialog_) return;
  const glm::vec3 before = primitive_.colour;
  dialog_ = new QColorDialog(to_qcolor(before), this);
  dialog_->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog_, &QColorDialog::currentColorChanged, this, [this](const QColor& colour) {
    take_colour({colour.redF(), colour.greenF(), colour.blueF()});
  });
  // The exact colour, not the dialog's 8 bits of it.
  connect(dialog_, &QColorDialog::rejected, this, [this, before] { take_colour(before); });
  dialog_->open();
}

void PrimitiveForm::take_colour(const glm::vec3& colour) {
  if (colour == primitive_.colour) return;
  primitive_.colour = colour;
  emit edited(primitive_);
}

}  // namespace tidemark::ui
