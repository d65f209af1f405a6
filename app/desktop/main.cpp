// tidemark: the desktop.
#include <QApplication>
#include <QCommandLineParser>
#include <QLocale>
#include <QMessageBox>
#include <QTextStream>
#include <algorithm>
#include <clocale>
#include <cstdio>
#include <future>
#include <optional>

#include "app/desktop/audit.h"
#include "app/desktop/diagnostics.h"
#include "app/desktop/glx_fallback.h"
#include "core/result.h"
#include "core/without_exceptions.h"
#include "engine/engine.h"
#include "engine/message_text.h"
#include "solver/host/page_kernel.h"
#include "solver/trial.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/main/language_switch.h"
#include "ui/main/main_window.h"
#include "ui/main/session_reader.h"
#include "ui/settings.h"

namespace {

using namespace tidemark;

std::string describe(engine::Engine::Graphics graphics) {
  switch (graphics) {
    case engine::Engine::Graphics::hardware:
      return "hardware";
    case engine::Engine::Graphics::software:
      return "software";
    case engine::Engine::Graphics::none:
      return "none";
  }
  return {};
}

// Whether a case would compute on the GPU, and if not what is wrong with it.
Status try_gpu(engine::Engine& engine) {
  if (engine.graphics() != engine::Engine::Graphics::hardware || !engine.capabilities().at_least(4, 5)) {
    return fail(ErrorKind::capability, "there is no GPU with OpenGL 4.5");
  }
  std::promise<Status> passed;
  engine.post(engine::Priority::step, nullptr, [&](const std::stop_token&) {
    passed.set_value(without_exceptions([&] { return solver::try_compute(engine.device()); }));
  });
  return passed.get_future().get();
}

void print_diagnostics(engine::Engine& engine) {
  desktop::Diagnostics diagnostics;
  diagnostics.version = TIDEMARK_VERSION;
  diagnostics.qt_version = qVersion();
  diagnostics.qt_platform = QGuiApplication::platformName().toStdString();
  diagnostics.locale = QLocale::system().name().toStdString();
  diagnostics.graphics = describe(engine.graphics());
  diagnostics.graphics_problem = engine.graphics_problem();
  if (engine.graphics() != engine::Engine::Graphics::none) diagnostics.opengl = engine.capabilities();
  diagnostics.renderer = engine.renderer() == renderer::RendererKind::gl ? "gl" : "host";
  diagnostics.renderer_reason = engine.renderer_reason();
  diagnostics.renderer_problem = engine.renderer_problem();
  const Status gpu = try_gpu(engine);
  diagnostics.automatic_executor = gpu ? "compute" : "host";
  diagnostics.executor_reason = gpu ? "the GPU passes a trial" : gpu.error().message;
  if (const auto kernels = solver::select_page_kernels("")) diagnostics.instruction_set = kernels->name;
  desktop::describe_machine(diagnostics);
  QTextStream(stdout) << QString::fromStdString(desktop::text(diagnostics));
}

// Before there is an application to read its arguments.
bool has_argument(int argc, char** argv, const char* name) {
  return std::any_of(argv, argv + argc,
                     [name](const char* argument) { return argument == QByteArray(name); });
}

// Without a display Qt would end the program with a message about its installation. What needs no window
// works all the same.
bool can_start(int argc, char** argv) {
  if (qEnvironmentVariableIsSet("DISPLAY") || qEnvironmentVariableIsSet("WAYLAND_DISPLAY") ||
      qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) {
    return true;
  }
  for (const char* one : {"-h", "--help", "-v", "--version", "--diagnostics", "--print-settings"}) {
    if (has_argument(argc, argv, one)) return qputenv("QT_QPA_PLATFORM", "offscreen");
  }
  return false;
}

// Ends the program before it has shown anything.
int refuse(const Error& error) {
  std::fprintf(stderr, "tidemark: %s\n", error.message.c_str());
  QMessageBox::critical(nullptr, QStringLiteral("Tidemark"), engine::message_text(error));
  return exit_code(error.kind);
}

}  // namespace

int main(int argc, char** argv) {
  if (!can_start(argc, argv)) {
    std::fputs("tidemark: there is no display; tidemark-cli works without one\n", stderr);
    return exit_code(ErrorKind::capability);
  }
  // Without it every undocking of a view would destroy its context; with it Qt makes a context at once.
  QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts, !has_argument(argc, argv, "--no-opengl"));
  QCoreApplication::setOrganizationName("tidemark");
  QCoreApplication::setApplicationName("tidemark");
  QCoreApplication::setApplicationVersion(TIDEMARK_VERSION);
  std::optional<desktop::GlxFallback> start(std::in_place, argv);
  QApplication application(argc, argv);
  start.reset();
  // Qt has set the system's locale; numbers are parsed and written with a point everywhere.
  std::setlocale(LC_NUMERIC, "C");

  QCommandLineParser parser;
  parser.setApplicationDescription(
      QCoreApplication::translate("main",
                                  "Steers a level-set surface through a medical volume while it evolves.\n"
                                  "Research use only. Not for diagnostic use."));
  parser.addHelpOption();
  parser.addVersionOption();
  parser.addPositionalArgument(
      "studies", QCoreApplication::translate("main", "Folders, image files, session files or links to open."),
      "[studies...]");
  const QCommandLineOption diagnostics(
      "diagnostics", QCoreApplication::translate("main", "Say what this computer offers, and end."));
  const QCommandLineOption phantom(
      "phantom", QCoreApplication::translate("main", "Open a synthetic study: tumour, head, organ, ..."),
      "kind");
  const QCommandLineOption without_opengl(
      "no-opengl", QCoreApplication::translate("main", "Start without OpenGL: the processor draws."));
  const QCommandLineOption print_settings(
      "print-settings",
      QCoreApplication::translate("main", "Say each setting, its value and whose it is, and end."));
  parser.addOptions({diagnostics, print_settings, phantom, without_opengl});
  parser.process(application);
  if (parser.isSet(print_settings)) {
    QTextStream(stdout) << ui::settings::print();
    return 0;
  }

  engine::Engine engine(!parser.isSet(without_opengl));
  if (const std::string& problem = engine.renderer_problem(); !problem.empty()) {
    std::fprintf(stderr, "tidemark: %s\n", problem.c_str());
  }
  if (parser.isSet(diagnostics)) {
    print_diagnostics(engine);
    return 0;
  }
  QGuiApplication::setDesktopFileName("tidemark");
  QGuiApplication::setWindowIcon(ui::application_icon());
  ui::apply_theme(application, ui::settings::theme().get());
  std::optional<ui::LanguageSwitch> desktop;
  desktop::Audit audit([&desktop](const Error& notice) {
    if (desktop) desktop->window().tell(engine::message_text(notice), "audit");
  });
  if (const Status begun = audit.begin(); !begun) return refuse(begun.error());
  desktop.emplace(engine);
  ui::MainWindow& window = desktop->window();
  window.session_reader().offer_rescued();
  for (const QString& study : parser.positionalArguments()) window.open(study);
  if (parser.isSet(phantom)) window.open_phantom(parser.value(phantom));
  const int code = QApplication::exec();
  desktop.reset();  // what it still reads is given up; what it writes is waited for, and audited
  return code;
}
