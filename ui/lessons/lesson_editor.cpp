#include "ui/lessons/lesson_editor.h"

#include <QHBoxLayout>
#include <QScrollBar>
#include <QSplitter>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "engine/case_proxy.h"
#include "ui/lessons/case_setup.h"
#include "ui/lessons/lesson_cut.h"
#include "ui/look/theme.h"
#include "ui/transfer/panel_scroll.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

// A figure that was added has that range. Whether a surface rests may well be 0.
bool has_unmeasured_range(const document::Lesson& lesson) {
  const auto is_unmeasured = [](const document::LessonMeasure& measure) {
    return measure.low == 0.0 && measure.high == 0.0 && measure.figure != "rests";
  };
  return std::any_of(lesson.parts.begin(), lesson.parts.end(), [&](const document::LessonPart& part) {
    return std::any_of(part.measures.begin(), part.measures.end(), is_unmeasured);
  });
}

constexpr int kCheckAfter = 200;  // ms after the last key
constexpr int kListWidth = 230;
constexpr QSize kSize{980, 680};
constexpr const char* kFirstPhantom = "sphere";

enum FormIndex { lesson_index, part_index };

document::Lesson empty_lesson() {
  document::Lesson lesson;
  lesson.study.phantom = kFirstPhantom;
  lesson.parts.emplace_back().attempt.emplace();
  return lesson;
}

}  // namespace

LessonEditor::LessonEditor(ActiveCase active_case, QWidget* parent)
    : QDialog(parent),
      active_case_(std::move(active_case)),
      file_(new LessonFile(
          *this, [this]() -> const document::Lesson& { return lesson_; }, [this] { return problem(); })),
      problem_(make_note({})),
      work_(new WorkLine) {
  setWindowFlags(Qt::Window);
  auto* whole = new QVBoxLayout(this);
  whole->setSpacing(kSpace);
  make_forms(*whole);
  whole->addWidget(make_messages());
  whole->addWidget(make_buttons());
  checking_.setSingleShot(true);
  checking_.setInterval(kCheckAfter);
  connect(&checking_, &QTimer::timeout, this, &LessonEditor::check);
  connect_forms();
  connect_trials();
  connect(file_, &LessonFile::said, this, &LessonEditor::say);
  connect(file_, &LessonFile::opened, this, &LessonEditor::show_lesson);
  connect(file_, &LessonFile::saved, this, [this](const QString& file) {
    show_title();
    if (shown_folder_ != file_->folder()) show_chosen();  // paths are relative to it
    emit saved(file);
  });
  resize(kSize);
  new_lesson();
}

// A number that is half typed is taken when its box goes away: the lesson must still be there.
LessonEditor::~LessonEditor() {
  hide();
  delete forms_;
}

// From the outermost to the innermost: each new parent styles all that is within a widget again.
void LessonEditor::make_forms(QBoxLayout& whole) {
  auto* columns = new QSplitter(this);
  whole.addWidget(columns, 1);
  columns->setChildrenCollapsible(false);
  list_ = new PartList(columns);
  forms_ = new QStackedWidget(columns);
  columns->addWidget(list_);
  columns->addWidget(forms_);
  columns->setStretchFactor(1, 1);
  columns->setSizes({kListWidth, kSize.width() - kListWidth});
  lesson_form_ = new LessonForm(forms_);
  part_form_ = new PartForm(forms_);
  // In the order of FormIndex.
  forms_->addWidget(new PanelScroll(lesson_form_, forms_));
  forms_->addWidget(new PanelScroll(part_form_, forms_));
}

QWidget* LessonEditor::make_messages() {
  auto* whole = new QWidget;
  auto* column = new QVBoxLayout(whole);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(0);
  problem_->setAccessibleName(tr("What is missing or wrong"));
  column->addWidget(problem_);
  column->addWidget(work_);
  return whole;
}

QPushButton* LessonEditor::make_button(const QString& text, const QString& tip, QBoxLayout& row,
                                       const std::function<void()>& clicked) {
  auto* button = new QPushButton(text);
  button->setAutoDefault(false);
  button->setToolTip(tip);
  connect(button, &QPushButton::clicked, this, [this, clicked] {
    commit_typed_number();
    clicked();
  });
  row.addWidget(button);
  return button;
}

