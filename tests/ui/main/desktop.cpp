#include "tests/ui/main/desktop.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLocale>
#include <QMenu>
#include <QMenuBar>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QWindow>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/case_runner.h"
#include "ui/look/language.h"
#include "ui/look/theme.h"
#include "ui/settings.h"

namespace tidemark::test {
solver::ExecutorKind story_executor() {
  const QByteArray name = qgetenv("TIDEMARK_STORIES");
  if (name.isEmpty()) return solver::ExecutorKind::host;
  if (const auto kind = solver::executor_named(name.toStdString())) return *kind;
  qFatal("TIDEMARK_STORIES is \"%s\": it can be auto, host, compute, stream or reference", name.constData());
}

void add_executor_rows(std::initializer_list<solver::ExecutorKind> besides) {
  QTest::addColumn<int>("executor");
  const auto add = [](solver::ExecutorKind kind) {
    for (const char* name : {"auto", "host", "compute", "stream", "reference"}) {
      if (solver::executor_named(name) == kind) QTest::newRow(name) << static_cast<int>(kind);
    }
  };
  add(story_executor());
  if (!qEnvironmentVariableIsEmpty("TIDEMARK_STORIES")) return;
  for (const solver::ExecutorKind kind : besides) add(kind);
}

QByteArray renderer_beside(solver::ExecutorKind executor) {
  switch (executor) {
    case solver::ExecutorKind::automatic:
      return "auto";
    case solver::ExecutorKind::compute:
    case solver::ExecutorKind::stream:
      return "gl";
    case solver::ExecutorKind::host:
    case solver::ExecutorKind::reference:
      break;
  }
  return "host";
}

Desktop::Desktop(solver::ExecutorKind executor, QSize size, bool use_opengl) {
  QSettings::setDefaultFormat(QSettings::IniFormat);
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope,
                     QString::fromStdString(home_.path().string()));
  const bool dark = qgetenv("TIDEMARK_STORY_THEME") == "dark";
  ui::apply_theme(*qApp, dark ? ui::Theme::dark : ui::Theme::light);
  engine_ = std::make_unique<engine::Engine>(use_opengl);
  const QString language = qEnvironmentVariable("TIDEMARK_STORY_LANGUAGE");
  if (language.isEmpty()) {
    window_ = std::make_unique<ui::MainWindow>(*engine_);
  } else {
    ui::settings::language().set(language);
    languages_ = std::make_unique<ui::LanguageSwitch>(*engine_);
  }
  window().set_executor(executor);
  window().resize(size);
  window().show();
  if (!QTest::qWaitForWindowExposed(&window())) qFatal("the window did not appear");
  WatchedApplication::instance().restart();
  WatchedApplication::instance().forget_held();  // the window's own beginning
}

Desktop::~Desktop() {
  window_.reset();
  if (languages_) {
    languages_.reset();
    ui::use_language("en");
    QLocale::setDefault(QLocale::c());
  }
  engine_.reset();
  WatchedApplication& watched = WatchedApplication::instance();
  qInfo("the longest event took %s", qPrintable(watched.longest()));
  const QStringList held = watched.take_held();
  if (held.isEmpty() || !QTest::currentTestFunction()) return;
  const QString told = "the user interface was held: " + held.join("; ");
  // Each story fails by it once, so that the number of failures tells whether there are others.
  if (QTest::currentTestFailed()) {
    qInfo("%s", qPrintable(told));
    return;
  }
  watched.note_failed_story();
  QTest::qFail(qPrintable(told), __FILE__, __LINE__);
}

ui::CaseWindow* Desktop::open_phantom(const QString& kind) {
  const qsizetype before = window().cases().size();
  in_an_event([&] { window().open_phantom(kind); });
  return opened(before);
}

ui::CaseWindow* Desktop::open(const QString& path) {
  const qsizetype before = window().cases().size();
  in_an_event([&] { window().open(path); });
  return opened(before);
}

ui::CaseWindow* Desktop::opened(qsizetype before) {
  wait_for(
      [&] { return window().cases().size() > before && window().active_case() == window().cases().back(); },
      60000);
  wait_until_idle();
  return window().active_case();
}

bool Desktop::save_session(const QString& file) {
  window().active_case()->session_file = file;
  press(Qt::Key_S, Qt::ControlModifier);
  return wait_for([this] { return !state().modified; });
}

void Desktop::close_case() {
  window().active_case()->close_saved();
  QVERIFY(wait_for([this] { return window().cases().isEmpty(); }));
  QTest::qWait(50);
}

void Desktop::in_an_event(const std::function<void()>& something) {
  bool done = false;
  QMetaObject::invokeMethod(
      qApp,
      [&] {
        something();
        done = true;
      },
      Qt::QueuedConnection);
  wait_for([&] { return done; });
}

