#include "app/desktop/glx_fallback.h"

#include <QString>
#include <QtGlobal>
#include <cstdio>

#include <unistd.h>

namespace tidemark::desktop {
namespace {

constexpr const char* kIntegration = "QT_XCB_GL_INTEGRATION";
char** arguments_of_main = nullptr;

// What Qt says before it ends the program.
bool is_about_glx(QtMsgType type, const QString& message) {
  return type == QtFatalMsg && message.contains(QLatin1String("initialize GLX"));
}

void receive(QtMsgType type, const QMessageLogContext& context, const QString& message) {
  if (is_about_glx(type, message) && !qEnvironmentVariableIsSet(kIntegration)) {
    qputenv(kIntegration, "xcb_egl");
    std::fputs("tidemark: this display's GLX has no visuals; starting without it\n", stderr);
    ::execv("/proc/self/exe", arguments_of_main);
  }
  std::fprintf(stderr, "%s\n", qPrintable(qFormatLogMessage(type, context, message)));
}

}  // namespace

GlxFallback::GlxFallback(char** arguments) {
  arguments_of_main = arguments;
  qInstallMessageHandler(receive);
}

GlxFallback::~GlxFallback() {
  qInstallMessageHandler(nullptr);
}

}  // namespace tidemark::desktop
