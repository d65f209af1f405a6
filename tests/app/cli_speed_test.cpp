// Speed functions, walls and anchors on the command line: what they find, and that a recipe finds it again.
#include <QJsonArray>
#include <QJsonDocument>
#include <cmath>
#include <fstream>

#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/app/cli_runner.h"
#include "tests/app/speed_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_speed_test {

class CliSpeedTest : public QObject {
  Q_OBJECT

 private slots:
  void examples_find_a_texture_that_no_tent_separates();
  void each_function_finds_the_ball_and_is_replayed_data();
  void each_function_finds_the_ball_and_is_replayed();
  void a_dicom_segmentation_is_a_map();
  void a_number_of_a_function_counts();
  void walls_are_never_enclosed_and_anchors_always();
  void a_refined_mask_stays_near_what_it_was();
  void a_word_of_a_function_counts_and_is_kept_as_its_number();
  void a_second_image_counts_and_a_replay_needs_it();
  void a_replay_needs_no_map_that_no_function_uses();
  void a_recipe_of_a_tent_is_of_version_1();
  void pictures_show_the_function();
  void doubt_is_a_picture_of_its_own();
  void another_frame_of_reference_is_warned_of();

 private:
  [[nodiscard]] QString file(const std::string& name) const { return text(files_ / name); }
  [[nodiscard]] QStringList examples() const {
    return {"segment",    file("textures.nii.gz"),
            "--speed",    "examples",
            "--examples", file("labels.nii.gz"),
            "--alpha",    "0.7",
            "--seed",     "21,19,17,4"};
  }
  // Of the ball of 1000 in 0.
  [[nodiscard]] QStringList segment(const QStringList& more) const {
    return QStringList{"segment", file("ball.nrrd"), "--alpha", "0.8"} + more;
  }
  [[nodiscard]] Mask mask(const std::string& name) const {
    auto loaded = imaging::load_mask(files_ / name);
    if (!loaded) qFatal("%s", loaded.error().message.c_str());
    return std::move(*loaded);
  }
  void expect_same_phi_of_replay(const std::string& volume, const QStringList& more);

  SpeedFiles files_;
};

// The run wrote phi.nrrd and recipe.json.
void CliSpeedTest::expect_same_phi_of_replay(const std::string& volume, const QStringList& more) {
  const Outcome replay = must_run(
      QStringList{"replay", file("recipe.json"), file(volume), "--out-phi", file("again.nrrd")} + more);
  QCOMPARE(replay.code, 0);
  QVERIFY2(replay.err.isEmpty(), replay.told());
  QVERIFY(bytes_of(files_ / "phi.nrrd").size() > 100);
  QCOMPARE(bytes_of(files_ / "again.nrrd"), bytes_of(files_ / "phi.nrrd"));
}

void CliSpeedTest::examples_find_a_texture_that_no_tent_separates() {
  const QStringList compared{"--truth", file("truth.nii.gz"), "--json"};
  const Outcome tent =
      must_run(QStringList{"segment", file("textures.nii.gz"), "--target", "100", "--range", "30", "--alpha",
                           "0.7", "--seed", "21,19,17,4", "--out", file("tent.nrrd")} +
               compared);
  QVERIFY2(json_of(tent.out)["dice"].toDouble() < 0.6, tent.told());
  const Outcome found = must_run(examples() + compared +
                                 QStringList{"--out-phi", file("phi.nrrd"), "--recipe", file("recipe.json"),
                                             "--out-speed", file("speed.nrrd")});
  QVERIFY2(json_of(found.out)["dice"].toDouble() >= 0.9, found.told());
  const QJsonObject drive = json_of(found.out)["drive"].toObject();
  QCOMPARE(drive["speed"].toArray()[0].toObject()["function"].toString(), QString("examples"));
  QVERIFY(drive["examples"].toObject()["inside"].toInt() > 50);

  const auto speed = imaging::load_volume(files_ / "speed.nrrd");
  QCOMPARE(failure(speed), QString());
  const auto [low, high] = speed->range();
  QVERIFY2(low >= -1.0F && low < -0.5F && high > 0.5F && high <= 1.0F,
           qPrintable(QString("%1 to %2").arg(low).arg(high)));
  expect_same_phi_of_replay("textures.nii.gz", {});
}

