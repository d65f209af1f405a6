// Inputs of speed functions that are wrong: one clear line, the right code, and nothing written.
#include <limits>

#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/app/speed_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_speed_failure_test {

class CliSpeedFailureTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void what_is_wrong_is_one_line_data();
  void what_is_wrong_is_one_line();

 private:
  [[nodiscard]] QString file(const std::string& name) const { return text(files_ / name); }
  void write(const Volume& volume, const std::string& name) const {
    QCOMPARE(failure(imaging::write_volume_file(volume, files_ / name)), QString());
  }

  SpeedFiles files_;
};

void CliSpeedFailureTest::initTestCase() {
  std::filesystem::create_directory(files_ / "out");
  const Index3 grid(30);
  Volume far = ball(grid, 9.0);
  far.geometry.origin_mm = {500.0, 0.0, 0.0};
  write(far, "far.nrrd");
  const auto corner = [](double label) {
    return [label](glm::dvec3 p) { return p.x < 3.0 ? label : p.x > 26.0 ? 1.0 : 0.0; };
  };
  write(volume_of(grid, 1.0, corner(1.0)), "only-inside.nii.gz");
  write(volume_of(grid, 1.0, corner(2.0)), "good.nii.gz");
  write(volume_of(grid, 1.0, corner(3.0)), "three.nii.gz");
  write(volume_of(grid, 1.0, corner(std::numeric_limits<double>::quiet_NaN())), "nan.nii.gz");
  write(volume_of(grid, 1.0, corner(-7.0)), "beyond.nii.gz");
}

void CliSpeedFailureTest::what_is_wrong_is_one_line_data() {
  QTest::addColumn<QStringList>("more");
  QTest::addColumn<int>("code");
  QTest::addColumn<QString>("says");
  const auto row = [](const char* name, const QStringList& more, int code, const char* says) {
    QTest::newRow(name) << more << code << says;
  };
  const QStringList examples{"--speed", "examples", "--examples"};
  const QStringList image{"--speed", "image", "--speed-image"};
  row("an image elsewhere", examples + QStringList{file("good.nii.gz"), "--image", file("far.nrrd")}, 3,
      "far.nrrd");
  row("an image of no use", QStringList{"--speed", "edges", "--image", file("far.nrrd")}, 2, "--image");
  row("an image beside a tent", {"--image", file("far.nrrd"), "--target", "900", "--range", "300"}, 2,
      "--speed examples");
  row("examples of one kind", examples + QStringList{file("only-inside.nii.gz")}, 3, "2 (outside)");
  row("examples on another grid", examples + QStringList{file("labels.nii.gz")}, 3, "labels.nii.gz");
  row("a label 3", examples + QStringList{file("three.nii.gz")}, 3,
      "3 is neither 1 (inside) nor 2 (outside)");
  row("a map with NaN", image + QStringList{file("nan.nii.gz")}, 3, "nan.nii.gz");
  row("a map beyond 1", image + QStringList{file("beyond.nii.gz")}, 3, "voxel (0, 0, 0) is -7");
  row("a map on another grid", image + QStringList{file("textures.nii.gz")}, 3, "textures.nii.gz");
  row("T without a tent", {"--speed", "edges", "--target", "900"}, 2, "--target needs --speed tent");
  row("epsilon without a tent", {"--speed", "edges", "--speed", "regions", "--range", "300"}, 2,
      "--range needs --speed tent");
  row("an unknown function", {"--speed", "magic"}, 2, "magic");
  row("an unknown number", {"--speed", "edges", "--speed-value", "edges.magic=1"}, 2, "magic");
  row("a number of no function", {"--speed", "edges", "--speed-value", "regions.radius=1"}, 2, "regions");
  row("a number beyond its range", {"--speed", "edges", "--speed-value", "edges.sigma=-1"}, 2, "sigma");
  row("no number", {"--speed", "edges", "--speed-value", "edges.sigma=much"}, 2, "much");
  row("no assignment", {"--speed", "edges", "--speed-value", "sigma"}, 2, "FUNCTION.NAME=NUMBER");
  row("unknown combination", {"--speed", "edges", "--combine", "sum"}, 2, "sum");
  row("nothing to join", {"--speed", "edges", "--combine", "product"}, 2, "--combine");
  row("a map of no use", {"--speed", "edges", "--speed-image", file("map.nii.gz")}, 2, "--speed-image");
  row("an unknown word", image + QStringList{file("map.nii.gz"), "--speed-value", "image.form=guess"}, 2,
      "'guess' is not one of by-values, probability, speed; default by-values");
  row("between two words", image + QStringList{file("map.nii.gz"), "--speed-value", "image.form=0.5"}, 2,
      "whole number");
  row("near no mask", {"--speed", "edges", "--within", "3"}, 2, "--init");
  row("examples without a file", {"--speed", "examples"}, 2, "--examples");
  row("a file without examples", {"--speed", "edges", "--examples", file("labels.nii.gz")}, 2, "--examples");
  row("a map without a file", {"--speed", "image"}, 2, "--speed-image");
  row("a missing image", examples + QStringList{file("good.nii.gz"), "--image", file("none.nrrd")}, 3,
      "none.nrrd");
  row("missing examples", examples + QStringList{file("none.nii.gz")}, 3, "none.nii.gz");
  row("a missing map", image + QStringList{file("none.nii.gz")}, 3, "none.nii.gz");
  row("missing walls", QStringList{"--speed", "edges", "--walls", file("none.nrrd")}, 3, "none.nrrd");
  row("walls elsewhere", QStringList{"--speed", "edges", "--walls", file("truth.nii.gz")}, 3, "truth.nii.gz");
  row("missing anchors", QStringList{"--speed", "edges", "--anchors", file("none.nrrd")}, 3, "none.nrrd");
}
void CliSpeedFailureTest::what_is_wrong_is_one_line() {
  QFETCH(QStringList, more);
  QFETCH(int, code);
  QFETCH(QString, says);
  const Outcome outcome = run_cli(QStringList{"segment", file("ball.nrrd"), "--alpha", "0.7", "--seed",
                                              "15,15,15,4", "--out", text(files_ / "out" / "mask.nrrd"),
                                              "--stats", text(files_ / "out" / "stats.json")} +
                                  more);
  QVERIFY2(outcome.failed_in_one_line(code), outcome.told());
  QVERIFY2(outcome.err.contains(says.toUtf8()), outcome.told());
  QCOMPARE(names_in(files_ / "out"), QStringList());
}

TIDEMARK_TEST(CliSpeedFailureTest)

}  // namespace tidemark::test::cli_speed_failure_test

#include "cli_speed_failure_test.moc"
