// Ctrl-C and termination wind down without leaving anything behind.
#include <fcntl.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <algorithm>
#include <random>

#include "core/atomic_file.h"
#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_interrupt_test {

namespace {

// Whether the process has come so far, or has ended: before that, a signal has its own way.
bool awaits_signals(pid_t id) {
  const QByteArray state = bytes_of("/proc/" + std::to_string(id) + "/status");
  const auto at = state.indexOf("SigBlk:");
  if (at < 0) return true;
  return (state.mid(at + 7, 20).trimmed().toULongLong(nullptr, 16) & (1ULL << (SIGTERM - 1))) != 0 ||
         state.contains("State:\tZ");
}

}  // namespace

class CliInterruptTest : public QObject {
  Q_OBJECT

 private slots:
  void an_interrupted_segmentation_writes_nothing_data();
  void an_interrupted_segmentation_writes_nothing();
  void what_cannot_be_asked_to_stop_ends_within_a_second_data();
  void what_cannot_be_asked_to_stop_ends_within_a_second();
  void an_interrupted_write_of_a_volume_is_told();
  void a_signal_that_was_ignored_before_stays_ignored();
  void every_command_ends_within_a_second_data();
  void every_command_ends_within_a_second();
  void what_takes_hours_ends_by_itself_data();
  void what_takes_hours_ends_by_itself();

 private:
  [[nodiscard]] QString endless_recipe(const TemporaryFolder& folder) const;
  [[nodiscard]] QStringList filled_in(QStringList arguments, const TemporaryFolder& folder) const;
  [[nodiscard]] bool ends_by_itself(const QStringList& arguments, const QByteArray& line) const;

  SphereStudy sphere_;
};

void CliInterruptTest::an_interrupted_segmentation_writes_nothing_data() {
  QTest::addColumn<int>("signal");
  QTest::addColumn<QString>("executor");
  QTest::newRow("SIGINT, host") << SIGINT << "host";
  QTest::newRow("SIGTERM, host") << SIGTERM << "host";
  QTest::newRow("SIGHUP, host") << SIGHUP << "host";
  QTest::newRow("SIGINT, reference") << SIGINT << "reference";
}

void CliInterruptTest::an_interrupted_segmentation_writes_nothing() {
  QFETCH(int, signal);
  QFETCH(QString, executor);
  TemporaryFolder folder;
  const auto out = folder / "out";
  std::filesystem::create_directory(out);
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(48), 16.0), folder / "ball.nrrd")), QString());
  QProcess process;
  set_ignored_signals(process, {});
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

// Whoever writes to a pipe that is full and read by nobody waits for ever: no stop token reaches it there.
void CliInterruptTest::what_cannot_be_asked_to_stop_ends_within_a_second_data() {
  QTest::addColumn<int>("signal");
  QTest::newRow("SIGINT") << SIGINT;
  QTest::newRow("SIGTERM") << SIGTERM;
  QTest::newRow("SIGHUP") << SIGHUP;
}

