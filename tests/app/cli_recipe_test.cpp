// Recipes on the command line: what segment writes, replay does again.
#include <QJsonDocument>

#include "core/atomic_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_recipe_test {

namespace {

void write_json(const std::filesystem::path& file, const QJsonObject& object) {
  if (!write_file(file, QJsonDocument(object).toJson().toStdString())) qFatal("cannot write");
}

}  // namespace

class CliRecipeTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    QCOMPARE(failure(imaging::write_volume_file(ball(Index3(30), 9.0), folder_ / "ball.nrrd")), QString());
    QCOMPARE(failure(imaging::write_mask_file(ball_mask(ball(Index3(30), 5.0)), folder_ / "small.nii.gz")),
             QString());
  }

  void a_replay_writes_the_same_files_data() {
    QTest::addColumn<QStringList>("start");
    QTest::newRow("seeds") << QStringList{"--seed",     "15,15,15,4", "--seed-mm",
                                          "12,12,12,3", "--erase",    "15,15,18,2"};
    QTest::newRow("mask") << QStringList{"--init", text(folder_ / "small.nii.gz"), "--seed", "12,15,15,3"};
    QTest::newRow("threshold") << QStringList{"--init-threshold", "800,1200"};
    QTest::newRow("flood, smoothed") << QStringList{"--init-flood", "15,15,15,700,1200", "--smooth", "1.1"};
    QTest::newRow("paper's scheme") << QStringList{
        "--seed", "15,15,15,4", "--scheme", "paper", "--rescale", "0.3", "--no-curvature", "--band", "3"};
    QTest::newRow("stream") << QStringList{"--seed", "15,15,15,4", "--executor", "stream"};
    QTest::newRow("all pages") << QStringList{"--seed", "15,15,15,4", "--no-skip"};
  }
  void a_replay_writes_the_same_files() {
    QFETCH(QStringList, start);
    const QString volume = text(folder_ / "ball.nrrd");
    const QStringList parameters{"--target", "1000", "--range",     "450",
                                 "--alpha",  "0.75", "--max-steps", "90"};
    const auto run =
        QStringList{"segment", volume} + parameters + start +
        QStringList{"--out-phi", text(folder_ / "phi.nrrd"),    "--out",   text(folder_ / "mask.nrrd"),
                    "--recipe",  text(folder_ / "recipe.json"), "--stats", text(folder_ / "a.json")};
    QCOMPARE(must_run(run).code, 0);
    const Outcome replay =
        must_run({"replay", text(folder_ / "recipe.json"), volume, "--out-phi", text(folder_ / "phi2.nrrd"),
                  "--out", text(folder_ / "mask2.nrrd"), "--out", text(folder_ / "surface.stl"), "--stats",
                  text(folder_ / "b.json")});
    QCOMPARE(replay.code, 0);
    QVERIFY2(replay.err.isEmpty(), replay.told());  // no warning
    QCOMPARE(bytes_of(folder_ / "phi2.nrrd"), bytes_of(folder_ / "phi.nrrd"));
    QCOMPARE(bytes_of(folder_ / "mask2.nrrd"), bytes_of(folder_ / "mask.nrrd"));
    QVERIFY(bytes_of(folder_ / "surface.stl").size() > 1000);
    const QJsonObject a = json_of(bytes_of(folder_ / "a.json"));
    const QJsonObject b = json_of(bytes_of(folder_ / "b.json"));
    QVERIFY(a["steps"].toInt() > 10);
    for (const char* key :
         {"executor", "steps", "voxels_inside", "voxel_updates", "volume_ml", "parameters", "start"}) {
      QVERIFY2(a.contains(key), key);
      QCOMPARE(b[key], a[key]);
    }
  }

  void a_dicom_series_can_be_replayed_and_the_recipe_written_again() {
    const QString series = text(sphere_ / "series");
    QCOMPARE(
        must_run(sphere_.arguments() + QStringList{"--steps", "12", "--out", text(folder_ / "first.json")})
            .code,
        0);
    const Outcome replay = must_run(
        {"replay", text(folder_ / "first.json"), series, "--out", text(folder_ / "second.json"), "--json"});
    QCOMPARE(replay.code, 0);
    QCOMPARE(json_of(replay.out)["steps"].toInt(), 12);
    QVERIFY(bytes_of(folder_ / "first.json").size() > 500);
    QCOMPARE(bytes_of(folder_ / "second.json"), bytes_of(folder_ / "first.json"));
  }

  void another_volume_is_warned_about() {
    const QString recipe = make_recipe({});
    Volume other = ball(Index3(30), 9.0);
    other.geometry.spacing_mm = {1.0, 1.0, 1.5};
    QCOMPARE(failure(imaging::write_volume_file(other, folder_ / "other.nrrd")), QString());
    const Outcome replay =
        run_cli({"replay", recipe, text(folder_ / "other.nrrd"), "--out", text(folder_ / "o.nrrd")});
    QCOMPARE(replay.code, 0);
    QVERIFY2(replay.err.contains("warning: the recipe was made for a spacing of 1 x 1 x 1 mm"),
             replay.told());
    QVERIFY2(replay.err.contains("other voxels"), replay.told());
  }

  void another_executor_gives_nearly_the_same() {
    const QString recipe = make_recipe({});
    const QString volume = text(folder_ / "ball.nrrd");
    for (const char* executor : {"host", "stream"}) {
      QCOMPARE(must_run({"replay", recipe, volume, "--executor", executor, "--out",
                         text(folder_ / (std::string(executor) + ".nrrd"))})
                   .code,
               0);
    }
    const auto host = imaging::load_mask(folder_ / "host.nrrd");
    const auto stream = imaging::load_mask(folder_ / "stream.nrrd");
    QVERIFY(host && stream);
    QVERIFY(host->count() > 500);
    QVERIFY(dice(*host, *stream) > 0.999);
  }

  void what_cannot_be_replayed_ends_with_its_code_data() {
    QTest::addColumn<QString>("recipe");
    QTest::addColumn<QStringList>("more");
    QTest::addColumn<int>("code");
    QTest::addColumn<QString>("says");
    const QString good = make_recipe({"--init", text(folder_ / "small.nii.gz")});
    QJsonObject json = json_of(bytes_of(good.toStdString()));
    const auto spoilt = [&](const char* key, const QJsonValue& value) {
      QJsonObject other = json;
      other[key] = value;
      const auto file = folder_ / (std::string("spoilt-") + key + ".json");
      write_json(file, other);
      return text(file);
    };
    const QString volume = text(folder_ / "ball.nrrd");
    QTest::newRow("no recipe") << text(folder_ / "none.json") << QStringList{volume} << 3
                               << "none.json: cannot be read";
    QTest::newRow("no JSON") << volume << QStringList{volume} << 3 << "not JSON";
    QTest::newRow("no volume") << good << QStringList{text(folder_ / "none.nrrd")} << 3 << "none.nrrd";
    QTest::newRow("version") << spoilt("version", 9) << QStringList{volume} << 3
                             << "version: this version cannot";
    QTest::newRow("steps") << spoilt("steps", -9) << QStringList{volume} << 3 << "spoilt-steps.json: steps: ";
    QTest::newRow("another grid") << good << QStringList{text(sphere_ / "series")} << 3 << "mask has a grid";
    QTest::newRow("onto itself") << good << QStringList{volume, "--out", good} << 2
                                 << "read and written at once";
    const QString map = text(folder_ / "small.nii.gz");
    for (const char* option : {"--speed-image", "--image"}) {
      QTest::newRow(option) << good << QStringList{volume, option, map, "--out", map} << 2
                            << "small.nii.gz: is read and written at once";
    }
    QTest::newRow("unknown executor") << good << QStringList{volume, "--executor", "abacus"} << 2 << "abacus";
  }
  void what_cannot_be_replayed_ends_with_its_code() {
    QFETCH(QString, recipe);
    QFETCH(QStringList, more);
    QFETCH(int, code);
    QFETCH(QString, says);
    const Outcome outcome =
        run_cli(QStringList{"replay", recipe} + more + QStringList{"--out", text(folder_ / "never.nrrd")});
    QCOMPARE(outcome.code, code);
    QVERIFY2(outcome.err.contains(says.toUtf8()), outcome.told());
    QVERIFY(!std::filesystem::exists(folder_ / "never.nrrd"));
  }

  void a_wrong_instruction_set_is_no_fault_of_the_recipe() {
    const QString recipe = make_recipe({});
    RunOptions options;
    options.environment.insert("TIDEMARK_SIMD", "mmx");
    const Outcome outcome = run_cli({"replay", recipe, text(folder_ / "ball.nrrd"), "--executor", "host",
                                     "--out", text(folder_ / "never.nrrd")},
                                    options);
    QVERIFY2(outcome.failed_in_one_line(2), outcome.told());
    QVERIFY2(outcome.err.startsWith("tidemark-cli: error: TIDEMARK_SIMD: "), outcome.told());
  }

 private:
  // A recipe of a short run on the ball.
  QString make_recipe(const QStringList& start) {
    const QString file = text(folder_ / (start.isEmpty() ? "seed.json" : "mask.json"));
    const QStringList begin = start.isEmpty() ? QStringList{"--seed", "15,15,15,4"} : start;
    const QStringList run{"segment",  text(folder_ / "ball.nrrd"),
                          "--target", "1000",
                          "--range",  "450",
                          "--alpha",  "0.75",
                          "--steps",  "20",
                          "--recipe", file};
    if (must_run(run + begin).code != 0) qFatal("no recipe");
    return file;
  }

  TemporaryFolder folder_;
  const SphereStudy sphere_;
};

TIDEMARK_TEST(CliRecipeTest)

}  // namespace tidemark::test::cli_recipe_test

#include "cli_recipe_test.moc"
