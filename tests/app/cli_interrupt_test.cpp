// Ctrl-C and termination wind down without leaving anything behind.
#include <signal.h>

#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

using namespace tidemark;
using namespace tidemark::test;

class CliInterruptTest : public QObject {
  Q_OBJECT

 private slots:
  void an_interrupted_segmentation_writes_nothing_data();
  void an_interrupted_segmentation_writes_nothing();
};

void CliInterruptTest::an_interrupted_segmentation_writes_nothing_data() {
  QTest::addColumn<int>("signal");
  QTest::addColumn<QString>("executor");
  QTest::newRow("SIGINT, host") << SIGINT << "host";
  QTest::newRow("SIGTERM, host") << SIGTERM << "host";
  QTest::newRow("SIGINT, reference") << SIGINT << "reference";
}

void CliInterruptTest::an_interrupted_segmentation_writes_nothing() {
  QFETCH(int, signal);
  QFETCH(QString, executor);
  TemporaryFolder folder;
  const auto out = folder / "out";
  std::filesystem::create_directory(out);
  QCOMPARE(failure(write_volume_file(ball(Index3(48), 16.0), folder / "ball.nrrd")), QString());
  QProcess process;
  const QStringList arguments{"segment",
                              text(folder / "ball.nrrd"),
                              "--steps",
                              "900000000",
                              "--no-skip",
                              "--executor",
                              executor,
                              "--out",
                              text(out / "m.nii.gz"),
                              "--out",
                              text(out / "m.stl"),
                              "--out-phi",
                              text(out / "phi.nrrd"),
                              "--stats",
                              text(out / "s.json")};
  QVERIFY(start_cli(process, arguments + ball_arguments(Index3(48)), "Start "));
  QTest::qWait(100);
  QCOMPARE(::kill(static_cast<pid_t>(process.processId()), signal), 0);
  QVERIFY(process.waitForFinished(60'000));
  QCOMPARE(process.exitStatus(), QProcess::NormalExit);
  QCOMPARE(process.exitCode(), 130);
  QCOMPARE(process.readAllStandardError(), QByteArray("tidemark-cli: error: interrupted\n"));
  QCOMPARE(names_in(out), QStringList());
}

TIDEMARK_TEST(CliInterruptTest)
#include "cli_interrupt_test.moc"