void CliSpeedTest::each_function_finds_the_ball_and_is_replayed_data() {
  QTest::addColumn<QStringList>("speed");
  QTest::addColumn<QStringList>("inputs");  // those that a replay needs too
  QTest::addColumn<QString>("truth");
  const QStringList map{"--speed-image", file("map.nii.gz")};
  const QStringList tent{"--target", "1000", "--range", "500"};
  QTest::newRow("edges") << QStringList{"--speed", "edges", "--speed-value", "edges.sigma=0.5"}
                         << QStringList{} << file("large.nii.gz");
  QTest::newRow("regions") << QStringList{"--speed", "regions"} << QStringList{} << file("large.nii.gz");
  QTest::newRow("image") << QStringList{"--speed", "image"} << map << file("small.nii.gz");
  QTest::newRow("least") << tent + QStringList{"--speed", "tent", "--speed", "image", "--combine", "least"}
                         << map << file("small.nii.gz");
  QTest::newRow("product") << QStringList{"--speed", "regions", "--speed", "image", "--combine", "product"}
                           << map << file("small.nii.gz");
}
void CliSpeedTest::each_function_finds_the_ball_and_is_replayed() {
  QFETCH(QStringList, speed);
  QFETCH(QStringList, inputs);
  QFETCH(QString, truth);
  const Outcome found = must_run(segment(speed) + inputs +
                                 QStringList{"--seed", "15,15,15,4", "--truth", truth, "--json", "--out-phi",
                                             file("phi.nrrd"), "--recipe", file("recipe.json")});
  QVERIFY2(json_of(found.out)["dice"].toDouble() > 0.9, found.told());
  QCOMPARE(json_of(bytes_of(files_ / "recipe.json"))["version"].toInt(), 2);
  expect_same_phi_of_replay("ball.nrrd", inputs);
}

void CliSpeedTest::a_dicom_segmentation_is_a_map() {
  must_run(segment({"--target", "1000", "--range", "500", "--seed", "15,15,15,4", "--out", file("map.dcm")}));
  const QStringList map{"--speed-image", file("map.dcm")};
  const Outcome found =
      must_run(segment({"--speed", "image"}) + map +
               QStringList{"--seed", "15,15,15,4", "--truth", file("large.nii.gz"), "--json", "--out-phi",
                           file("phi.nrrd"), "--recipe", file("recipe.json")});
  QVERIFY2(json_of(found.out)["dice"].toDouble() > 0.9, found.told());
  expect_same_phi_of_replay("ball.nrrd", map);
}

void CliSpeedTest::a_number_of_a_function_counts() {
  const auto phi_of = [&](const QStringList& more) {
    must_run(segment({"--speed", "edges", "--seed", "15,15,15,4", "--steps", "20"}) + more +
             QStringList{"--out-phi", file("phi.nrrd"), "--recipe", file("recipe.json")});
    return bytes_of(files_ / "phi.nrrd");
  };
  const QByteArray usual = phi_of({});
  QVERIFY(phi_of({"--speed-value", "edges.sigma=1.5"}) != usual);
  expect_same_phi_of_replay("ball.nrrd", {});
}