QWidget* LessonEditor::make_buttons() {
  auto* whole = new QWidget;
  auto* row = new QHBoxLayout(whole);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  idle_buttons_ << make_button(tr("&New"), tr("Begins another lesson."), *row, [this] {
    new_lesson();
  }) << make_button(tr("&Open…"), tr("Opens a lesson's file."), *row, [this] { file_->ask_and_open(); });
  make_button(tr("&Save"), tr("Writes the lesson to its file."), *row, [this] {
    file_->save();
  })->setShortcut(QKeySequence::Save);
  make_button(tr("Save &as…"), tr("Writes the lesson to another file."), *row, [this] { file_->save_as(); });
  row->addStretch(1);
  idle_buttons_ << make_button(tr("Try a&ll"),
                               tr("Carries the whole lesson out, and shows each figure beside its range."),
                               *row, [this] { try_all(); });
  make_button(tr("Close"), tr("Closes the editor."), *row, [this] { reject(); });
  return whole;
}

void LessonEditor::connect_forms() {
  connect(list_, &PartList::chose, this, &LessonEditor::show_chosen);
  connect(list_, &PartList::edited, this, &LessonEditor::note_edit);
  connect(list_, &PartList::added, part_form_, &PartForm::focus_title);
  connect(lesson_form_, &LessonForm::edited, this, &LessonEditor::note_edit);
  connect(lesson_form_, &LessonForm::case_wanted, this, &LessonEditor::take_from_case);
  connect(lesson_form_, &LessonForm::phantom_chosen, this, [this] { suits_.suit(lesson_.study.phantom); });
  connect(part_form_, &PartForm::edited, this, &LessonEditor::note_edit);
  connect(part_form_, &PartForm::case_wanted, this, &LessonEditor::take_from_case);
  connect(part_form_, &PartForm::measure_wanted, this, &LessonEditor::measure);
  connect(&suits_, &engine::LessonJobs::suited, this, [this](const solver::Parameters& suitable) {
    CaseSetup setup;
    setup.origin.phantom = lesson_.study.phantom;
    setup.parameters = lesson_.parameters;
    setup.parameters.target = suitable.target;
    setup.parameters.range = suitable.range;
    setup.parameters.alpha = suitable.alpha;
    put_into_lesson(setup, lesson_, file_->folder());
    show_chosen();
    if (file_->is_modified()) note_edit();
  });
  connect(&suits_, &engine::LessonJobs::failed, this, &LessonEditor::say);
}

void LessonEditor::connect_trials() {
  connect(work_, &WorkLine::cancelled, &trials_, &engine::LessonJobs::cancel);
  connect(&trials_, &engine::LessonJobs::progressed, work_, &WorkLine::set_progress);
  connect(&trials_, &engine::LessonJobs::cancelled, this, [this] {
    set_busy(false);
    work_->end(tr("Cancelled."));
  });
  connect(&trials_, &engine::LessonJobs::failed, this, [this](const QString& message) {
    set_busy(false);
    say(message);
  });
  connect(&trials_, &engine::LessonJobs::carried_out, this,
          [this](const std::vector<document::LessonOutcome>& outcomes) {
            set_busy(false);
            if (measured_) {
              part_form_->take(outcomes.back());
              return say(tr("Measured: the ranges are set around the figures."));
            }
            say({});
            if (trial_ == nullptr) trial_ = new LessonTrial(this);
            trial_->show_outcomes(lesson_, outcomes);
            trial_->show();
            trial_->raise();
            trial_->activateWindow();
          });
}

void LessonEditor::new_lesson() {
  commit_typed_number();
  file_->when_kept([this] {
    show_lesson(empty_lesson(), {});
    suits_.suit(lesson_.study.phantom);
  });
}

void LessonEditor::edit(const document::Lesson& lesson, const std::filesystem::path& file) {
  commit_typed_number();
  file_->when_kept([this, lesson, file] { show_lesson(lesson, file); });
}

void LessonEditor::open(const std::filesystem::path& file) {
  commit_typed_number();
  file_->when_kept([this, file] { file_->open(file); });
}

void LessonEditor::show_lesson(const document::Lesson& lesson, const std::filesystem::path& file) {
  trials_.cancel();
  suits_.cancel();
  if (trial_ != nullptr) trial_->hide();
  lesson_ = lesson;
  file_->begin(file);
  say({});
  list_->show_lesson(lesson_, std::nullopt);
  show_title();
  check();
  lesson_form_->focus_title();
}

