#include "ui/lessons/parameter_rows.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QVBoxLayout>
#include <cmath>
#include <limits>

#include "ui/lessons/text_box.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {

using solver::Parameters;

namespace {

constexpr int kNameWidth = 150;  // so that the rows of lesson and parts share a column
constexpr int kEditorWidth = 180;

}  // namespace

ParameterRows::ParameterRows(std::size_t always, QWidget* parent)
    : QWidget(parent),
      always_(always),
      rows_(new RowGrid({tr("Parameter"), tr("Value"), QString()}, 3)),
      add_(new QPushButton(icon(u"add"), tr("Change a parameter"))),
      menu_(new QMenu(add_)) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpaceTight);
  column->addWidget(rows_);
  column->addWidget(add_, 0, Qt::AlignLeft);
  add_->setAutoDefault(false);
  add_->setToolTip(tr("Gives another parameter a value of its own here."));
  add_->setMenu(menu_);
  connect(menu_, &QMenu::aboutToShow, this, &ParameterRows::fill_menu);
}

void ParameterRows::show_parameters(Parameters* parameters, const Parameters& base) {
  if (parameters != parameters_) opened_.clear();
  parameters_ = parameters;
  base_ = base;
  fill();
}

void ParameterRows::fill() {
  rows_->clear();
  if (parameters_ == nullptr) return;
  const auto all = named_parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i < always_ || opened_.contains(i) || !all[i].is_same(*parameters_, base_)) add_row(i);
  }
}

void ParameterRows::fill_menu() {
  menu_->clear();
  if (parameters_ == nullptr) return;
  const auto all = named_parameters();
  for (std::size_t i = always_; i < all.size(); ++i) {
    if (opened_.contains(i) || !all[i].is_same(*parameters_, base_)) continue;
    menu_->addAction(all[i].title_text(), this, [this, i] {
      opened_.insert(i);
      fill();
    });
  }
}

void ParameterRows::add_row(std::size_t index) {
  const NamedParameter& parameter = named_parameters()[index];
  auto* name = new QLabel(parameter.title_text());
  name->setToolTip(parameter.tip_text());
  QWidget* editor = make_editor(parameter);
  name->setBuddy(editor);
  name->setMinimumWidth(kNameWidth);
  editor->setMinimumWidth(kEditorWidth);
  if (index < always_) return rows_->add({name, editor, new QWidget});
  auto* remove = make_remove_button(tr("Take back: %1").arg(parameter.title_text()));
  connect(remove, &QToolButton::clicked, this, [this, index] {
    named_parameters()[index].copy(base_, *parameters_);
    opened_.erase(index);
    fill();
    emit edited();
  });
  rows_->add({name, editor, remove});
}

QWidget* ParameterRows::make_editor(const NamedParameter& parameter) {
  if (const auto* number = std::get_if<double Parameters::*>(&parameter.member))
    return make_number(parameter, *number);
  if (const auto* number = std::get_if<std::optional<double> Parameters::*>(&parameter.member))
    return make_optional(parameter, *number);
  if (const auto* flag = std::get_if<bool Parameters::*>(&parameter.member)) {
    return make_choice(parameter, {tr("off"), tr("on")}, parameters_->*(*flag) ? 1 : 0,
                       [this, member = *flag](int index) { parameters_->*member = index == 1; });
  }
  if (const auto* scheme = std::get_if<solver::Scheme Parameters::*>(&parameter.member)) {
    return make_choice(
        parameter, {tr("Split"), tr("Paper")}, static_cast<int>(parameters_->*(*scheme)),
        [this, member = *scheme](int index) { parameters_->*member = static_cast<solver::Scheme>(index); });
  }
  const auto form = std::get<solver::DataForm Parameters::*>(parameter.member);
  return make_choice(parameter, {tr("Clamped"), tr("Raw")}, static_cast<int>(parameters_->*form),
                     [this, form](int index) { parameters_->*form = static_cast<solver::DataForm>(index); });
}

QWidget* ParameterRows::make_number(const NamedParameter& parameter, double Parameters::*member) {
  NumberBox* box = make_number_box(parameter.low, parameter.high, parameter.decimals);
  show_number(*box, parameters_->*member, parameter.decimals);
  box->setAccessibleName(parameter.title_text());
  box->setToolTip(parameter.tip_text());
  connect(box, &NumberBox::valueChanged, this, [this, member](double value) {
    parameters_->*member = value;
    emit edited();
  });
  return box;
}

// Unset, a number, or infinite.
QWidget* ParameterRows::make_optional(const NamedParameter& parameter,
                                      std::optional<double> Parameters::*member) {
  enum { by_itself, number, infinite };
  const std::optional<double> value = parameters_->*member;
  auto* whole = new QWidget;
  auto* row = new QHBoxLayout(whole);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpaceTight);
  NumberBox* box = make_number_box(parameter.low, parameter.high, parameter.decimals);
  const double shown = value && std::isfinite(*value) ? *value : parameter.low;
  show_number(*box, shown, parameter.decimals);
  QStringList words{tr("by itself"), tr("number")};
  if (member == &Parameters::band) words << tr("no limit");
  QWidget* kind = make_choice(
      parameter, words,
      !value                  ? by_itself
      : std::isfinite(*value) ? number
                              : infinite,
      [this, box, member](int index) {
        box->setEnabled(index == number);
        parameters_->*member = index == by_itself ? std::nullopt
                               : index == number  ? std::optional(box->value())
                                                  : std::optional(std::numeric_limits<double>::infinity());
      });
  box->setEnabled(value && std::isfinite(*value));
  box->setAccessibleName(tr("%1, as a number").arg(parameter.title_text()));
  box->setToolTip(parameter.tip_text());
  connect(box, &NumberBox::valueChanged, this, [this, member](double typed) {
    parameters_->*member = typed;
    emit edited();
  });
  row->addWidget(kind, 1);
  row->addWidget(box, 1);
  whole->setFocusProxy(kind);
  return whole;
}

QWidget* ParameterRows::make_choice(const NamedParameter& parameter, const QStringList& words, int index,
                                    const std::function<void(int)>& set) {
  auto* choice = new QComboBox;
  choice->addItems(words);
  choice->setCurrentIndex(index);
  choice->setAccessibleName(parameter.title_text());
  choice->setToolTip(parameter.tip_text());
  guard_wheel(choice);
  connect(choice, &QComboBox::activated, this, [this, set](int chosen) {
    set(chosen);
    emit edited();
  });
  return choice;
}

}  // namespace tidemark::ui
