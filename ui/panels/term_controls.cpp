#include "ui/panels/term_controls.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {
namespace {

constexpr double kWide = 100.0;  // high / low from which on a slider is logarithmic

}  // namespace

TermControls::TermControls(const QString& title, const solver::SpeedKind& kind, bool removable,
                           QWidget* parent)
    : QWidget(parent), kind_(&kind) {
  Form form(this);
  add_choice(form, title, removable);
  form.note(tr(kind.text))->setForegroundRole(QPalette::PlaceholderText);
  add_numbers(form);
}

void TermControls::add_choice(Form& form, const QString& title, bool removable) {
  auto* line = new QWidget;
  auto* row = new QHBoxLayout(line);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpaceTight);
  choice_ = new QComboBox;
  choice_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  choice_->setMinimumContentsLength(6);
  choice_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  guard_wheel(choice_);
  for (const solver::SpeedKind& kind : solver::speed_kinds()) {
    choice_->addItem(tr(kind.title), QString::fromLatin1(kind.name));
    choice_->setItemData(choice_->count() - 1, tr(kind.text), Qt::ToolTipRole);
  }
  choice_->setCurrentIndex(choice_->findData(QString::fromLatin1(kind_->name)));
  connect(choice_, &QComboBox::activated, this, [this] {
    const QString chosen = choice_->currentData().toString();
    // What is shown follows the case, which may not take it.
    choice_->setCurrentIndex(choice_->findData(QString::fromLatin1(kind_->name)));
    if (chosen != QLatin1String(kind_->name)) emit function_chosen(chosen);
  });
  row->addWidget(choice_, 1);
  if (removable) {
    auto* remove = new QToolButton;
    remove->setIcon(icon(u"remove"));
    remove->setAutoRaise(true);
    remove->setFocusPolicy(Qt::StrongFocus);
    remove->setToolTip(tr("The surface is driven by the others alone."));
    remove->setAccessibleName(tr("Remove %1").arg(tr(kind_->title)));
    connect(remove, &QToolButton::clicked, this, &TermControls::remove_wanted);
    row->addWidget(remove);
  }
  form.row(title, line, tr(kind_->text));
  line->setAccessibleName({});
  choice_->setAccessibleName(title);
  choice_->setToolTip(tr(kind_->text));
}

void TermControls::add_numbers(Form& form) {
  for (const solver::SpeedParameter& parameter : kind_->parameters)
    parameter.choices.empty() ? add_number(form, parameter) : add_words(form, parameter);
}

void TermControls::add_number(Form& form, const solver::SpeedParameter& parameter) {
  SliderNumber* number = form.slider(tr(parameter.title), tr(parameter.text));
  const double span = parameter.high - parameter.low;
  const bool is_wide = parameter.low > 0.0 && parameter.high / parameter.low >= kWide;
  number->set_decimals(is_wide ? std::max(decimals_for(span), decimals_for(100.0 * parameter.low))
                               : decimals_for(span));
  number->set_range(parameter.low, parameter.high,
                    is_wide ? SliderNumber::Scale::logarithmic : SliderNumber::Scale::linear);
  number->set_unit(tr(parameter.unit));
  number->set_value(parameter.initial);
  connect(number, &SliderNumber::edited, this,
          [this, name = QString::fromLatin1(parameter.name)](double value, std::uint64_t gesture) {
            emit number_edited(name, value, gesture);
          });
  show_.emplace_back([number](double value) { number->set_value(value); });
}

void TermControls::add_words(Form& form, const solver::SpeedParameter& parameter) {
  QComboBox* words = form.choice(tr(parameter.title), tr(parameter.text));
  for (const solver::SpeedChoice& choice : parameter.choices) words->addItem(tr(choice.title));
  connect(words, &QComboBox::activated, this,
          [this, name = QString::fromLatin1(parameter.name), low = parameter.low](int index) {
            emit number_edited(name, low + index, 0);
          });
  show_.emplace_back(
      [words, low = parameter.low](double value) { words->setCurrentIndex(qRound(value - low)); });
}

void TermControls::set_values(const std::map<std::string, double>& values) {
  for (std::size_t i = 0; i < show_.size(); ++i) {
    const solver::SpeedParameter& parameter = kind_->parameters[i];
    const auto given = values.find(parameter.name);
    show_[i](given == values.end() ? parameter.initial : given->second);
  }
}

}  // namespace tidemark::ui
