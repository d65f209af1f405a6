#include "ui/panels/refine_choice.h"

#include <QCheckBox>

#include "ui/widgets/form.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {
namespace {

constexpr double kLeastRefined = 0.2;  // mm
constexpr double kMostRefined = 30.0;
constexpr double kUsual = 3.0;

}  // namespace

RefineChoice::RefineChoice(QWidget* parent) : QWidget(parent) {
  Form form(this);
  refine_ = form.check(tr("Refine it alone"),
                       tr("The surface never moves farther from the mask's than the number below says, "
                          "outwards or inwards. Colours show what has changed."));
  within_ = add_number(form);
  within_->setEnabled(false);
  connect(refine_, &QCheckBox::toggled, within_, &QWidget::setEnabled);
  connect(refine_, &QCheckBox::toggled, this, &RefineChoice::changed);
  connect(within_, &SliderNumber::edited, this, &RefineChoice::changed);
}

SliderNumber* RefineChoice::add_number(Form& form) {
  SliderNumber* number = form.slider(
      tr("Stay within"), tr("How far a refined mask's surface may move from where it began, to both sides."));
  number->set_decimals(1);
  number->set_range(kLeastRefined, kMostRefined, SliderNumber::Scale::logarithmic);
  number->set_unit(tr("mm"));
  number->set_value(kUsual);
  return number;
}

std::optional<double> RefineChoice::within_mm() const {
  if (!refine_->isChecked()) return std::nullopt;
  return within_->value();
}

}  // namespace tidemark::ui
