#include "ui/lessons/try_form.h"

#include <QHBoxLayout>
#include <QSignalBlocker>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/start_text.h"
#include "ui/lessons/text_box.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

QHBoxLayout* row_in(QWidget* whole) {
  auto* row = new QHBoxLayout(whole);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  return row;
}

}  // namespace

TryForm::TryForm(QWidget* parent)
    : QGroupBox(tr("T&ry"), parent), parameters_(new ParameterRows(0)), measures_(new MeasureRows) {
  setToolTip(tr("What the level set computes in this part. Without a try the part is to be read only."));
  Form form(make_content(*this));
  auto* take = new QPushButton(icon(u"target"), tr("&Take from the case"));
  take->setAutoDefault(false);
  take->setToolTip(tr("The active case's parameters, smoothing, steps and start become those of this part."));
  connect(take, &QPushButton::clicked, this, &TryForm::case_wanted);
  auto* row = new QHBoxLayout;
  row->addWidget(take);
  row->addStretch(1);
  form.wide(row);
  add_start(form);
  add_run(form);
  form.row(tr("Parameters"), parameters_, tr("In which this part differs from the lesson."));
  parameters_->setAccessibleName({});
  add_views(form);
  form.row(tr("Figures"), measures_, tr("What is measured after the try, and where it should be."));
  measures_->setAccessibleName({});
  connect(this, &QGroupBox::clicked, this, &TryForm::turn);
  connect(parameters_, &ParameterRows::edited, this, &TryForm::edited);
  connect(measures_, &MeasureRows::edited, this, &TryForm::edited);
  connect(measures_, &MeasureRows::measure_wanted, this, &TryForm::measure_wanted);
}

void TryForm::add_start(Form& form) {
  auto* begins = new QWidget;
  auto* row = row_in(begins);
  from_start_ = new QRadioButton(tr("from the start"));
  from_start_->setToolTip(tr("The surface begins anew in this part."));
  goes_on_ = new QRadioButton(tr("where the part before ended"));
  goes_on_->setToolTip(tr("The surface goes on, with the parameters of this part."));
  row->addWidget(from_start_);
  row->addWidget(goes_on_);
  row->addStretch(1);
  form.row(tr("Begins"), begins, tr("Where the surface is when the try begins."));
  begins->setFocusProxy(from_start_);
  connect(from_start_, &QRadioButton::clicked, this, [this] { set_going_on(false); });
  connect(goes_on_, &QRadioButton::clicked, this, [this] { set_going_on(true); });

  auto* start = new QWidget;
  auto* line = row_in(start);
  start_ = make_note({});
  start_->setAccessibleName(tr("Start"));
  drop_start_ = make_remove_button(tr("Remove the part's own start"));
  line->addWidget(start_, 1);
  line->addWidget(drop_start_);
  form.row(tr("Start"), start, tr("Seeds, a threshold or a flood, taken from a case."));
  connect(drop_start_, &QToolButton::clicked, this, [this] {
    change([](document::LessonTry& attempt) { attempt.start.reset(); });
    show_start();
  });
}

void TryForm::add_run(Form& form) {
  auto* run = new QWidget;
  auto* row = row_in(run);
  steps_ = make_number_box(0.0, static_cast<double>(document::Lesson::kMostSteps), 0);
  until_rest_ = new QCheckBox(tr("or until the surface rests"));
  until_rest_->setToolTip(tr("The try ends before, where the surface no longer moves."));
  row->addWidget(steps_);
  row->addWidget(until_rest_);
  row->addStretch(1);
  const QString tip = tr("How many steps are computed; 0: the start alone is shown.");
  form.row(tr("Steps"), run, tip);
  run->setAccessibleName({});
  run->setFocusProxy(steps_);
  steps_->setAccessibleName(tr("Steps"));
  steps_->setToolTip(tip);
  connect(steps_, &NumberBox::valueChanged, this, [this](double value) {
    change([=](document::LessonTry& attempt) { attempt.steps = std::llround(value); });
  });
  connect(until_rest_, &QCheckBox::clicked, this,
          [this](bool on) { change([=](document::LessonTry& attempt) { attempt.until_rest = on; }); });
  smoothing_ = make_number_box(0.0, 1000.0, 2);
  smoothing_->setSuffix(tr(" mm"));
  smoothing_->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
  form.row(tr("Smoothing"), smoothing_, tr("Of the volume that the level set sees; 0: none."));
  connect(smoothing_, &NumberBox::valueChanged, this, [this](double value) {
    change([=](document::LessonTry& attempt) { attempt.smoothed_mm = value; });
  });
}

