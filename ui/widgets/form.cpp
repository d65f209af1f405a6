#include "ui/widgets/form.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <memory>

#include "ui/look/theme.h"
#include "ui/widgets/number_box.h"
#include "ui/widgets/slider_number.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {

namespace {

constexpr int kLabelWidth = 92;  // so that the parts of a panel share a column

}  // namespace

QLabel* make_note(const QString& text) {
  auto* note = new QLabel(text);
  note->setWordWrap(true);
  note->setTextFormat(Qt::PlainText);
  note->setTextInteractionFlags(Qt::TextSelectableByMouse);
  // A long word must not make the panel wider.
  note->setMinimumWidth(1);
  return note;
}

void show_row(QFormLayout& rows, QWidget* widget, bool shown) {
  if (!shown && rows.isRowVisible(widget)) {
    // A hidden row keeps its place in Qt's layout, where it takes the height of the row that is shown there.
    int at = 0;
    QFormLayout::ItemRole role{};
    rows.getWidgetPosition(widget, &at, &role);
    const QFormLayout::TakeRowResult taken = rows.takeRow(at);
    const std::unique_ptr<QLayoutItem> label(taken.labelItem);
    const std::unique_ptr<QLayoutItem> field(taken.fieldItem);
    if (label) {
      rows.insertRow(at, label->widget(), widget);
    } else {
      rows.insertRow(at, widget);
    }
  }
  rows.setRowVisible(widget, shown);
}

Form::Form(QWidget* on) : layout_(new QFormLayout(on)) {
  layout_->setContentsMargins(0, 0, 0, 0);
  layout_->setHorizontalSpacing(kSpace);
  layout_->setVerticalSpacing(kSpaceTight + 2);
  layout_->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
  layout_->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
}

QLabel* Form::heading(const QString& text) {
  auto* label = new QLabel(text);
  QFont font = label->font();
  font.setBold(true);
  label->setFont(font);
  label->setContentsMargins(0, layout_->rowCount() == 0 ? 0 : kSpaceGroups - kSpaceTight, 0, 0);
  layout_->addRow(label);
  return label;
}

void Form::row(const QString& label, QWidget* widget, const QString& tip) {
  auto* text = new QLabel(label);
  text->setBuddy(widget);
  text->setToolTip(tip);
  text->setMinimumWidth(kLabelWidth);
  widget->setToolTip(tip);
  widget->setAccessibleName(label);
  layout_->addRow(text, widget);
}

void Form::wide(QWidget* widget) {
  layout_->addRow(widget);
}

void Form::wide(QLayout* layout) {
  layout_->addRow(layout);
}

QLabel* Form::note(const QString& text) {
  auto* note = make_note(text);
  layout_->addRow(note);
  return note;
}

QLabel* Form::figure(const QString& label, const QString& tip) {
  auto* figure = new QLabel;
  figure->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  figure->setTextInteractionFlags(Qt::TextSelectableByMouse);
  figure->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
  figure->setToolTip(tip);
  figure->setAccessibleName(label);
  auto* text = new QLabel(label);
  text->setToolTip(tip);
  // Not in the column of labels: these may be long, and the numbers stand at the right in any case.
  auto* line = new QHBoxLayout;
  line->setSpacing(kSpace);
  line->addWidget(text);
  line->addWidget(figure, 1);
  layout_->addRow(line);
  return figure;
}

SliderNumber* Form::slider(const QString& label, const QString& tip) {
  auto* slider = new SliderNumber;
  row(label, slider, tip);
  slider->set_name(label, tip);
  return slider;
}

void Form::ends_of(const SliderNumber& slider, const QString& low, const QString& high) {
  auto* words = new QWidget;
  auto* row = new QHBoxLayout(words);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(0);
  const auto word = [row](const QString& text) {
    auto* label = new QLabel(text);
    label->setForegroundRole(QPalette::PlaceholderText);
    row->addWidget(label);
    return label->sizeHint().width();
  };
  word(low);
  row->addStretch(1);
  const int width = word(high);
  // The second one has its middle below the slider's end, as far as there is room for both.
  row->addSpacerItem(
      new QSpacerItem(slider.number()->minimumWidth() + kSpace - width / 2, 0, QSizePolicy::Maximum));
  layout_->setWidget(layout_->rowCount(), QFormLayout::FieldRole, words);
}

QCheckBox* Form::check(const QString& text, const QString& tip) {
  auto* check = new QCheckBox(text);
  check->setToolTip(tip);
  layout_->addRow(check);
  return check;
}

QComboBox* Form::choice(const QString& label, const QString& tip) {
  auto* choice = new QComboBox;
  choice->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  choice->setMinimumContentsLength(6);
  choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  guard_wheel(choice);
  row(label, choice, tip);
  return choice;
}

}  // namespace tidemark::ui