bool Desktop::hover(QWidget& widget, QPoint at) {
  // The window's events say where the mouse is, whether its widgets ask for moves or not.
  class Arrival : public QObject {
   public:
    explicit Arrival(QPoint at) : at_(at) {}
    bool eventFilter(QObject* /*window*/, QEvent* event) override {
      if (event->type() == QEvent::MouseMove) {
        came_ |= static_cast<QMouseEvent*>(event)->globalPosition().toPoint() == at_;
      }
      return false;
    }
    bool came() const { return came_; }

   private:
    QPoint at_;
    bool came_ = false;
  };
  Arrival arrival(widget.mapToGlobal(at));
  widget.window()->windowHandle()->installEventFilter(&arrival);
  // No event follows a move to where the mouse is already.
  QTest::mouseMove(&widget, at + QPoint(1, 1));
  QTest::mouseMove(&widget, at);
  return wait_for([&] { return arrival.came(); }, 5000);
}

void Desktop::drag(QWidget& widget, const std::vector<QPoint>& way, Qt::MouseButton button,
                   Qt::KeyboardModifiers modifiers) {
  hover(widget, way.front());
  QTest::mousePress(&widget, button, modifiers, way.front());
  for (const QPoint& point : way) {
    // QTest's own moves do not say that a button is held.
    QMouseEvent move(QEvent::MouseMove, point, widget.mapToGlobal(point), Qt::NoButton, button, modifiers);
    QApplication::sendEvent(&widget, &move);
    QTest::qWait(5);
  }
  QTest::mouseRelease(&widget, button, modifiers, way.back());
}

void Desktop::drag(ui::PictureView& view, const std::vector<glm::dvec3>& patient_mm, Qt::MouseButton button,
                   Qt::KeyboardModifiers modifiers) {
  std::vector<QPoint> way;
  for (const glm::dvec3& point : patient_mm) way.push_back(view.position_of(point).toPoint());
  drag(static_cast<QWidget&>(view), way, button, modifiers);
}

void Desktop::mouse(ui::PictureView& view, QEvent::Type type, glm::dvec3 patient_mm) {
  const QPointF there = view.position_of(patient_mm);
  QMouseEvent event(type, there, view.mapToGlobal(there),
                    type == QEvent::MouseMove ? Qt::NoButton : Qt::LeftButton,
                    type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, {});
  QApplication::sendEvent(&view, &event);
}

QAction* Desktop::menu_entry(const QString& menu, const QString& text) {
  for (QAction* title : window().menuBar()->actions()) {
    if (title->text().remove('&') != menu) continue;
    for (QAction* action : title->menu()->actions()) {
      if (action->text().remove('&').startsWith(text)) return action;
    }
  }
  return nullptr;
}

void Desktop::choose(const QString& menu, QAction* wanted) {
  QMenuBar* bar = window().menuBar();
  for (QAction* title : bar->actions()) {
    if (title->text().remove('&') != menu) continue;
    QTest::mouseClick(bar, Qt::LeftButton, {}, bar->actionGeometry(title).center());
    QMenu* opened = title->menu();
    QVERIFY(wait_for([&] { return opened->isVisible(); }));
    while (!opened->actions().contains(wanted)) {
      QAction* next = nullptr;
      for (QAction* entry : opened->actions()) {
        if (entry->menu() && entry->menu()->actions().contains(wanted)) next = entry;
      }
      QVERIFY2(next, qPrintable(wanted->text()));
      QTest::mouseClick(opened, Qt::LeftButton, {}, opened->actionGeometry(next).center());
      opened = next->menu();
      QVERIFY(wait_for([&] { return opened->isVisible(); }));
    }
    QTest::mouseClick(opened, Qt::LeftButton, {}, opened->actionGeometry(wanted).center());
    return;
  }
  QFAIL("there is no such menu");
}

void Desktop::choose_in(const QWidget& panel, const QString& list, const QString& entry) {
  for (auto* choice : panel.findChildren<QComboBox*>()) {
    if (choice->accessibleName() != list || !choice->isVisible()) continue;
    choice->setFocus();
    QTest::keyClick(choice, Qt::Key_Home);
    for (int i = 0; i < choice->count() && choice->currentText() != entry; ++i)
      QTest::keyClick(choice, Qt::Key_Down);
    QCOMPARE(choice->currentText(), entry);
    return;
  }
  QFAIL("there is no such list");
}

void Desktop::type_into(const QString& box, const QString& number) {
  for (auto* one : window().findChildren<QDoubleSpinBox*>()) {
    if (one->accessibleName() != box || one->visibleRegion().isEmpty()) continue;
    QTest::mouseDClick(one, Qt::LeftButton, {}, QPoint(one->width() / 3, one->height() / 2));
    one->selectAll();
    QTest::keyClicks(one, number);
    QTest::keyClick(one, Qt::Key_Return);
    wait_until_idle();
    return;
  }
  QFAIL("there is no such box");
}

