// Where a segmentation begins, and that going on from there leads where it would have led.
#include <QJsonArray>

#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_start_test {

class CliStartTest : public QObject {
  Q_OBJECT

 private slots:
  void a_resumed_run_equals_an_unbroken_one();
  void the_start_is_a_mask_or_a_threshold_or_a_fill();
  void a_mask_with_other_axes_is_matched_by_its_geometry();
  void an_automatic_start_says_what_it_chose();
  void levels_come_to_rest_one_after_the_other();

 private:
  TemporaryFolder folder_;
  const SphereStudy sphere_;
};

void CliStartTest::a_resumed_run_equals_an_unbroken_one() {
  const auto out = [&](const char* name) { return QStringList{"--out", text(folder_ / name)}; };
  const QStringList whole = sphere_.arguments() + QStringList{"--steps", "40"} + out("whole.nrrd");
  const QStringList first =
      sphere_.arguments() + QStringList{"--steps", "20", "--out-phi", text(folder_ / "half.nrrd")};
  QStringList second = sphere_.arguments() + QStringList{"--steps", "20"} + out("resumed.nrrd") +
                       QStringList{"--out-phi", text(folder_ / "end.nrrd")};
  const qsizetype seed = second.indexOf("--seed");
  second[seed] = "--init-phi";
  second[seed + 1] = text(folder_ / "half.nrrd");
  QCOMPARE(must_run(whole + QStringList{"--out-phi", text(folder_ / "whole_phi.nrrd")}).code, 0);
  QCOMPARE(must_run(first).code, 0);
  QCOMPARE(must_run(second).code, 0);
  QCOMPARE(bytes_of(folder_ / "resumed.nrrd"), bytes_of(folder_ / "whole.nrrd"));
  QCOMPARE(bytes_of(folder_ / "end.nrrd"), bytes_of(folder_ / "whole_phi.nrrd"));
}

void CliStartTest::levels_come_to_rest_one_after_the_other() {
  const QStringList base = sphere_.arguments() + QStringList{"--json"};
  const auto recipe = text(folder_ / "levels.json");
  const auto first = text(folder_ / "levels.nrrd");
  const Outcome outcome = must_run(base + QStringList{"--levels", "3", "--out", first, "--recipe", recipe,
                                                      "--truth", text(sphere_ / "truth.nii.gz")});
  const QJsonObject figures = json_of(outcome.out);
  QVERIFY2(figures["dice"].toDouble() > 0.95, outcome.told());
  const QJsonArray coarse = figures["coarse_levels"].toArray();
  QCOMPARE(coarse.size(), 2);
  for (const QJsonValue level : coarse) {
    QVERIFY(level["converged"].toBool());
    QVERIFY(level["steps"].toInt() > 0);
  }
  QVERIFY(coarse[0]["size"][0].toInt() < coarse[1]["size"][0].toInt());
  // Its recipe replays to the same voxels.
  const auto second = text(folder_ / "replayed.nrrd");
  QCOMPARE(must_run({"replay", recipe, text(sphere_ / "series"), "--out", second}).code, 0);
  QCOMPARE(bytes_of(folder_ / "replayed.nrrd"), bytes_of(folder_ / "levels.nrrd"));
  // A volume of so few voxels has one level by itself.
  QCOMPARE(json_of(must_run(base + QStringList{"--levels", "auto"}).out)["coarse_levels"].toArray().size(),
           0);

  const auto refused = [&](const QString& levels) {
    const Outcome wrong = run_cli(base + QStringList{"--levels", levels});
    return wrong.code == 2 && wrong.err.contains("--levels");
  };
  for (const char* levels : {"0", "4", "many", "2.5", "-1", ""}) QVERIFY2(refused(levels), levels);
}

