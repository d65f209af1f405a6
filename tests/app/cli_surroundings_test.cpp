// What the program is started in makes no difference to its results.
#include <fcntl.h>
#include <unistd.h>

#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_surroundings_test {

class CliSurroundingsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_terminal_gets_a_progress_bar_data();
  void a_terminal_gets_a_progress_bar();
  void a_german_locale_changes_nothing();

 private:
  TemporaryFolder folder_;
  const SphereStudy sphere_;
};

void CliSurroundingsTest::a_terminal_gets_a_progress_bar_data() {
  QTest::addColumn<QStringList>("arguments");
  QTest::addColumn<QByteArray>("work");
  QTest::newRow("steps") << sphere_.arguments() + QStringList{"--steps", "20"} << QByteArray(" % ");
  // It is drawn while it is written.
  QTest::newRow("a film") << QStringList{"film",       text(sphere_ / "series"),
                                         "--mask",     text(sphere_ / "truth.nii.gz"),
                                         "--turn",     "90",
                                         "--frames",   "24",
                                         "--size",     "200x150",
                                         "--renderer", "host",
                                         "--out",      text(folder_ / "turn.gif")}
                          << QByteArray(" % drawing");
}

// util-linux' script gives the program a terminal.
void CliSurroundingsTest::a_terminal_gets_a_progress_bar() {
  QFETCH(QStringList, arguments);
  QFETCH(QByteArray, work);
  // A machine may have no pseudo-terminals, as in a root folder without /dev/pts.
  const int terminal = ::posix_openpt(O_RDWR);
  if (terminal < 0) QSKIP("NOT TESTED: this machine has no pseudo-terminals (/dev/pts)");
  ::close(terminal);
  QProcess script;
  const QStringList command = QStringList{cli_program()} + arguments;
  script.start("script", {"-qec", command.join(' '), "/dev/null"});
  QVERIFY2(script.waitForFinished(60'000), "script is needed (Debian: package bsdutils)");
  const QByteArray seen = script.readAllStandardOutput();
  QCOMPARE(script.exitCode(), 0);
  QVERIFY2(seen.contains(work) && seen.contains("[....") && seen.contains("\033[K"), seen);
}

// The locale is made here: machines have few of them installed.
void CliSurroundingsTest::a_german_locale_changes_nothing() {
  QProcess localedef;
  localedef.start("localedef", {"-i", "de_DE", "-f", "UTF-8", text(folder_ / "de_DE.UTF-8")});
  QVERIFY2(localedef.waitForFinished(60'000), "localedef is needed (Debian: package locales)");
  RunOptions german;
  german.environment.insert("LOCPATH", text(folder_.path()));
  german.environment.insert("LC_ALL", "de_DE.UTF-8");
  QProcess locale;
  locale.setProcessEnvironment(german.environment);
  locale.start("locale", {"decimal_point"});
  QVERIFY(locale.waitForFinished());
  QCOMPARE(locale.readAllStandardOutput(), QByteArray(",\n"));
  RunOptions plain;
  plain.environment.insert("LC_ALL", "C");

  const auto arguments = [&](const char* name) {
    const std::string stem = name;
    return sphere_.arguments() + QStringList{"--steps",   "15",
                                             "--smooth",  "1.25",
                                             "--seed-mm", "-1.5,0.25,2,6.5",
                                             "--out",     text(folder_ / (stem + ".nrrd")),
                                             "--out",     text(folder_ / (stem + ".obj")),
                                             "--out-phi", text(folder_ / (stem + "_phi.nii")),
                                             "--json"};
  };
  QJsonObject one = json_of(must_run(arguments("german"), german).out);
  QJsonObject other = json_of(must_run(arguments("plain"), plain).out);
  QVERIFY(one["volume_ml"].toDouble() > 1.0);
  for (const char* key : {"seconds", "steps_per_second", "voxel_updates_per_second", "paging_seconds"}) {
    one.remove(key);
    other.remove(key);
  }
  QCOMPARE(one, other);
  for (const char* end : {".nrrd", ".obj", "_phi.nii"}) {
    QCOMPARE(bytes_of(folder_ / (std::string("german") + end)),
             bytes_of(folder_ / (std::string("plain") + end)));
  }
}

TIDEMARK_TEST(CliSurroundingsTest)

}  // namespace tidemark::test::cli_surroundings_test

#include "cli_surroundings_test.moc"