void CliSpeedTest::a_word_of_a_function_counts_and_is_kept_as_its_number() {
  const auto phi_of = [&](const char* form) {
    must_run(segment({"--speed", "image", "--speed-image", file("map.nii.gz"), "--speed-value",
                      QString("image.form=%1").arg(form), "--seed", "15,15,15,4", "--steps", "20",
                      "--out-phi", file("phi.nrrd"), "--recipe", file("recipe.json")}));
    const QJsonObject drive = json_of(bytes_of(files_ / "recipe.json"))["drive"].toObject();
    const QJsonValue kept = drive["speed"].toArray()[0].toObject()["values"].toObject()["form"];
    return std::pair(bytes_of(files_ / "phi.nrrd"), kept.toDouble(-1.0));
  };
  const auto speed = phi_of("speed");
  const auto probability = phi_of("probability");
  QCOMPARE(speed.second, 2.0);
  QCOMPARE(probability.second, 1.0);
  QVERIFY(speed.first != probability.first);
  QVERIFY(phi_of("2") == speed);
}

void CliSpeedTest::walls_are_never_enclosed_and_anchors_always() {
  const QStringList run = segment({"--target", "1000", "--range", "500", "--seed", "12,15,15,4"});
  const auto shared_with = [&](const std::string& found, const Mask& other) {
    const Mask inside = mask(found);
    std::int64_t count = 0;
    for (std::size_t i = 0; i < other.voxels.size(); ++i) count += inside.voxels[i] & other.voxels[i];
    return count;
  };
  const Mask walls = mask("walls.nii.gz");
  const Mask anchors = mask("anchors.nii.gz");
  must_run(run + QStringList{"--out", file("free.nrrd")});
  QVERIFY(shared_with("free.nrrd", walls) > 100);
  QCOMPARE(shared_with("free.nrrd", anchors), std::int64_t{0});
  must_run(run + QStringList{"--walls", file("walls.nii.gz"), "--anchors", file("anchors.nii.gz"), "--out",
                             file("held.nrrd"), "--out-phi", file("phi.nrrd"), "--recipe",
                             file("recipe.json")});
  QCOMPARE(shared_with("held.nrrd", walls), std::int64_t{0});
  QCOMPARE(shared_with("held.nrrd", anchors), anchors.count());
  QVERIFY(mask("held.nrrd").count() > 1000);
  expect_same_phi_of_replay("ball.nrrd", {});
}

void CliSpeedTest::a_refined_mask_stays_near_what_it_was() {
  // From a radius of 4 mm to one of 9 mm, but for what --within allows.
  const QStringList run = segment({"--target", "1000", "--range", "500", "--init", file("core.nii.gz")});
  must_run(run + QStringList{"--out", file("free.nrrd")});
  QVERIFY(mask("free.nrrd").count() > 2000);
  must_run(run + QStringList{"--within", "3", "--out", file("near.nrrd"), "--stats", file("stats.json"),
                             "--out-phi", file("phi.nrrd"), "--recipe", file("recipe.json")});
  const Mask near = mask("near.nrrd");
  const Mask core = mask("core.nii.gz");
  const double farthest = farthest_from(core, near);
  QVERIFY2(farthest > 2.0 && farthest <= 3.0 + 1e-9, qPrintable(QString::number(farthest)));
  const QJsonObject change = json_of(bytes_of(files_ / "stats.json"))["change"].toObject();
  QCOMPARE(change["removed_voxels"].toInt(), 0);
  QCOMPARE(change["added_voxels"].toInt(), static_cast<int>(near.count() - core.count()));
  expect_same_phi_of_replay("ball.nrrd", {});
}

void CliSpeedTest::a_replay_needs_no_map_that_no_function_uses() {
  must_run(segment({"--speed", "edges", "--seed", "15,15,15,4", "--steps", "20", "--out-phi",
                    file("phi.nrrd"), "--recipe", file("recipe.json")}));
  QJsonObject recipe = json_of(bytes_of(files_ / "recipe.json"));
  QJsonObject drive = recipe["drive"].toObject();
  drive["map"] = QJsonObject{{"name", "map.nii.gz"}, {"sha256", ""}};
  recipe["drive"] = drive;
  std::ofstream(files_ / "recipe.json") << QJsonDocument(recipe).toJson().toStdString();
  expect_same_phi_of_replay("ball.nrrd", {});
  expect_same_phi_of_replay("ball.nrrd", {"--speed-image", file("map.nii.gz")});
}

