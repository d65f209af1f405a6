#include "ui/main/teaching.h"

#include <QApplication>
#include <QDockWidget>
#include <QFileDialog>
#include <QMenu>
#include <QVBoxLayout>
#include <algorithm>

#include "engine/case_autosave.h"
#include "engine/case_proxy.h"
#include "engine/lesson_autosave.h"
#include "engine/lesson_course.h"
#include "engine/message_text.h"
#include "ui/lessons/lesson_editor.h"
#include "ui/lessons/lesson_panel.h"
#include "ui/lessons/lesson_text.h"
#include "ui/look/polish_again.h"
#include "ui/main/case_files.h"
#include "ui/main/case_head.h"
#include "ui/main/case_window.h"
#include "ui/main/main_window.h"
#include "ui/main/side_dock.h"
#include "ui/settings.h"
#include "ui/widgets/menu_text.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/question.h"

namespace tidemark::ui {
namespace {

constexpr double kLargeType = 1.5;  // of the usual font
constexpr const char* kAboutLessons = "lesson";

bool wants(const document::LessonTry& attempt, document::LessonView view) {
  return std::find(attempt.show.begin(), attempt.show.end(), view) != attempt.show.end();
}

}  // namespace

Teaching::Teaching(MainWindow& window) : QObject(&window), window_(window), normal_(QApplication::font()) {}

KeptLesson::~KeptLesson() = default;

Teaching::~Teaching() {
  if (large_type()) QApplication::setFont(normal_);
}

void Teaching::fill(QMenu& menu) {
  menu_ = &menu;
  int number = 0;
  for (const document::OwnLesson& own : document::own_lessons()) {
    const auto lesson = document::Lesson::parse(own.text, std::string(own.name));
    if (!lesson) continue;  // a test holds that none is
    const QString form = ++number < 10 ? QStringLiteral("&%1 %2") : QStringLiteral("%1 %2");
    const QString title = menu_text(lesson_words(lesson->title));
    auto* action = menu.addAction(form.arg(QString::number(number), title));
    action->setToolTip(lesson_words(lesson->about));
    connect(action, &QAction::triggered, this, [this, lesson = *lesson] { begin(lesson, {}); });
  }
  menu.setToolTipsVisible(true);
  menu.addSeparator();
  connect(menu.addAction(tr("&Open lesson…")), &QAction::triggered, this, &Teaching::ask_and_open);
  show_ = menu.addAction(tr("&Show the lesson"));
  show_->setEnabled(false);
  connect(show_, &QAction::triggered, this, [this] {
    if (dock_) dock_->show();
  });
  menu.addSeparator();
  connect(menu.addAction(tr("&Write a lesson…")), &QAction::triggered, this,
          [this] { editor().new_lesson(); });
  edit_ = menu.addAction(tr("&Change this lesson…"));
  edit_->setEnabled(false);
  connect(edit_, &QAction::triggered, this, [this] { editor().edit(course_->lesson(), file_); });
  menu.addSeparator();
  large_ = menu.addAction(tr("&Projector: large type"));
  large_->setCheckable(true);
  connect(large_, &QAction::toggled, this, &Teaching::set_large);
}

void Teaching::show_list(QPoint at) {
  menu_->popup(at);
}

void Teaching::ask_and_open() {
  const QString file = QFileDialog::getOpenFileName(&window_, tr("Open a lesson"),
                                                    settings::open_folder().get(), tr("Lesson (*.json)"));
  if (!file.isEmpty()) open(file);
}

void Teaching::open(const QString& file) {
  const auto path = path_of(file);
  auto lesson = document::Lesson::load(path);
  if (!lesson) return window_.tell(engine::message_text(lesson.error()), kAboutLessons);
  window_.dismiss_about(kAboutLessons);
  begin(std::move(*lesson), path);
}

void Teaching::begin(document::Lesson lesson, const std::filesystem::path& file) {
  show(std::move(lesson), file, nullptr);
}

// The copy goes once there is another one.
void Teaching::go_on(const document::RescuedLesson& rescued) {
  if (!show(rescued.lesson, rescued.file, &rescued.progress)) return;
  const auto remove = [id = rescued.id] { document::discard_lesson(engine::recovery_folder(), id); };
  connect(autosave_.get(), &engine::LessonAutosave::saved, this, remove, Qt::SingleShotConnection);
}

bool Teaching::show(document::Lesson lesson, const std::filesystem::path& file,
                    const document::LessonProgress* progress) {
  if (!may_end()) return false;
  auto course = std::make_unique<engine::LessonCourse>(std::move(lesson), file.parent_path());
  if (progress) course->go_on_from(*progress);
  show(std::move(course), file);
  return true;
}

void Teaching::show(std::unique_ptr<engine::LessonCourse> course, const std::filesystem::path& file) {
  end();
  file_ = file;
  course_ = std::move(course);
  autosave_ = std::make_unique<engine::LessonAutosave>(*course_, file, engine::recovery_folder());
  connect(autosave_.get(), &engine::LessonAutosave::failed, this,
          [this](const QString& message) { window_.tell(message, kAboutLessons); });
  connect(course_.get(), &engine::LessonCourse::case_wanted, this, &Teaching::open_case);
  connect(course_.get(), &engine::LessonCourse::case_used, this, &Teaching::show_case);
  connect(course_.get(), &engine::LessonCourse::changed, this, &Teaching::name_case);
  auto* panel = new LessonPanel(*course_);
  connect(panel, &LessonPanel::end_wanted, this, [this] {
    // The button that asks goes away with the panel.
    if (may_end()) QMetaObject::invokeMethod(this, &Teaching::end, Qt::QueuedConnection);
  });
  head_ = new CaseHead;
  named_ = nullptr;
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins({});
  column->setSpacing(0);
  column->addWidget(head_);
  column->addWidget(panel, 1);
  if (!dock_) dock_ = make_side_dock(window_, "lesson", tr("Lesson"));
  dock_->setWidget(content);
  dock_->show();
  show_->setEnabled(true);
  edit_->setEnabled(true);
  course_->open_study();
}

void Teaching::end() {
  if (!course_) return;
  delete dock_->widget();
  head_ = nullptr;
  autosave_.reset();
  course_.reset();
  file_.clear();
  dock_->hide();
  show_->setEnabled(false);
  edit_->setEnabled(false);
}

CaseWindow* Teaching::window_of(const engine::CaseProxy* proxy) const {
  for (CaseWindow* window : window_.cases()) {
    if (&window->proxy() == proxy) return window;
  }
  return nullptr;
}

void Teaching::open_case(const std::shared_ptr<const engine::LoadedStudy>& study) {
  CaseWindow* opened = window_.add_case(study);
  course_->take_case(opened->proxy());
  // The panels of the first case bring back an arrangement that knows of no lesson.
  const auto show = [this] {
    if (course_) dock_->show();
  };
  QMetaObject::invokeMethod(this, show, Qt::QueuedConnection);
}

// What is done is done where the student looks.
void Teaching::show_case(engine::CaseProxy& proxy, const document::LessonTry& attempt) {
  CaseWindow* used = window_of(&proxy);
  if (!used) return;
  window_.bring_to_front(*used);
  proxy.display().change([&](engine::DisplaySettings& settings) {
    settings.contours = wants(attempt, document::LessonView::contours);
    settings.truth = wants(attempt, document::LessonView::truth);
  });
  for (const auto& [view, kind] : {std::pair(document::LessonView::pages, ViewKind::pages),
                                   std::pair(document::LessonView::speed, ViewKind::speed)}) {
    if (wants(attempt, view)) used->show_view(kind);
  }
}

void Teaching::name_case() {
  CaseWindow* now = window_of(course_->proxy());
  if (now == named_) return;
  named_ = now;
  head_->set_case(now);
}

LessonEditor& Teaching::editor() {
  if (!editor_) {
    const auto active = [this]() -> engine::CaseProxy* {
      CaseWindow* window = window_.active_case();
      return window ? &window->proxy() : nullptr;
    };
    editor_ = new LessonEditor(active, &window_);
  }
  // In an event of its own: making the window takes about as long as showing it.
  QMetaObject::invokeMethod(
      editor_,
      [editor = editor_] {
        editor->show();
        editor->raise();
        editor->activateWindow();
      },
      Qt::QueuedConnection);
  return *editor_;
}

bool Teaching::may_end(const QString& question) {
  return !course_ || !course_->has_news() ||
         ask(&window_, tr("End the lesson"), question, QMessageBox::Yes | QMessageBox::No, QMessageBox::No) ==
             QMessageBox::Yes;
}

bool Teaching::may_end() {
  return may_end(tr("Answers that were not saved are lost. The cases stay open. End the lesson?"));
}

bool Teaching::may_close() {
  const QString title = course_ ? lesson_words(course_->lesson().title) : QString();
  return may_end(tr("The answers to “%1” were not saved. Close all the same?").arg(title)) &&
         editor_may_close();
}

bool Teaching::editor_may_close() {
  return !editor_ || !editor_->isVisible() || editor_->close();
}

std::unique_ptr<KeptLesson> Teaching::keep() {
  if (!course_) return nullptr;
  const bool shown = dock_->isVisible();
  auto kept = std::make_unique<KeptLesson>();
  kept->course = std::move(course_);
  kept->file = file_;
  kept->shown = shown;
  kept->course->disconnect(this);
  delete dock_->widget();  // it speaks to the course
  head_ = nullptr;
  autosave_.reset();
  return kept;
}

void Teaching::take_over(std::unique_ptr<KeptLesson> kept) {
  show(std::move(kept->course), kept->file);
  dock_->setVisible(kept->shown);
  name_case();
}

bool Teaching::large_type() const {
  return large_->isChecked();
}

void Teaching::set_large_type(bool large) {
  large_->setChecked(large);
}

void Teaching::set_large(bool large) {
  QFont font = normal_;
  if (large) font.setPointSizeF(font.pointSizeF() * kLargeType);
  QApplication::setFont(font);
  polish_again();
}

}  // namespace tidemark::ui
