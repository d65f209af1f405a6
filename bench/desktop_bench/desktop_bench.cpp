// How quick the desktop is while a level set evolves: pictures and steps a second, and the time from a move
// of the mouse to the picture that shows it. Opens a window: without a screen, run it by xvfb-run -a.
//   desktop_bench [--executor host|compute|stream] [--phantom tumour] [--steps 600] [--no-opengl]
//   desktop_bench --open STUDY     how long it takes from opening to the first picture of each view
#include <QApplication>
#include <QCommandLineParser>
#include <QElapsedTimer>
#include <QSettings>
#include <QTemporaryDir>
#include <QTimer>
#include <QWindow>
#include <algorithm>
#include <cstdio>
#include <vector>

#include "engine/engine.h"
#include "ui/look/theme.h"
#include "ui/main/main_window.h"
#include "ui/opening/preview_page.h"
#include "ui/views/picture_view.h"

namespace {

using namespace tidemark;

// How long the thread of the user interface is busy with one event.
class TimedApplication : public QApplication {
 public:
  using QApplication::QApplication;
  bool notify(QObject* receiver, QEvent* event) override {
    if (depth_ > 0) return QApplication::notify(receiver, event);
    QElapsedTimer since;
    since.start();
    ++depth_;
    const bool handled = QApplication::notify(receiver, event);
    --depth_;
    longest_ms = std::max(longest_ms, static_cast<double>(since.nsecsElapsed()) / 1e6);
    return handled;
  }
  double longest_ms = 0.0;