void CliSpeedTest::a_second_image_counts_and_a_replay_needs_it() {
  // Sharper, D would be 1 near the strokes with any image.
  const QStringList results{
      "--steps",        "15",       "--speed-value",    "examples.sharpness=1", "--out-phi",
      file("phi.nrrd"), "--recipe", file("recipe.json")};
  must_run(examples() + results);
  const QByteArray alone = bytes_of(files_ / "phi.nrrd");
  const QStringList images{"--image", file("second.nrrd"), "--image", file("third.nrrd")};
  must_run(examples() + images + results);
  QVERIFY(bytes_of(files_ / "phi.nrrd") != alone);

  const QStringList replay{"replay", file("recipe.json"), file("textures.nii.gz"), "--out-phi",
                           file("never.nrrd")};
  const Outcome without = run_cli(replay);
  QVERIFY2(without.failed_in_one_line(2) && without.err.contains("second.nrrd"), without.told());
  const Outcome half = run_cli(replay + QStringList{"--image", file("second.nrrd")});
  QVERIFY2(half.failed_in_one_line(2) && half.err.contains("third.nrrd"), half.told());
  const Outcome wrong =
      run_cli(replay + QStringList{"--image", file("second.nrrd"), "--image", file("ball.nrrd")});
  QVERIFY2(wrong.failed_in_one_line(3) && wrong.err.contains("third.nrrd"), wrong.told());
  QVERIFY(!std::filesystem::exists(files_ / "never.nrrd"));
  const Outcome more = run_cli(replay + images + QStringList{"--image", file("ball.nrrd")});
  QVERIFY2(more.failed_in_one_line(2) && more.err.contains("ball.nrrd"), more.told());
  expect_same_phi_of_replay("textures.nii.gz", images);
  // They are known by their voxels.
  expect_same_phi_of_replay("textures.nii.gz",
                            {"--image", file("third.nrrd"), "--image", file("second.nrrd")});
}

void CliSpeedTest::a_recipe_of_a_tent_is_of_version_1() {
  for (const QStringList& speed : {QStringList{}, QStringList{"--speed", "tent"}}) {
    must_run(segment({"--target", "1000", "--range", "500", "--seed", "15,15,15,4", "--steps", "3"}) + speed +
             QStringList{"--recipe", file("plain.json")});
    const QJsonObject recipe = json_of(bytes_of(files_ / "plain.json"));
    QCOMPARE(recipe["version"].toInt(), 1);
    QVERIFY(!recipe.contains("drive"));
  }
}

void CliSpeedTest::pictures_show_the_function() {
  const auto picture = [&](const QStringList& more) {
    const Outcome drawn =
        must_run(QStringList{"render", file("ball.nrrd"), "--mask", file("small.nii.gz"), "--view", "speed",
                             "--size", "120x120", "--out", file("picture.png")} +
                 more);
    // An even picture is warned about.
    return drawn.err.isEmpty() ? bytes_of(files_ / "picture.png") : QByteArray();
  };
  QList<QByteArray> pictures{picture({"--target", "800", "--range", "500"})};
  for (const QStringList& more :
       {QStringList{"--speed", "edges"}, QStringList{"--speed", "edges", "--speed-value", "edges.sigma=3"},
        QStringList{"--speed", "regions"},
        QStringList{"--speed", "image", "--speed-image", file("map.nii.gz")},
        QStringList{"--speed", "edges", "--walls", file("walls.nii.gz")}}) {
    pictures.push_back(picture(more));
  }
  for (qsizetype i = 0; i < pictures.size(); ++i) {
    QVERIFY2(!pictures[i].isEmpty(), qPrintable(QString::number(i)));
    QVERIFY2(pictures.indexOf(pictures[i]) == i, qPrintable(QString::number(i)));
  }
}

