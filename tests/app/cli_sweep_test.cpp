// Many runs from one start: the table, the picture, and what is refused.
#include <QJsonArray>
#include <QtEndian>

#include "core/atomic_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_sweep_test {

class CliSweepTest : public QObject {
  Q_OBJECT

 private slots:
  void each_line_of_the_table_is_a_run_of_segment();
  void one_parameter_is_swept_alone();
  void a_folder_that_is_there_keeps_its_files();
  void wrong_usage_ends_with_2_and_one_line_data();
  void wrong_usage_ends_with_2_and_one_line();
  void an_axis_that_the_start_depends_on_is_refused_data();
  void an_axis_that_the_start_depends_on_is_refused();
  void a_start_by_the_speed_is_that_of_segment();
  void too_little_memory_ends_with_4();

 private:
  // The phantom's options with another command.
  [[nodiscard]] QStringList sweep() const { return QStringList{"sweep"} + sphere_.arguments().mid(1); }
  [[nodiscard]] QString out() const { return text(folder_ / "out"); }

  TemporaryFolder folder_;
  const SphereStudy sphere_;
};

void CliSweepTest::each_line_of_the_table_is_a_run_of_segment() {
  const QStringList truth{"--truth", text(sphere_ / "truth.nii.gz")};
  const QJsonObject said = json_of(
      must_run(sweep() + truth +
               QStringList{"--over", "alpha=0.3:0.9:3", "--over", "range=90:150:2", "--out", out(), "--json"})
          .out);
  QCOMPARE(said["axes"].toArray().size(), 2);
  const QList<QByteArray> lines = bytes_of(folder_ / "out" / "sweep.csv").trimmed().split('\n');
  QCOMPARE(lines.size(), 7);
  const QList<QByteArray> names = lines.first().split(',');
  QCOMPARE(names.mid(0, 3), (QList<QByteArray>{"alpha", "range", "steps"}));
  for (int i = 1; i < lines.size(); ++i) {
    const QList<QByteArray> fields = lines[i].split(',');
    QCOMPARE(fields.size(), names.size());
    const auto field = [&](const char* name) { return QString::fromUtf8(fields[names.indexOf(name)]); };
    const QStringList single{"--alpha",    field("alpha"), "--range", field("range"),
                             "--executor", "host",         "--json"};
    const QStringList start = sphere_.arguments();
    QStringList arguments;
    for (int word = 0; word < start.size(); ++word) {
      if (start[word] == "--alpha" || start[word] == "--range") {
        ++word;  // and its value
      } else {
        arguments << start[word];
      }
    }
    const QJsonObject stats = json_of(must_run(arguments + truth + single).out);
    QCOMPARE(field("steps").toInt(), stats["steps"].toInt());
    QCOMPARE(field("voxels_inside").toInt(), stats["voxels_inside"].toInt());
    QCOMPARE(field("volume_ml").toDouble(), stats["volume_ml"].toDouble());
    QCOMPARE(field("dice").toDouble(), stats["dice"].toDouble());
    QCOMPARE(field("outcome"), stats["outcome"].toString());
    QCOMPARE(said["runs"].toArray()[i - 1].toObject()["volume_ml"].toDouble(), stats["volume_ml"].toDouble());
  }
  // The size of a PNG stands behind its signature and the name of its first part.
  const QByteArray picture = bytes_of(folder_ / "out" / "sweep.png");
  QVERIFY(picture.startsWith("\x89PNG") && picture.size() > 10'000);
  const auto width = qFromBigEndian<quint32>(picture.constData() + 16);
  const auto height = qFromBigEndian<quint32>(picture.constData() + 20);
  QVERIFY2(width > 500 && width < 700 && height > 500 && height < 700, qPrintable(QString::number(width)));
}

void CliSweepTest::one_parameter_is_swept_alone() {
  const Outcome outcome = must_run(sweep() + QStringList{"--over", "target=600:900:4", "--out", out()});
  QVERIFY2(outcome.out.contains("Runs       4 in"), outcome.told());
  QCOMPARE(bytes_of(folder_ / "out" / "sweep.csv").count('\n'), 5);
}

void CliSweepTest::a_folder_that_is_there_keeps_its_files() {
  const auto folder = folder_ / "mine";
  std::filesystem::create_directory(folder);
  QVERIFY(write_file(folder / "notes.txt", "mine"));
  must_run(sweep() + QStringList{"--over", "alpha=0.5:0.9:2", "--out", text(folder)});
  QCOMPARE(names_in(folder), (QStringList{"notes.txt", "sweep.csv", "sweep.png"}));
}

void CliSweepTest::wrong_usage_ends_with_2_and_one_line_data() {
  QTest::addColumn<QStringList>("over");
  QTest::addColumn<QString>("message");
  const auto row = [](const char* name, const QStringList& over, const char* message) {
    QStringList words;
    for (const QString& axis : over) words << "--over" << axis;
    QTest::newRow(name) << words << message;
  };
  row("no axis", {}, "--over is required");
  row("three", {"alpha=0.2:0.9:2", "range=30:60:2", "target=1:2:2"}, "one or two parameters, not 3");
  row("no count", {"alpha=0.2:0.9"}, "--over alpha=0.2:0.9: NAME=FROM:TO:COUNT is needed");
  row("unknown", {"beta=0:1:2"}, "--over: beta: there is no such parameter here");
  row("out of range", {"alpha=0.2:1.9:2"}, "alpha must be between 0 and 1");
  row("another function", {"edges.balloon=0:1:2"}, "edges.balloon: there is no such parameter here");
  row("an executor", {"alpha=0.2:0.9:2", "--executor"}, "--over --executor");
}

void CliSweepTest::wrong_usage_ends_with_2_and_one_line() {
  QFETCH(QStringList, over);
  QFETCH(QString, message);
  const Outcome outcome = run_cli(sweep() + over + QStringList{"--out", text(folder_ / "none")});
  QVERIFY2(outcome.failed_in_one_line(2), outcome.told());
  QVERIFY2(outcome.err.contains(message.toUtf8()), outcome.told());
  QVERIFY(!std::filesystem::exists(folder_ / "none"));
}

void CliSweepTest::an_axis_that_the_start_depends_on_is_refused_data() {
  QTest::addColumn<QStringList>("arguments");
  QTest::addColumn<QString>("message");
  QTest::newRow("range") << QStringList{"--init-speed", "--over", "range=50:150:3"}
                         << "--over range: the start that --init-speed makes";
  QTest::newRow("the second") << QStringList{"--init-speed", "--over", "alpha=0.5:0.9:2", "--over",
                                             "target=600:900:2"}
                              << "--over target: the start that --init-speed makes";
  QTest::newRow("a function's")
      << QStringList{"--init-speed",           "--speed", "tent", "--speed", "edges", "--over",
                     "edges.balloon=0.3:0.9:2"}
      << "--over edges.balloon: the start that --init-speed makes";
  QTest::newRow("chosen") << QStringList{"--auto-start", "--over", "target=600:900:2"}
                          << "--over target: the start that --auto-start makes";
}

void CliSweepTest::an_axis_that_the_start_depends_on_is_refused() {
  QFETCH(QStringList, arguments);
  QFETCH(QString, message);
  const Outcome outcome =
      run_cli(sweep() + arguments + QStringList{"--steps", "0", "--out", text(folder_ / "none")});
  QVERIFY2(outcome.failed_in_one_line(2), outcome.told());
  QVERIFY2(outcome.err.contains(message.toUtf8()), outcome.told());
  QVERIFY(!std::filesystem::exists(folder_ / "none"));
}

void CliSweepTest::a_start_by_the_speed_is_that_of_segment() {
  const QStringList start{"--init-speed", "--steps", "0", "--json"};
  const QJsonArray runs =
      json_of(must_run(sweep() + start +
                       QStringList{"--over", "alpha=0.5:0.9:2", "--out", text(folder_ / "by-speed")})
                  .out)["runs"]
          .toArray();
  const QJsonObject alone =
      json_of(must_run(sphere_.arguments() + start + QStringList{"--executor", "host"}).out);
  QCOMPARE(runs.size(), 2);
  QVERIFY(alone["voxels_inside"].toInt() > 1000);
  for (const QJsonValue run : runs) {
    QCOMPARE(run.toObject()["voxels_inside"].toInt(), alone["voxels_inside"].toInt());
  }
}

void CliSweepTest::too_little_memory_ends_with_4() {
  const Outcome outcome = run_cli(sweep() + QStringList{"--over", "alpha=0.5:0.9:2", "--memory-budget", "1",
                                                        "--out", text(folder_ / "none")});
  QVERIFY2(outcome.failed_in_one_line(4), outcome.told());
  QVERIFY2(outcome.err.contains("no run has an end"), outcome.told());
}

TIDEMARK_TEST(CliSweepTest)

}  // namespace tidemark::test::cli_sweep_test

#include "cli_sweep_test.moc"