void CliInterruptTest::what_cannot_be_asked_to_stop_ends_within_a_second() {
  QFETCH(int, signal);
  TemporaryFolder folder;
  std::filesystem::copy(sphere_ / "series", folder / "study");
  const std::string name = "this-file-is-no-image-and-so-it-makes-a-line-of-what-the-program-says";
  for (int i = 0; i < 1000; ++i) {
    QVERIFY(write_file(folder / "study" / (name + std::to_string(i) + ".txt"), "no image"));
  }
  const auto pipe = folder / "pipe";
  QCOMPARE(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  QVERIFY(reader >= 0);
  QProcess process;
  set_ignored_signals(process, {});
  process.setStandardOutputFile(text(pipe));
  process.start(cli_program(), {"info", text(folder / "study")});
  QVERIFY(process.waitForStarted());
  int bytes = 0;
  QTRY_VERIFY_WITH_TIMEOUT(::ioctl(reader, FIONREAD, &bytes) == 0 && bytes > 60'000, 60'000);
  QVERIFY(!process.waitForFinished(200));
  QElapsedTimer timer;
  timer.start();
  QCOMPARE(::kill(static_cast<pid_t>(process.processId()), signal), 0);
  QVERIFY(process.waitForFinished(10'000));
  const qint64 took = timer.elapsed();
  ::close(reader);
  QCOMPARE(process.exitStatus(), QProcess::NormalExit);
  QCOMPARE(process.exitCode(), 130);
  QCOMPARE(process.readAllStandardError(), QByteArray("tidemark-cli: error: interrupted\n"));
  QVERIFY2(took < 1000, qPrintable(QString::number(took)));
}

// Noise, which takes long to compress, and nothing stops it half way.
void CliInterruptTest::an_interrupted_write_of_a_volume_is_told() {
  TemporaryFolder folder;
  const auto out = folder / "out";
  std::filesystem::create_directory(out);
  Volume noise;
  noise.geometry.size = Index3(256);
  std::vector<std::int16_t> voxels(static_cast<std::size_t>(noise.geometry.voxel_count()));
  std::minstd_rand random;
  std::generate(voxels.begin(), voxels.end(), [&] { return static_cast<std::int16_t>(random()); });
  noise.voxels = std::move(voxels);
  QCOMPARE(failure(imaging::write_volume_file(noise, folder / "noise.nii")), QString());
  QProcess process;
  process.start(cli_program(), {"convert", text(folder / "noise.nii"), "--out", text(out / "noise.nii.gz")});
  QVERIFY(process.waitForStarted());
  const auto begun = [&] {
    const QStringList names = names_in(out);
    return std::any_of(names.begin(), names.end(), [&](const QString& name) {
      std::error_code gone;
      const auto size = std::filesystem::file_size(out / name.toStdString(), gone);
      return !gone && size > 0;
    });
  };
  for (int wait = 0; wait < 60'000 && !begun(); ++wait) QTest::qSleep(1);
  QCOMPARE(::kill(static_cast<pid_t>(process.processId()), SIGTERM), 0);
  QVERIFY(process.waitForFinished(60'000));
  QCOMPARE(process.exitCode(), 130);
  QCOMPARE(process.readAllStandardError(), QByteArray("tidemark-cli: error: interrupted\n"));
  QCOMPARE(names_in(out), QStringList());
}

void CliInterruptTest::a_signal_that_was_ignored_before_stays_ignored() {
  TemporaryFolder folder;
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(48), 16.0), folder / "ball.nrrd")), QString());
  QProcess process;
  set_ignored_signals(process, {SIGHUP, SIGINT});
  const QStringList arguments{
      "segment", text(folder / "ball.nrrd"), "--steps", "900000000", "--no-skip", "--executor", "host"};
  QVERIFY(start_cli(process, arguments + ball_arguments(Index3(48)), "Start "));
  const auto id = static_cast<pid_t>(process.processId());
  for (const int signal : {SIGHUP, SIGINT}) QCOMPARE(::kill(id, signal), 0);
  QVERIFY(!process.waitForFinished(1000));  // what is asked to stop ends sooner
  QCOMPARE(::kill(id, SIGTERM), 0);
  QVERIFY(process.waitForFinished(60'000));
  QCOMPARE(process.exitCode(), 130);
}

void CliInterruptTest::every_command_ends_within_a_second_data() {
  QTest::addColumn<QStringList>("arguments");
  const auto row = [](const char* words) { QTest::newRow(words) << QString(words).split(' '); };
  row("phantom cortex --out OUT/phantom");
  row("info SERIES");
  row("deidentify SERIES --out OUT/anonymous");
  row("convert SERIES --out OUT/volume.nii.gz");
  row("distance MASK --out OUT/distance.nii.gz");
  row("bench");
  const QStringList endless = QString("--steps 900000000 --no-skip").split(' ');
  QTest::newRow("segment") << sphere_.arguments() + endless + QStringList{"--out", "OUT/mask.nii.gz"};
  QTest::newRow("sweep") << QStringList{"sweep"} + sphere_.arguments().mid(1) + endless +
                                QStringList{"--over", "alpha=0.3:0.9:3", "--out", "OUT/sweep"};
  row("replay RECIPE SERIES --no-skip --threads 1 --out OUT/mask.nii.gz");
  row("render SERIES --size 2048x2048 --view 3d --preset ct-bone --out OUT/picture.png");
}

// What segments the sphere with steps for hours.
QString CliInterruptTest::endless_recipe(const TemporaryFolder& folder) const {
  const auto file = folder / "recipe.json";
  must_run(sphere_.arguments() + QStringList{"--steps", "3", "--recipe", text(file)});
  const QByteArray recipe = bytes_of(file);
  QByteArray endless = recipe;
  endless.replace("\"steps\": 3", "\"steps\": 900000000");
  if (endless == recipe || !write_file(file, endless.toStdString())) qFatal("there is no recipe");
  return text(file);
}

// Arguments with the names of files, of which those in OUT are to be written.
QStringList CliInterruptTest::filled_in(QStringList arguments, const TemporaryFolder& folder) const {
  std::filesystem::create_directory(folder / "out");
  for (QString& word : arguments) {
    word.replace("SERIES", text(sphere_ / "series"));
    word.replace("MASK", text(sphere_ / "truth.nii.gz"));
    word.replace("OUT", text(folder / "out"));
    if (word == "RECIPE") word = endless_recipe(folder);
  }
  return arguments;
}

void CliInterruptTest::every_command_ends_within_a_second() {
  QFETCH(QStringList, arguments);
  TemporaryFolder folder;
  const auto out = folder / "out";
  arguments = filled_in(arguments, folder);
  // At whatever it is doing then.
  for (const int milliseconds : {0, 30, 150, 1000}) {
    QProcess process;
    process.start(cli_program(), arguments);
    QVERIFY(process.waitForStarted());
    const pid_t id = static_cast<pid_t>(process.processId());
    for (int wait = 0; wait < 1000 && !awaits_signals(id); ++wait) QTest::qSleep(1);
    if (milliseconds > 0 && process.waitForFinished(milliseconds)) continue;
    QElapsedTimer timer;
    timer.start();
    static_cast<void>(::kill(id, SIGTERM));
    QVERIFY(process.waitForFinished(60'000));
    const qint64 took = timer.elapsed();
    QVERIFY2(took < 1000, qPrintable(QString::number(took)));
    const QByteArray said = process.readAllStandardError();
    QVERIFY2(process.exitStatus() == QProcess::NormalExit, said.constData());
    QVERIFY2(process.exitCode() == 130 || process.exitCode() == 0, said.constData());
    for (const QString& name : names_in(out)) QVERIFY2(!name.startsWith('.'), qPrintable(name));
  }
}

void CliInterruptTest::what_takes_hours_ends_by_itself_data() {
  QTest::addColumn<QStringList>("arguments");
  QTest::addColumn<QByteArray>("line");
  const QStringList endless{"--steps", "900000000", "--no-skip"};
  QTest::newRow("segment") << sphere_.arguments() + endless + QStringList{"--out", "OUT/mask.nii.gz"}
                           << QByteArray("Start ");
  QTest::newRow("sweep") << QStringList{"sweep"} + sphere_.arguments().mid(1) + endless +
                                QStringList{"--over", "alpha=0.3:0.9:3", "--out", "OUT/sweep"}
                         << QByteArray("Start ");
  QTest::newRow("replay") << QStringList{"replay",    "RECIPE", "SERIES", "--no-skip",
                                         "--threads", "1",      "--out",  "OUT/mask.nii.gz"}
                          << QByteArray("Recipe ");
}

// Whether its end after a signal was audited, which who is ended by force has no time for.
bool CliInterruptTest::ends_by_itself(const QStringList& arguments, const QByteArray& line) const {
  TemporaryFolder folder;
  std::filesystem::create_directories(folder / "config" / "tidemark");
  if (!write_file(folder / "config" / "tidemark" / "audit.json", R"({"file": "audit.log"})")) return false;
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("XDG_CONFIG_HOME", text(folder / "config"));
  environment.insert("XDG_STATE_HOME", text(folder / "state"));
  environment.insert("TIDEMARK_SITE", text(folder / "site"));
  QProcess process;
  process.setProcessEnvironment(environment);
  if (!start_cli(process, filled_in(arguments, folder), line)) return false;
  QTest::qWait(100);
  static_cast<void>(::kill(static_cast<pid_t>(process.processId()), SIGTERM));
  if (!process.waitForFinished(60'000) || process.exitCode() != 130) return false;
  // It has been delivered, or waits for it.
  QByteArray messages = bytes_of(folder / "config" / "tidemark" / "audit.log");
  std::error_code none;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "state", none)) {
    if (entry.is_regular_file()) messages += bytes_of(entry.path());
  }
  return messages.contains("\"110121\"");
}

// Where other programs take the processors it may be ended by force once, but not each time.
void CliInterruptTest::what_takes_hours_ends_by_itself() {
  QFETCH(const QStringList, arguments);
  QFETCH(const QByteArray, line);
  bool by_itself = false;
  for (int attempt = 0; attempt < 5 && !by_itself; ++attempt) by_itself = ends_by_itself(arguments, line);
  QVERIFY(by_itself);
}

TIDEMARK_TEST(CliInterruptTest)

}  // namespace tidemark::test::cli_interrupt_test

#include "cli_interrupt_test.moc"
