#include "tests/ui/main/desktop.h"

#include <QApplication>
#include <QSettings>
#include <QStandardPaths>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "ui/look/theme.h"

namespace tidemark::test {
namespace {

constexpr int kTickMilliseconds = 5;

}  // namespace

void prepare_desktop() {
  QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  QCoreApplication::setOrganizationName("tidemark-test");
  QCoreApplication::setApplicationName("tidemark-test");
  QStandardPaths::setTestModeEnabled(true);
}

Watchdog::Watchdog() {
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, [this] {
    const double late = static_cast<double>(since_.nsecsElapsed()) / 1e6 - kTickMilliseconds;
    longest_ms_ = std::max(longest_ms_, late);
    since_.restart();
  });
  restart();
}

void Watchdog::restart() {
  longest_ms_ = 0.0;
  since_.restart();
  timer_.start(kTickMilliseconds);
}

Desktop::Desktop(ExecutorKind executor, QSize size) {
  QSettings::setDefaultFormat(QSettings::IniFormat);
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope,
                     QString::fromStdString(home_.path().string()));
  apply_theme(*qApp, Theme::light);
  engine_ = std::make_unique<Engine>();
  window_ = std::make_unique<MainWindow>(*engine_);
  window_->set_executor(executor);
  window_->resize(size);
  window_->show();
  if (!QTest::qWaitForWindowExposed(window_.get())) qFatal("the window did not appear");
}

Desktop::~Desktop() {
  window_.reset();
  engine_.reset();
}

CaseWindow* Desktop::open_phantom(const QString& kind) {
  const qsizetype before = window_->cases().size();
  window_->open_phantom(kind);
  wait_for([&] { return window_->cases().size() > before && window_->active_case(); });
  settle();
  return window_->active_case();
}

CaseWindow* Desktop::open(const QString& path) {
  const qsizetype before = window_->cases().size();
  window_->open(path);
  wait_for([&] { return window_->cases().size() > before && window_->active_case(); });
  settle();
  return window_->active_case();
}

void Desktop::drag(QWidget& widget, const std::vector<QPoint>& way, Qt::MouseButton button,
                   Qt::KeyboardModifiers modifiers) {
  QTest::mouseMove(&widget, way.front());
  QTest::mousePress(&widget, button, modifiers, way.front());
  for (const QPoint& point : way) {
    // QTest's own moves do not say that a button is held.
    QMouseEvent move(QEvent::MouseMove, point, widget.mapToGlobal(point), Qt::NoButton, button, modifiers);
    QApplication::sendEvent(&widget, &move);
    QTest::qWait(5);
  }
  QTest::mouseRelease(&widget, button, modifiers, way.back());
}

void Desktop::drag(PictureView& view, const std::vector<glm::dvec3>& patient_mm, Qt::MouseButton button,
                   Qt::KeyboardModifiers modifiers) {
  std::vector<QPoint> way;
  for (const glm::dvec3& point : patient_mm) way.push_back(view.position_of(point).toPoint());
  drag(static_cast<QWidget&>(view), way, button, modifiers);
}

void Desktop::press(Qt::Key key, Qt::KeyboardModifiers modifiers) {
  window_->activateWindow();
  QTest::keyClick(window_.get(), key, modifiers);
}

void Desktop::settle() {
  // Pictures and figures ask for each other: twice nothing to do means that all is done.
  for (int quiet = 0; quiet < 2; ++quiet) {
    QTest::qWait(20);
    engine_->finish();
    QTest::qWait(20);
  }
}

bool Desktop::wait_for(const std::function<bool()>& condition, int milliseconds) {
  return QTest::qWaitFor(condition, milliseconds);
}

void Desktop::screenshot(const QString& name) {
  const QByteArray folder = qgetenv("TIDEMARK_SCREENSHOTS");
  if (folder.isEmpty()) return;
  settle();
  window_->grab().save(QString::fromLocal8Bit(folder) + '/' + name + ".png");
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

}  // namespace tidemark::test