void CliStartTest::the_start_is_a_mask_or_a_threshold_or_a_fill() {
  QStringList base = sphere_.arguments();
  const qsizetype seed = base.indexOf("--seed");
  base.remove(seed, 2);
  const QString truth = text(sphere_ / "truth.nii.gz");
  for (const QStringList& start :
       {QStringList{"--init", truth}, QStringList{"--init-threshold", "600,1000"},
        QStringList{"--init-flood", "40,40,40,600,1000"}, QStringList{"--init-speed"}}) {
    const Outcome outcome = must_run(base + start + QStringList{"--steps", "0", "--truth", truth, "--json"});
    QVERIFY2(json_of(outcome.out)["dice"].toDouble() > 0.95, outcome.told());
    QCOMPARE(json_of(outcome.out)["steps"].toInt(-1), 0);
  }
  const Outcome two = run_cli(base + QStringList{"--init", truth, "--init-speed"});
  QCOMPARE(two.code, 2);
  QVERIFY2(two.err.contains("only one of"), two.told());
  // Its speed is known once there is a surface.
  const Outcome following =
      run_cli({"segment", text(sphere_ / "series"), "--alpha", "0.5", "--init-speed", "--speed", "regions"});
  QCOMPARE(following.code, 2);
  QVERIFY2(following.err.contains("follows the surface"), following.told());
  // The exact distance transform keeps the mask unchanged.
  const Outcome kept =
      must_run(base + QStringList{"--init", truth, "--steps", "0", "--truth", truth, "--json"});
  QCOMPARE(json_of(kept.out)["dice"].toDouble(), 1.0);
  const Outcome erased =
      must_run(base + QStringList{"--init", truth, "--erase", "40,40,40,10", "--steps", "0", "--json"});
  QVERIFY(json_of(erased.out)["voxels_inside"].toInt() < json_of(kept.out)["voxels_inside"].toInt() - 3000);
}

void CliStartTest::a_mask_with_other_axes_is_matched_by_its_geometry() {
  // A box, so that every flip and permutation shows; stored with j reversed and i and k exchanged.
  Volume volume = ball(Index3(12, 14, 16), 0.0);
  Mask mask{volume.geometry, std::vector<std::uint8_t>(volume.geometry.voxel_count(), 0)};
  Mask stored{volume.geometry, mask.voxels};
  stored.geometry.size = {16, 14, 12};
  stored.geometry.direction = glm::dmat3(glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0));
  stored.geometry.origin_mm = {0.0, 13.0, 0.0};
  auto& values = std::get<std::vector<std::int16_t>>(volume.voxels);
  for (std::int64_t k = 2; k < 12; ++k) {
    for (std::int64_t j = 3; j < 9; ++j) {
      for (std::int64_t i = 1; i < 8; ++i) {
        values[static_cast<std::size_t>(volume.geometry.offset({i, j, k}))] = 1000;
        stored.voxels[static_cast<std::size_t>(stored.geometry.offset({k, 13 - j, i}))] = 1;
      }
    }
  }
  QCOMPARE(failure(imaging::write_volume_file(volume, folder_ / "box.nrrd")), QString());
  QCOMPARE(failure(imaging::write_mask_file(stored, folder_ / "stored.nrrd")), QString());
  const Outcome outcome = must_run({"segment", text(folder_ / "box.nrrd"), "--target", "1000", "--range",
                                    "500", "--alpha", "1", "--init-threshold", "1000,1000", "--steps", "0",
                                    "--truth", text(folder_ / "stored.nrrd"), "--json"});
  QCOMPARE(json_of(outcome.out)["dice"].toDouble(), 1.0);
}

void CliStartTest::an_automatic_start_says_what_it_chose() {
  const Outcome outcome = must_run({"segment", text(sphere_ / "series"), "--auto-start", "--truth",
                                    text(sphere_ / "truth.nii.gz"), "--stats", text(folder_ / "auto.json")});
  for (const char* option : {"--seed", "--target", "--range", "--alpha"}) {
    QVERIFY2(outcome.out.contains(QByteArray("Chose      ") + option), outcome.told());
  }
  QVERIFY2(json_of(bytes_of(folder_ / "auto.json"))["dice"].toDouble() > 0.9, outcome.told());
  const Outcome given =
      must_run({"segment", text(sphere_ / "series"), "--auto-start", "--target", "790", "--steps", "1"});
  QVERIFY2(!given.out.contains("--target") && given.out.contains("Chose      --range"), given.told());
  // The seed is sought where the target is.
  const Outcome nowhere =
      run_cli({"segment", text(sphere_ / "series"), "--auto-start", "--target", "90000", "--steps", "1"});
  QVERIFY2(nowhere.failed_in_one_line(3) && nowhere.err.contains("90000"), nowhere.told());
  // T and epsilon are of no use to other functions.
  const Outcome other =
      must_run({"segment", text(sphere_ / "series"), "--auto-start", "--speed", "edges", "--steps", "1"});
  QVERIFY2(!other.out.contains("--target") && !other.out.contains("--range"), other.told());
  QVERIFY2(other.out.contains("Chose      --alpha"), other.told());
}

TIDEMARK_TEST(CliStartTest)

}  // namespace tidemark::test::cli_start_test

#include "cli_start_test.moc"