void CliSpeedTest::doubt_is_a_picture_of_its_own() {
  const auto picture = [&](const QStringList& more) {
    must_run(QStringList{"render", file("textures.nii.gz"), "--size", "120x120", "--speed", "examples",
                         "--examples", file("labels.nii.gz"), "--out", file("picture.png")} +
             more);
    return bytes_of(files_ / "picture.png");
  };
  const QByteArray doubt = picture({"--view", "doubt"});
  QVERIFY(doubt != picture({"--view", "speed"}));
  // What is made of the probability for the surface hides none of it.
  const QStringList other{"--speed-value", "examples.sharpness=6"};
  QCOMPARE(picture(QStringList{"--view", "doubt"} + other), doubt);
  QVERIFY(picture(QStringList{"--view", "doubt", "--speed-value", "examples.trees=11"}) != doubt);
}

// Two series of one grid, each with a frame of reference of its own.
void CliSpeedTest::another_frame_of_reference_is_warned_of() {
  const Volume study = ball(Index3(30), 9.0);
  for (const char* name : {"ct", "other"})
    QCOMPARE(failure(imaging::write_dicom_series(study, {}, files_ / name)), QString());
  Volume labels = study;
  std::vector<std::int16_t> marks(static_cast<std::size_t>(study.geometry.voxel_count()));
  for (std::int64_t i = 0; i < 5; ++i) {
    marks[static_cast<std::size_t>(study.geometry.offset({12 + i, 15, 15}))] = 1;
    marks[static_cast<std::size_t>(study.geometry.offset({2 + i, 2, 15}))] = 2;
  }
  labels.voxels = marks;
  QCOMPARE(failure(imaging::write_volume_file(labels, files_ / "marks.nii.gz")), QString());
  const QString ct = file("ct");
  const QString other = file("other");
  const QString map = file("of_ct.dcm");
  const QStringList seed{"--seed", "15,15,15,4"};
  const QStringList tent{"--target", "1000", "--range", "500"};
  must_run(QStringList{"segment", ct, "--steps", "5", "--alpha", "0.5", "--out", map} + seed + tent);
  const auto warns = [](const QStringList& arguments, const QString& of) {
    const QString warning = of + ": it names another frame of reference than the study";
    return must_run(arguments).err.contains(warning.toUtf8());
  };
  const std::vector<QStringList> uses{tent + QStringList{"--init", map},
                                      tent + seed + QStringList{"--anchors", map},
                                      tent + QStringList{"--seed", "3,3,3,2", "--walls", map},
                                      seed + QStringList{"--speed", "image", "--speed-image", map}};
  for (const QStringList& use : uses) {
    QVERIFY2(!warns(QStringList{"segment", ct, "--alpha", "0.5", "--steps", "0"} + use, map),
             qPrintable(use.join(' ')));
    QVERIFY2(warns(QStringList{"segment", other, "--alpha", "0.5", "--steps", "0"} + use, map),
             qPrintable(use.join(' ')));
  }
  const QStringList examples{"--alpha",    "0.5",
                             "--steps",    "0",
                             "--speed",    "examples",
                             "--examples", file("marks.nii.gz"),
                             "--recipe",   file("recipe.json")};
  QVERIFY(!warns(QStringList{"segment", ct, "--image", ct} + seed + examples, ct));
  QVERIFY(warns(QStringList{"segment", ct, "--image", other} + seed + examples, other));
  QVERIFY(warns({"replay", file("recipe.json"), ct, "--image", other}, other));
  QVERIFY(warns({"render", other, "--mask", map, "--size", "64x64", "--out", file("mask.png")}, map));
}

TIDEMARK_TEST(CliSpeedTest)

}  // namespace tidemark::test::cli_speed_test

#include "cli_speed_test.moc"