void TryForm::add_views(Form& form) {
  auto* whole = new QWidget;
  auto* row = row_in(whole);
  const QString titles[] = {tr("Contours"), tr("Pages"), tr("Speed"), tr("Truth")};
  const QString tips[] = {tr("Lines where φ is -2, -1, 1 and 2, beside the surface."),
                          tr("The pages of memory that the surface uses."),
                          tr("The speed at each place, in colours."),
                          tr("The phantom's true outline beside the surface.")};
  for (std::size_t i = 0; i < document::lesson_view_names().size(); ++i) {
    auto* check = new QCheckBox(titles[i]);
    check->setToolTip(tips[i]);
    connect(check, &QCheckBox::clicked, this, &TryForm::keep_views);
    row->addWidget(check);
    views_.push_back(check);
  }
  row->addStretch(1);
  form.row(tr("Shows"), whole, tr("What the views show beside the surface during the try."));
  whole->setFocusProxy(views_.front());
}

void TryForm::show_part(document::LessonPart* part, const document::Lesson& lesson) {
  part_ = part;
  lesson_ = &lesson;
  kept_.reset();
  kept_measures_.clear();
  fill();
}

void TryForm::fill() {
  const bool on = part_ != nullptr && part_->attempt;
  setChecked(on);
  parameters_->show_parameters(on ? &part_->attempt->parameters : nullptr,
                               lesson_ != nullptr ? lesson_->parameters : solver::Parameters{});
  measures_->show_measures(on ? &part_->measures : nullptr);
  const document::LessonTry attempt = on ? *part_->attempt : document::LessonTry{};
  (attempt.goes_on ? goes_on_ : from_start_)->setChecked(true);
  show_number(*steps_, static_cast<double>(attempt.steps), 0);
  until_rest_->setChecked(attempt.until_rest);
  show_number(*smoothing_, attempt.smoothed_mm, 2);
  for (std::size_t i = 0; i < views_.size(); ++i) {
    const auto view = static_cast<document::LessonView>(i);
    views_[i]->setChecked(std::find(attempt.show.begin(), attempt.show.end(), view) != attempt.show.end());
  }
  show_start();
}

void TryForm::show_start() {
  const bool on = part_ != nullptr && part_->attempt;
  drop_start_->setVisible(on && part_->attempt->start);
  if (!on) return start_->clear();
  if (part_->attempt->goes_on) return start_->setText(tr("none: the surface goes on"));
  if (part_->attempt->start) return start_->setText(engine::start_text(*part_->attempt->start));
  const document::Start* inherited = lesson_->start_of(*part_);
  start_->setText(inherited != nullptr ? tr("the lesson's: %1").arg(engine::start_text(*inherited))
                                       : tr("the phantom's own"));
}

void TryForm::take(const document::LessonOutcome& outcome) {
  measures_->take(outcome);
}

void TryForm::change(const std::function<void(document::LessonTry&)>& apply) {
  if (part_ == nullptr || !part_->attempt) return;
  apply(*part_->attempt);
  emit edited();
}

void TryForm::turn(bool on) {
  if (part_ == nullptr) return;
  if (on) {
    document::LessonTry fresh;
    fresh.parameters = lesson_->parameters;
    part_->attempt = kept_.value_or(fresh);
    part_->measures = std::exchange(kept_measures_, {});
  } else {
    kept_ = std::exchange(part_->attempt, {});
    kept_measures_ = std::exchange(part_->measures, {});
  }
  fill();
  emit edited();
}

void TryForm::set_going_on(bool goes_on) {
  change([=](document::LessonTry& attempt) {
    attempt.goes_on = goes_on;
    if (goes_on) attempt.start.reset();
  });
  show_start();
}

// Those that were shown keep their order.
void TryForm::keep_views() {
  change([this](document::LessonTry& attempt) {
    for (std::size_t i = 0; i < views_.size(); ++i) {
      const auto view = static_cast<document::LessonView>(i);
      const auto at = std::find(attempt.show.begin(), attempt.show.end(), view);
      if (views_[i]->isChecked() && at == attempt.show.end()) attempt.show.push_back(view);
      if (!views_[i]->isChecked() && at != attempt.show.end()) attempt.show.erase(at);
    }
  });
}

}  // namespace tidemark::ui