std::shared_ptr<const bool> Desktop::answer(QMessageBox::StandardButton button) {
  auto asked = std::make_shared<bool>(false);
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer, [timer, button, asked] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!box || !box->button(button)) return;
    timer->stop();  // it goes with a later turn of the event loop
    timer->deleteLater();
    *asked = true;
    box->button(button)->click();
  });
  timer->start(20);
  return asked;
}

void Desktop::press(Qt::Key key, Qt::KeyboardModifiers modifiers) {
  // Keys go to the window that is active, which it is not at once after a dialog.
  window().activateWindow();
  if (!QTest::qWaitForWindowActive(&window())) qFatal("the window cannot be made active");
  QTest::keyClick(&window(), key, modifiers);
}

glm::dvec3 Desktop::seed_mm() {
  const auto& seed = *proxy().study().start->seed;
  return proxy().volume().geometry.to_patient({seed[0], seed[1], seed[2]});
}

void Desktop::begin(double radius_mm) {
  document::Start start;
  start.seeds.push_back({seed_mm(), radius_mm});
  proxy().begin(start);
  wait_until_idle();
}

void Desktop::wait_until_idle() {
  // Pictures and figures ask for each other: twice nothing to do means that all is done.
  for (int quiet = 0; quiet < 2; ++quiet) {
    QTest::qWait(20);
    QVERIFY2(wait_for([this] { return engine_->idle(); }, 60000), "a surface moves, or the engine hangs");
    // Further images are sampled in the background. What else runs there may take its time.
    wait_for([] { return engine::BackgroundJob::finish_all(std::chrono::milliseconds(0)); }, 2000);
    QTest::qWait(20);
  }
}

PhiTraffic Desktop::phi_traffic(engine::CaseProxy& proxy) {
  PhiTraffic traffic;
  proxy.runner()->post([&](engine::CaseRunner& runner, const Progress&) -> Status {
    traffic = {runner.painter().phi_copies(), runner.painter().pages_uploaded()};
    return {};
  });
  wait_until_idle();
  return traffic;
}

bool Desktop::wait_for(const std::function<bool()>& condition, int milliseconds) {
  return QTest::qWaitFor(condition, milliseconds);
}

void Desktop::screenshot(const QString& name) {
  if (qEnvironmentVariableIsEmpty("TIDEMARK_SCREENSHOTS")) return;
  wait_until_idle();
  screenshot_at_once(name);
}

void Desktop::screenshot_at_once(const QString& name) {
  const QString folder = qEnvironmentVariable("TIDEMARK_SCREENSHOTS");
  if (folder.isEmpty()) return;
  QPixmap picture = window().grab();
  for (QWidget* over : {QApplication::activeModalWidget(), QApplication::activePopupWidget()}) {
    if (!over) continue;
    QPainter painter(&picture);
    const QRect frame = over->geometry().translated(-window().pos());
    painter.drawPixmap(frame.topLeft(), over->grab());
    painter.drawRect(frame);  // there may be no window manager to draw one
  }
  picture.save(folder + '/' + name + ".png");
}

void Desktop::keep_picture(QWidget& dock) {
  const QString folder = qEnvironmentVariable("TIDEMARK_SCREENSHOTS");
  if (folder.isEmpty()) return;
  QVERIFY(dock.grab().save(QStringLiteral("%1/panel-%2.png").arg(folder, dock.objectName())));
}

QLabel* find_text(QWidget& in, const QString& text) {
  for (QLabel* label : in.findChildren<QLabel*>()) {
    if (label->isVisible() && label->text() == text) return label;
  }
  return nullptr;
}

double difference(const QImage& a, const QImage& b) {
  if (a.size() != b.size()) return 1.0;
  constexpr int kLittle = 12;
  std::int64_t differing = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      const QColor p = a.pixelColor(x, y);
      const QColor q = b.pixelColor(x, y);
      const int most = std::max(
          {std::abs(p.red() - q.red()), std::abs(p.green() - q.green()), std::abs(p.blue() - q.blue())});
      if (most > kLittle) ++differing;
    }
  }
  return static_cast<double>(differing) / (static_cast<double>(a.width()) * a.height());
}

bool shows_a_picture(const ui::PictureView& view) {
  const engine::ShownPicture& shown = view.feed().shown();
  const QImage& image = shown.image;
  if (image.isNull() || shown.size != view.physical_size()) return false;
  QImage first(image.size(), QImage::Format_RGB32);
  first.fill(image.pixelColor(0, 0));
  return difference(image, first) > 0.0005;
}

}  // namespace tidemark::test
