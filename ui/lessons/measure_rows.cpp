#include "ui/lessons/measure_rows.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "ui/lessons/lesson_text.h"
#include "ui/lessons/text_box.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {
namespace {

constexpr double kLargestFigure = 1e12;
constexpr double kTolerance = 5.0;  // percent

const document::LessonFigure& figure_of(const document::LessonMeasure& measure) {
  const document::LessonFigure* figure = document::lesson_figure(measure.figure);
  return figure != nullptr ? *figure : document::lesson_figures().front();
}

}  // namespace

document::LessonMeasure measure_around(const document::LessonFigure& figure, double value, double percent) {
  document::LessonMeasure measure;
  measure.figure = figure.name;
  const double off = std::abs(value) * percent / 100.0;
  const double scale = std::pow(10.0, figure.digits);
  if (figure.digits == 0) {
    measure.low = std::round(value - off);
    measure.high = std::round(value + off);
  } else {
    measure.low = std::floor((value - off) * scale) / scale;
    measure.high = std::ceil((value + off) * scale) / scale;
  }
  return measure;
}

MeasureRows::MeasureRows(QWidget* parent)
    : QWidget(parent),
      rows_(new RowGrid({tr("Figure"), tr("From"), tr("To"), tr("Measured"), QString()}, 0)),
      add_(new QPushButton(icon(u"add"), tr("Add a figure"))),
      tolerance_(make_number_box(0.0, 100.0, 1)),
      measure_(new QPushButton(tr("&Measure"))) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpaceTight);
  column->addWidget(rows_);
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpace);
  auto* label = new QLabel(tr("within ±"));
  label->setBuddy(tolerance_);
  tolerance_->setSuffix(tr(" %"));
  tolerance_->setAccessibleName(tr("Tolerance"));
  tolerance_->setToolTip(tr("How far a range reaches to both sides of what was measured."));
  tolerance_->setValue(kTolerance);
  add_->setToolTip(tr("Adds a figure that is measured after the try."));
  measure_->setToolTip(tr("Carries the lesson out up to this part, and sets the ranges around its figures."));
  for (QPushButton* button : {add_, measure_}) button->setAutoDefault(false);
  row->addWidget(add_);
  row->addStretch(1);
  row->addWidget(measure_);
  row->addWidget(label);
  row->addWidget(tolerance_);
  column->addLayout(row);
  connect(add_, &QPushButton::clicked, this, &MeasureRows::add_measure);
  connect(measure_, &QPushButton::clicked, this, &MeasureRows::measure_wanted);
}

void MeasureRows::show_measures(std::vector<document::LessonMeasure>* measures) {
  measures_ = measures;
  measured_.assign(measures != nullptr ? measures->size() : 0, QString());
  fill();
}

void MeasureRows::take(const document::LessonOutcome& outcome) {
  if (measures_ == nullptr || outcome.figures.size() != measures_->size()) return;
  for (std::size_t i = 0; i < measures_->size(); ++i) {
    const document::LessonFigure& figure = figure_of((*measures_)[i]);
    const auto& value = outcome.figures[i];
    measured_[i] = value ? number_text(*value, figure.digits) : tr("none");
    if (value) (*measures_)[i] = measure_around(figure, *value, tolerance_->value());
  }
  fill();
  emit edited();
}

void MeasureRows::fill() {
  rows_->clear();
  const std::size_t count = measures_ != nullptr ? measures_->size() : 0;
  measure_->setEnabled(count > 0);
  for (std::size_t i = 0; i < count; ++i) add_row(i);
}

void MeasureRows::add_row(std::size_t index) {
  const QString title = title_with_unit(figure_of((*measures_)[index]));
  auto* measured = new QLabel(measured_[index].isEmpty() ? QStringLiteral("–") : measured_[index]);
  measured->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
  measured->setAccessibleName(tr("Measured: %1").arg(title));
  measured->setMinimumWidth(measured->fontMetrics().horizontalAdvance(QStringLiteral("00000.00")));
  QToolButton* remove = make_remove_button(tr("Remove: %1").arg(title));
  connect(remove, &QToolButton::clicked, this, [this, index] {
    const auto at = static_cast<std::ptrdiff_t>(index);
    measures_->erase(measures_->begin() + at);
    measured_.erase(measured_.begin() + at);
    fill();
    emit edited();
  });
  rows_->add({make_figure(index), make_end(index, tr("From: %1").arg(title), &document::LessonMeasure::low),
              make_end(index, tr("To: %1").arg(title), &document::LessonMeasure::high), measured, remove});
}

QWidget* MeasureRows::make_figure(std::size_t index) {
  auto* choice = new QComboBox;
  choice->setAccessibleName(tr("Figure %1").arg(index + 1));
  choice->setToolTip(tr("What is measured after the try."));
  choice->setMinimumContentsLength(12);
  choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  guard_wheel(choice);
  for (const document::LessonFigure& figure : document::lesson_figures()) {
    choice->addItem(title_with_unit(figure),
                    QString::fromUtf8(figure.name.data(), qsizetype(figure.name.size())));
  }
  choice->setCurrentIndex(choice->findData(QString::fromStdString((*measures_)[index].figure)));
  connect(choice, &QComboBox::activated, this, [this, choice, index] {
    (*measures_)[index].figure = choice->currentData().toString().toStdString();
    measured_[index].clear();
    fill();
    emit edited();
  });
  return choice;
}

NumberBox* MeasureRows::make_end(std::size_t index, const QString& name,
                                 double document::LessonMeasure::*end) {
  const int digits = figure_of((*measures_)[index]).digits;
  NumberBox* box = make_number_box(-kLargestFigure, kLargestFigure, digits);
  // Its range would make it wide.
  box->setFixedWidth(box->fontMetrics().horizontalAdvance(QStringLiteral("000000.0000")) + 2 * kSpaceGroups);
  show_number(*box, (*measures_)[index].*end, digits);
  box->setAccessibleName(name);
  box->setToolTip(tr("An end of the range in which the student's figure should be."));
  connect(box, &NumberBox::valueChanged, this, [this, index, end](double value) {
    (*measures_)[index].*end = value;
    emit edited();
  });
  return box;
}

void MeasureRows::add_measure() {
  if (measures_ == nullptr) return;
  const auto all = document::lesson_figures();
  const auto is_unused = [this](const document::LessonFigure& figure) {
    return std::none_of(measures_->begin(), measures_->end(),
                        [&](const document::LessonMeasure& one) { return one.figure == figure.name; });
  };
  const auto unused = std::find_if(all.begin(), all.end(), is_unused);
  measures_->push_back({std::string((unused != all.end() ? *unused : all.front()).name), 0.0, 0.0});
  measured_.emplace_back();
  fill();
  emit edited();
}

}  // namespace tidemark::ui
