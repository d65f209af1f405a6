#include "ui/panels/sweep_axis_choice.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "solver/speed/speed_registry.h"
#include "ui/look/theme.h"
#include "ui/widgets/number_box.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {
namespace {

constexpr int kValues = 5;           // suggested
constexpr double kFarApart = 100.0;  // what a slider would not go through evenly

NumberBox* make_number(const QString& name, const QString& tip) {
  auto* box = new NumberBox;
  box->setRange(-1e6, 1e6);
  box->setButtonSymbols(QAbstractSpinBox::NoButtons);
  box->setMinimumWidth(1);
  box->setAccessibleName(name);
  box->setToolTip(tip);
  return box;
}

// The registry's entry of FUNCTION.NAME; null: it is none of a speed function.
const solver::SpeedParameter* number_of(const std::string& parameter) {
  const std::size_t dot = parameter.find('.');
  if (dot == std::string::npos) return nullptr;
  const solver::SpeedKind* kind = solver::speed_kind(parameter.substr(0, dot));
  if (!kind) return nullptr;
  const auto found = std::ranges::find_if(
      kind->parameters, [&](const auto& number) { return parameter.substr(dot + 1) == number.name; });
  return found == kind->parameters.end() ? nullptr : &*found;
}

struct Span {
  double from;
  double to;
};
Span around(const std::string& parameter, const solver::Parameters& parameters,
            const solver::SpeedSetting& setting) {
  if (parameter == "alpha") return {0.2, 0.9};
  if (parameter == "rescale") return {0.1, 0.5};
  if (parameter == "range") return {0.4 * parameters.range, 1.6 * parameters.range};
  if (parameter == "target") {
    return {parameters.target - 0.5 * parameters.range, parameters.target + 0.5 * parameters.range};
  }
  const solver::SpeedParameter* number = number_of(parameter);
  if (!number) return {0.0, 1.0};
  if (number->high - number->low <= kFarApart) return {number->low, number->high};
  const double value = document::parameter_of(parameter, parameters, setting).value_or(number->initial);
  return {std::max(number->low, 0.5 * value), std::min(number->high, std::max(2.0 * value, 1.0))};
}

}  // namespace

QString sweep_parameter_text(const std::string& parameter) {
  if (parameter == "alpha") return QStringLiteral("α");
  if (parameter == "range") return QStringLiteral("ε");
  if (parameter == "target") return QStringLiteral("T");
  if (parameter == "rescale") return SweepAxisChoice::tr("w, rescaling");
  const solver::SpeedParameter* number = number_of(parameter);
  if (!number) return QString::fromStdString(parameter);
  const solver::SpeedKind* kind = solver::speed_kind(parameter.substr(0, parameter.find('.')));
  const auto translated = [](const char* text) { return QCoreApplication::translate("Speed", text); };
  return QStringLiteral("%1: %2").arg(translated(kind->title), translated(number->title));
}

SweepAxisChoice::SweepAxisChoice(const QString& name, bool optional, QWidget* parent)
    : QWidget(parent),
      parameter_(new QComboBox),
      from_(make_number(tr("%1: first value").arg(name), tr("The first value."))),
      to_(make_number(tr("%1: last value").arg(name), tr("The last value."))),
      count_(new NumberBox),
      optional_(optional) {
  parameter_->setAccessibleName(name);
  parameter_->setToolTip(tr("The parameter that takes several values."));
  parameter_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  parameter_->setMinimumContentsLength(6);
  parameter_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  count_->setDecimals(0);
  count_->setRange(2, document::SweepAxis::kMostValues);
  count_->setValue(kValues);
  count_->setPrefix(QStringLiteral("× "));
  count_->setAccessibleName(tr("%1: number of values").arg(name));
  count_->setToolTip(tr("How many values, evenly from the first to the last."));
  guard_wheel(parameter_);
  guard_wheel(count_);
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpaceTight);
  column->addWidget(parameter_);
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpaceTight);
  row->addWidget(from_, 1);
  row->addWidget(new QLabel(QStringLiteral("–")));
  row->addWidget(to_, 1);
  row->addWidget(count_);
  column->addLayout(row);
  connect(parameter_, &QComboBox::activated, this, [this] {
    enable_numbers();
    emit parameter_chosen(parameter_->currentData().toString());
  });
}

void SweepAxisChoice::enable_numbers() {
  const bool chosen = !parameter_->currentData().toString().isEmpty();
  for (QWidget* number :
       {static_cast<QWidget*>(from_), static_cast<QWidget*>(to_), static_cast<QWidget*>(count_)})
    number->setEnabled(chosen);
}

void SweepAxisChoice::set_setting(const solver::SpeedSetting& setting) {
  if (parameter_->count() > 0 && setting == setting_) return;
  setting_ = setting;
  const QString chosen = parameter_->currentData().toString();
  parameter_->clear();
  if (optional_) parameter_->addItem(tr("no other"), QString());
  for (const std::string& name : document::sweep_parameters(setting))
    parameter_->addItem(sweep_parameter_text(name), QString::fromStdString(name));
  parameter_->setCurrentIndex(std::max(0, parameter_->findData(chosen)));
  enable_numbers();
}

void SweepAxisChoice::suggest(const std::string& parameter, const solver::Parameters& parameters) {
  const Span span = around(parameter, parameters, setting_);
  const int decimals = decimals_for(span.to - span.from);
  for (NumberBox* box : {from_, to_}) box->setDecimals(decimals);
  show_axis(
      document::SweepAxis{parameter, rounded(span.from, decimals), rounded(span.to, decimals), count()});
}

void SweepAxisChoice::show_axis(const std::optional<document::SweepAxis>& axis) {
  const QString parameter = axis ? QString::fromStdString(axis->parameter) : QString();
  if (const int index = parameter_->findData(parameter); index >= 0) parameter_->setCurrentIndex(index);
  if (axis) {
    const int decimals = decimals_for(axis->to - axis->from);
    for (NumberBox* box : {from_, to_}) box->setDecimals(std::max(box->decimals(), decimals));
    from_->show_value(axis->from);
    to_->show_value(axis->to);
    count_->setValue(axis->count);
  }
  enable_numbers();
}

int SweepAxisChoice::count() const {
  return static_cast<int>(std::lround(count_->value()));
}

std::optional<document::SweepAxis> SweepAxisChoice::axis() const {
  const std::string parameter = parameter_->currentData().toString().toStdString();
  if (parameter.empty()) return std::nullopt;
  return document::SweepAxis{parameter, from_->value(), to_->value(), count()};
}

}  // namespace tidemark::ui
