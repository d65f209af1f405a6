// The text that goes with a report of a problem.
#include "app/desktop/diagnostics.h"

#include <QRegularExpression>
#include <QSysInfo>
#include <QTest>
#include <string>

#include "tests/support/test_program.h"

namespace tidemark::test::diagnostics_test {

namespace {

bool has(const std::string& all, const std::string& part) {
  return all.find(part) != std::string::npos;
}

desktop::Diagnostics example() {
  desktop::Diagnostics d;
  d.version = "1.2.3";
  d.qt_version = "6.4.2";
  d.qt_platform = "xcb";
  d.locale = "de_DE";
  d.graphics = "software";
  d.opengl.emplace();
  d.opengl->vendor = "Mesa";
  d.opengl->renderer = "llvmpipe";
  d.opengl->version = "4.5 (Core Profile)";
  d.opengl->major = 4;
  d.opengl->minor = 5;
  d.opengl->largest_volume_texture = 2048;
  d.renderer = "host";
  d.renderer_reason = "there is no GPU";
  d.automatic_executor = "host";
  d.executor_reason = "there is no GPU with OpenGL 4.5";
  d.instruction_set = "avx2";
  return d;
}

}  // namespace

class DiagnosticsTest : public QObject {
  Q_OBJECT
 private slots:
  void versions_driver_and_limits_are_named() {
    const std::string all = desktop::text(example());
    for (const char* part :
         {"1.2.3", "6.4.2", "xcb", "de_DE", "software", "Mesa", "llvmpipe", "4.5 (Core Profile)",
          "2048 voxels", "compute shaders:    yes", "renderer:           host, as there is no GPU\n",
          "automatic executor: host, as there is no GPU with OpenGL 4.5\n", "avx2"}) {
      QVERIFY2(has(all, part), part);
    }
  }

  void without_opengl_the_reason_is_given_and_no_limits() {
    desktop::Diagnostics d = example();
    d.graphics = "none";
    d.graphics_problem = "no libGL";
    d.renderer_reason = "there is no OpenGL";
    d.opengl.reset();
    const std::string all = desktop::text(d);
    QVERIFY(has(all, "none\n"));
    QVERIFY(has(all, "no libGL\n"));
    QVERIFY(has(all, "renderer:           host, as there is no OpenGL\n"));
    QVERIFY(!has(all, "opengl"));
    QVERIFY(!has(all, "3d texture"));
  }

  void an_unknown_renderer_is_told() {
    desktop::Diagnostics d = example();
    QVERIFY(!has(desktop::text(d), "renderer problem"));
    d.renderer_problem = "TIDEMARK_RENDERER: 'fast' is unknown";
    QVERIFY(has(desktop::text(d), "renderer problem:   TIDEMARK_RENDERER: 'fast' is unknown\n"));
  }

  void an_opengl_before_compute_shaders_says_so() {
    desktop::Diagnostics d = example();
    d.opengl->minor = 1;
    QVERIFY(has(desktop::text(d), "compute shaders:    no"));
  }

  void the_machine_is_described_without_its_name_or_its_users() {
    desktop::Diagnostics d = example();
    desktop::describe_machine(d);
    QVERIFY(d.processors >= 1);
    QVERIFY(d.memory_bytes > d.free_memory_bytes);
    QVERIFY(d.free_memory_bytes > 0);
    QVERIFY(!d.system.empty());
    QVERIFY(!d.architecture.empty());
    const QString all = QString::fromStdString(desktop::text(d));
    const QStringList words = all.split(QRegularExpression(QStringLiteral("[\\s,]+")));
    QVERIFY(!words.contains(QSysInfo::machineHostName()));
    QVERIFY(!words.contains(qEnvironmentVariable("USER", QStringLiteral("root"))));
    QVERIFY(!all.contains(QRegularExpression(QStringLiteral("\\s/"))));  // no path of any file
  }

  void what_is_not_known_is_said_to_be_unknown() {
    const std::string all = desktop::text({});
    QVERIFY(has(all, "memory:             unknown"));
    QVERIFY(has(all, "processors:         unknown"));
    QVERIFY(has(all, "renderer:           unknown"));
  }
};

TIDEMARK_TEST(DiagnosticsTest)

}  // namespace tidemark::test::diagnostics_test

#include "diagnostics_test.moc"