void LessonEditor::show_chosen() {
  const auto chosen = list_->chosen();
  const bool anew = chosen != shown_;
  shown_ = chosen;
  shown_folder_ = file_->folder();
  ++showing_;
  chosen ? part_form_->show_part(lesson_, *chosen, file_->folder())
         : lesson_form_->show_lesson(lesson_, file_->folder());
  forms_->setCurrentIndex(chosen ? part_index : lesson_index);
  if (anew) static_cast<QScrollArea*>(forms_->currentWidget())->verticalScrollBar()->setValue(0);
}

void LessonEditor::note_edit() {
  file_->note_edit();
  show_title();
  list_->show_titles(problem_row_);
  checking_.start();
}

void LessonEditor::commit_typed_number() {
  if (auto* box = qobject_cast<NumberBox*>(focusWidget())) box->interpretText();
}

void LessonEditor::show_title() {
  const QString title = QString::fromStdString(lesson_.title).simplified();
  setWindowTitle(tr("%1[*] - Lesson editor").arg(title.isEmpty() ? tr("New lesson") : title));
  setWindowModified(file_->is_modified());
}

void LessonEditor::check() {
  const auto found = problem_of(lesson_);
  QPalette colours = palette();
  if (found) colours.setColor(QPalette::WindowText, problem_colour(palette()));
  problem_->setPalette(colours);
  problem_->setText(found ? found->sentence
                    : has_unmeasured_range(lesson_)
                        ? tr("The lesson is complete, but for ranges from 0 to 0: press "
                             "Measure, or type them.")
                        : tr("The lesson is complete."));
  problem_row_.reset();
  if (found) problem_row_ = found->part ? static_cast<int>(*found->part) + 1 : 0;
  list_->show_titles(problem_row_);
}

void LessonEditor::changeEvent(QEvent* event) {
  QDialog::changeEvent(event);
  if (event->type() == QEvent::PaletteChange) checking_.start();  // the colour of a problem is the theme's
}

// What is typed and not taken is a problem, too.
QString LessonEditor::problem() const {
  for (const NumberBox* box : forms_->currentWidget()->findChildren<NumberBox*>()) {
    if (!box->problem().isEmpty()) return box->problem();
  }
  const auto found = problem_of(lesson_);
  return found ? found->sentence : QString();
}

void LessonEditor::say(const QString& sentence) {
  work_->end(sentence);
}

void LessonEditor::take_from_case() {
  engine::CaseProxy* proxy = active_case_ ? active_case_() : nullptr;
  if (proxy == nullptr) return say(tr("No case is open."));
  const QPointer self(this);
  // Another part may be shown by then.
  const auto when_shown = [self, showing = showing_](auto answer) {
    if (self && self->showing_ == showing) answer();
  };
  take_setup(
      *proxy, [=](const CaseSetup& setup) { when_shown([&] { self->take(setup); }); },
      [=] { when_shown([&] { self->say(tr("The case could not be read.")); }); });
}

void LessonEditor::take(const CaseSetup& setup) {
  const QString remarks = shown_ ? put_into_part(setup, lesson_, *shown_, file_->folder())
                                 : put_into_lesson(setup, lesson_, file_->folder());
  show_chosen();
  note_edit();
  say(remarks.isEmpty() ? tr("Taken from the case.") : remarks);
}

void LessonEditor::measure() {
  measured_ = shown_;
  carry_out(cut_after(lesson_, *shown_), tr("Measuring"));
}

void LessonEditor::try_all() {
  measured_.reset();
  carry_out(lesson_, tr("Carrying out the lesson"));
}

void LessonEditor::carry_out(const document::Lesson& lesson, const QString& what) {
  if (const auto found = problem_of(lesson, lesson_)) return say(found->sentence);
  const bool needs_file = lesson.study.phantom.empty() && file_->path().empty();
  if (needs_file) return say(tr("Save the lesson first: its study is looked for beside its file."));
  work_->begin(what);
  set_busy(true);
  trials_.carry_out(lesson, file_->folder());
}

void LessonEditor::set_busy(bool busy) {
  if (busy) focus_ = focusWidget();
  list_->setEnabled(!busy);
  forms_->setEnabled(!busy);
  for (QPushButton* button : idle_buttons_) button->setEnabled(!busy);
  if (!busy && focus_) focus_->setFocus();
}

void LessonEditor::reject() {
  commit_typed_number();
  file_->when_kept([this] {
    trials_.cancel();
    QDialog::reject();
  });
}

}  // namespace tidemark::ui
