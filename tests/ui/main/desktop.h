// The desktop as tests drive it: real windows on a screen that nobody sees.
#pragma once

#include <QAbstractButton>
#include <QAction>
#include <QApplication>
#include <QImage>
#include <QLabel>
#include <QMessageBox>
#include <QTest>
#include <functional>
#include <memory>
#include <type_traits>

#include "engine/engine.h"
#include "tests/support/support.h"
#include "tests/ui/main/watched_application.h"
#include "ui/main/language_switch.h"
#include "ui/main/main_window.h"
#include "ui/views/picture_view.h"
#include "ui/views/slice_view.h"
#include "ui/views/volume_view.h"

namespace tidemark::test {

// The executor of stories: host, or the one that TIDEMARK_STORIES names ("compute" or "stream").
solver::ExecutorKind story_executor();

// Rows of a story by "executor": that one, and unless TIDEMARK_STORIES names it those that the story is most
// about.
void add_executor_rows(std::initializer_list<solver::ExecutorKind> besides = {});

// What works in the memory of that executor, for TIDEMARK_RENDERER.
QByteArray renderer_beside(solver::ExecutorKind executor);

// Traffic of phi for the pictures of a case, since it was opened.
struct PhiTraffic {
  std::int64_t copies = 0;          // read from the executor
  std::int64_t pages_uploaded = 0;  // to where pictures are drawn
};

// Settings, recovery and everything else of this program goes into a folder of its own that is gone after it.
// TIDEMARK_STORY_THEME=dark shows all in the dark theme, TIDEMARK_STORY_LANGUAGE=de speaks German. At the end
// the test fails if an event held the user interface since the window was there: see WatchedApplication.
class Desktop {
 public:
  explicit Desktop(solver::ExecutorKind executor, QSize size = {1280, 800}, bool use_opengl = true);
  ~Desktop();

  [[nodiscard]] ui::MainWindow& window() { return languages_ ? languages_->window() : *window_; }
  [[nodiscard]] engine::Engine& engine() { return *engine_; }
  [[nodiscard]] engine::CaseProxy& proxy() { return window().active_case()->proxy(); }
  [[nodiscard]] const engine::CaseState& state() { return proxy().state(); }

  // Opens and waits until the first pictures are there.
  ui::CaseWindow* open_phantom(const QString& kind);
  ui::CaseWindow* open(const QString& path);
  // Saves the active case by keys as that file. False where it was not saved in time.
  [[nodiscard]] bool save_session(const QString& file);
  // Closes the only case, and asks nothing.
  void close_case();
  // A view of the active case by its title; the test fails if it is not there.
  template <class View>
  View* view(const QString& title = {}) {
    for (ui::PictureView* view : window().active_case()->views()) {
      auto* wanted = qobject_cast<View*>(view);
      if (wanted && wanted->isVisible() && (title.isEmpty() || wanted->title() == title)) return wanted;
    }
    return nullptr;
  }
  // Moves the mouse to a point of the widget, and waits for the event that the window system sends.
  // False where none came.
  static bool hover(QWidget& widget, QPoint at);
  // Presses at one point of the patient, moves over the others, and releases.
  static void drag(ui::PictureView& view, const std::vector<glm::dvec3>& patient_mm,
                   Qt::MouseButton button = Qt::LeftButton, Qt::KeyboardModifiers modifiers = {});
  static void drag(QWidget& widget, const std::vector<QPoint>& way, Qt::MouseButton button = Qt::LeftButton,
                   Qt::KeyboardModifiers modifiers = {});
  // One part of a drag with the left button: press, move or release.
  static void mouse(ui::PictureView& view, QEvent::Type type, glm::dvec3 patient_mm);
  void press(Qt::Key key, Qt::KeyboardModifiers modifiers = {});

  // An entry of the menu bar's menu of that title, by the beginning of its text; null: there is none.
  QAction* menu_entry(const QString& menu, const QString& text);
  // By clicks in the menu bar.
  void choose(const QString& menu, QAction* wanted);
  // Chooses an entry of the list of that name, by keys.
  static void choose_in(const QWidget& panel, const QString& list, const QString& entry);
  // Types a number into the box of that name, which is seen, and waits.
  void type_into(const QString& box, const QString& number);
  // Presses that button of the next question. The result becomes true then.
  static std::shared_ptr<const bool> answer(QMessageBox::StandardButton button);

  // The active case's surface begins with a ball of that radius where the phantom's seed is.
  void begin(double radius_mm);
  [[nodiscard]] glm::dvec3 seed_mm();

  // Does something as the user interface would: within an event, which WatchedApplication sees.
  static void in_an_event(const std::function<void()>& something);
  // Until the engine has done everything, and the user interface has seen it.
  void wait_until_idle();
  PhiTraffic phi_traffic(engine::CaseProxy& proxy);
  static bool wait_for(const std::function<bool()>& condition, int milliseconds = 20000);
  // Where TIDEMARK_SCREENSHOTS says, if it does: of the window once it has settled, or as it is, with the
  // dialog or menu that is open.
  void screenshot(const QString& name);
  void screenshot_at_once(const QString& name);
  // There, too: of a panel, as "panel-NAME".
  static void keep_picture(QWidget& dock);

 private:
  ui::CaseWindow* opened(qsizetype before);  // when there are more cases than that

  TemporaryFolder home_;
  std::unique_ptr<engine::Engine> engine_;
  std::unique_ptr<ui::MainWindow> window_;
  std::unique_ptr<ui::LanguageSwitch> languages_;  // has the window where a language is named
};

// A widget that is seen, by its accessible name, or a button by its text. Null: there is none.
template <class Widget>
Widget* find_seen(QWidget& in, const QString& name) {
  for (Widget* widget : in.findChildren<Widget*>()) {
    if (!widget->isVisible()) continue;
    if (widget->accessibleName() == name) return widget;
    if constexpr (std::is_base_of_v<QAbstractButton, Widget>) {
      if (widget->text() == name) return widget;
    }
  }
  return nullptr;
}
// A label that is seen, by its text. Null: there is none.
QLabel* find_text(QWidget& in, const QString& text);
// Ends the test when there is none.
template <class Widget>
Widget* seen(QWidget& in, const QString& name) {
  if (Widget* widget = find_seen<Widget>(in, name)) return widget;
  qFatal("no %s", qPrintable(name));
}

// Share of the pixels that differ by more than a little.
double difference(const QImage& a, const QImage& b);
// Whether the view shows a picture of its own size that is not of one colour.
bool shows_a_picture(const ui::PictureView& view);

}  // namespace tidemark::test