 private:
  int depth_ = 0;
};

void wait(int milliseconds) {
  QEventLoop loop;
  QTimer::singleShot(milliseconds, &loop, &QEventLoop::quit);
  loop.exec();
}

template <class Condition>
bool wait_for(Condition condition, int milliseconds) {
  QElapsedTimer since;
  since.start();
  while (!condition() && since.elapsed() < milliseconds) wait(1);
  return condition();
}

void begin(engine::CaseProxy& proxy) {
  document::Start start;
  if (const auto& from = proxy.study().start; from && from->seed) {
    const auto& seed = *from->seed;
    start.seeds.push_back(
        solver::sphere_at_voxel(proxy.volume().geometry, {seed[0], seed[1], seed[2]}, seed[3]));
  } else if (from && from->threshold) {
    start.from = document::ThresholdStart{from->threshold->first, from->threshold->second};
  }
  proxy.set_pause_at_convergence(false);
  proxy.begin(start);
}

struct Rates {
  double steps = 0.0;     // a second
  double pictures = 0.0;  // of each view a second
};

// The surface is placed anew and plays so many steps, in which it still moves: at rest a step costs nothing.
Rates rates_in_motion(ui::CaseWindow& window, std::int64_t steps, bool seen) {
  engine::CaseProxy& proxy = window.proxy();
  const auto views = window.views();
  window.window()->setVisible(seen);
  begin(proxy);
  wait_for([&] { return proxy.state().begun && proxy.state().step == 0; }, 60000);
  wait(300);
  const std::uint64_t before = views.front()->feed().shown().number;
  QElapsedTimer since;
  since.start();
  bool ended = false;
  proxy.play_for(steps, false, [&](bool) { ended = true; });
  wait_for([&] { return ended; }, 60000);
  const double passed = static_cast<double>(since.nsecsElapsed()) / 1e9;
  const auto pictures = static_cast<double>(views.front()->feed().shown().number - before);
  return {static_cast<double>(steps) / passed, pictures / passed};
}

void measure_rates(ui::CaseWindow& window, std::int64_t steps) {
  constexpr int kRounds = 5;
  std::vector<Rates> seen;
  std::vector<Rates> alone;
  for (int round = 0; round < kRounds; ++round) {
    alone.push_back(rates_in_motion(window, steps, false));
    seen.push_back(rates_in_motion(window, steps, true));
  }
  const auto median = [](const std::vector<Rates>& rates, double Rates::*which) {
    std::vector<double> values;
    for (const Rates& one : rates) values.push_back(one.*which);
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  };
  for (ui::PictureView* view : window.views()) {
    std::printf("  %-20s %4d x %4d\n", qPrintable(view->title()), view->width(), view->height());
  }
  const double steps_seen = median(seen, &Rates::steps);
  const double steps_alone = median(alone, &Rates::steps);
  std::printf("  %lld steps: %.0f pictures/s of each, %.0f steps/s; while no view is seen %.0f, ratio %.2f\n",
              static_cast<long long>(steps), median(seen, &Rates::pictures), steps_seen, steps_alone,
              steps_seen / steps_alone);
}

// From a change of the view to the first picture of it.
void measure_latency(ui::CaseWindow& window) {
  for (ui::PictureView* view : window.views()) {
    std::vector<double> times;
    for (int turn = 0; turn < 20; ++turn) {
      QElapsedTimer since;
      since.start();
      window.proxy().display().change([](engine::DisplaySettings& settings) {
        settings.cursor_mm.z += 1.0;
        settings.camera.azimuth += 3.0;
      });
      const engine::DisplaySettings wanted = window.proxy().display().settings();
      const auto shown = [&] {
        const engine::AnyView& now = view->feed().shown().view;
        if (const auto* slice = std::get_if<renderer::SliceView>(&now))
          return slice->position_mm == wanted.cursor_mm;
        return std::get<renderer::VolumeView>(now).camera == wanted.camera;
      };
      if (wait_for(shown, 5000)) times.push_back(static_cast<double>(since.nsecsElapsed()) / 1e6);
    }
    std::sort(times.begin(), times.end());
    if (times.empty()) continue;
    std::printf("  %-20s input to picture: median %.0f ms, longest %.0f ms\n", qPrintable(view->title()),
                times[times.size() / 2], times.back());
  }
}

int measure_opening(ui::MainWindow& window, const QString& path) {
  wait(500);  // until the window is there
  QElapsedTimer since;
  const auto passed = [&] { return static_cast<double>(since.nsecsElapsed()) / 1e9; };
  double previewed = 0.0;
  QObject scope;
  QObject::connect(window.findChild<ui::PreviewPage*>(), &ui::PreviewPage::painted, &scope, [&] {
    if (previewed == 0.0) previewed = passed();
  });
  since.start();
  window.open(path);
  if (!wait_for([&] { return window.active_case() != nullptr; }, 60000)) return 1;
  std::printf("%s:\n", qPrintable(path));
  if (previewed > 0.0) std::printf("  middle slice          after %5.2f s\n", previewed);
  std::printf("  loaded                after %5.2f s\n", passed());
  for (ui::PictureView* view : window.active_case()->views()) {
    if (!wait_for([&] { return view->feed().shown().number > 0; }, 60000)) return 1;
    std::printf("  %-20s  after %5.2f s\n", qPrintable(view->title()), passed());
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
  QCoreApplication::setOrganizationName("tidemark-bench");
  QCoreApplication::setApplicationName("tidemark-bench");
  QElapsedTimer start;
  start.start();
  TimedApplication application(argc, argv);
  const qint64 application_ms = start.elapsed();
  const QTemporaryDir home;
  QSettings::setDefaultFormat(QSettings::IniFormat);
  QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, home.path());
  QCommandLineParser parser;
  parser.addHelpOption();
  parser.addOptions({{"executor", "host, compute or stream", "name", "host"},
                     {"open", "a study to open, and nothing more", "folder or file"},
                     {"phantom", "which synthetic study", "kind", "tumour"},
                     {"no-opengl", "start without OpenGL"},
                     {"steps", "in which rates are measured", "n", "600"}});
  parser.process(application);

  ui::apply_theme(application, ui::Theme::light);
  const qint64 before_engine_ms = start.elapsed();
  engine::Engine engine(!parser.isSet("no-opengl"));
  const qint64 engine_ms = start.elapsed() - before_engine_ms;
  ui::MainWindow window(engine);
  const auto executor = solver::executor_named(parser.value("executor").toStdString());
  if (!executor) qFatal("--executor is host, compute, stream or auto");
  window.set_executor(*executor);
  window.resize(1280, 800);
  window.show();
  wait_for([&] { return window.windowHandle()->isExposed(); }, 10000);
  std::printf("start: %lld ms for Qt, %lld ms for the engine, window after %lld ms; %s draws, as %s\n",
              static_cast<long long>(application_ms), static_cast<long long>(engine_ms),
              static_cast<long long>(start.elapsed()),
              engine.renderer() == renderer::RendererKind::gl ? "gl" : "host",
              engine.renderer_reason().c_str());
  if (parser.isSet("open")) return measure_opening(window, parser.value("open"));
  window.open_phantom(parser.value("phantom"));
  if (!wait_for([&] { return window.active_case() != nullptr; }, 60000)) return 1;
  engine::CaseProxy& proxy = window.active_case()->proxy();
  application.longest_ms = 0.0;
  std::printf("%s, %s, playing:\n", qPrintable(parser.value("phantom")), qPrintable(proxy.state().executor));
  measure_rates(*window.active_case(), parser.value("steps").toLongLong());
  proxy.play();
  measure_latency(*window.active_case());
  proxy.pause();
  std::printf("  longest event of the user interface %.0f ms\n", application.longest_ms);
  return 0;
}
