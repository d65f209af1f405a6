// The words of the command line: help, version, wrong usage.
#include <QRegularExpression>

#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_usage_test {

class CliUsageTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void help_names_units_and_an_example_data();
  void help_names_units_and_an_example();
  void help_says_how_a_series_is_named_data();
  void help_says_how_a_series_is_named();
  void commands_of_one_name_have_help_of_their_own();
  void help_hides_what_is_not_built();
  void the_version_is_told();
  void wrong_usage_ends_with_2_and_one_line_data();
  void wrong_usage_ends_with_2_and_one_line();
  void an_unknown_option_is_named();
  void an_empty_value_is_named_data();
  void an_empty_value_is_named();
  void a_text_with_a_default_can_be_emptied();
  void a_seed_outside_the_volume_is_named();
  void an_eraser_that_takes_all_leaves_an_empty_start();
  void negative_coordinates_are_numbers_not_options();
  void an_output_may_not_be_the_input();
  void the_program_links_no_qt();

 private:
  TemporaryFolder folder_;
  QString volume_;
};

void CliUsageTest::initTestCase() {
  volume_ = text(folder_ / "ball.nrrd");
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(24), 8.0), folder_ / "ball.nrrd")), QString());
}

void CliUsageTest::help_names_units_and_an_example_data() {
  QTest::addColumn<QString>("command");
  for (const char* command :
       {"info", "segment", "sweep", "replay", "distance", "convert", "render", "phantom", "bench"}) {
    QTest::newRow(command) << command;
  }
}

void CliUsageTest::help_names_units_and_an_example() {
  QFETCH(QString, command);
  const Outcome help = run_cli({command, "--help"});
  QCOMPARE(help.code, 0);
  QVERIFY2(help.err.isEmpty(), help.told());
  QVERIFY2(help.out.contains("mm") || help.out.contains("voxel"), help.told());
  QVERIFY2(help.out.contains("Examples:\n  tidemark-cli " + command.toUtf8()), help.told());
  QVERIFY2(help.out.contains("--json"), help.told());
  QVERIFY2(run_cli({"--help"}).out.contains("  " + command.toUtf8() + " "), "missing from the list");
}

void CliUsageTest::help_says_how_a_series_is_named_data() {
  QTest::addColumn<QString>("command");
  for (const char* command : {"segment", "sweep", "replay", "convert", "render"})
    QTest::newRow(command) << command;
}

void CliUsageTest::help_says_how_a_series_is_named() {
  QFETCH(QString, command);
  const Outcome help = run_cli({command, "--help"});
  QVERIFY2(help.out.contains("--series UID[#N]"), help.told());
  QVERIFY2(help.out.contains("UID#N is the N-th"), help.told());
  QVERIFY2(help.out.contains("DICOMDIR") && help.out.contains("zip archive"), help.told());
}

void CliUsageTest::commands_of_one_name_have_help_of_their_own() {
  const QByteArray surface = "Segments INPUT: a surface starts at seeds";
  const QByteArray model = "Sends INPUT to a server";
  const Outcome plain = run_cli({"segment", "--help"});
  QVERIFY2(plain.out.contains(surface) && !plain.out.contains(model), plain.told());
  const Outcome ai = run_cli({"ai", "segment", "--help"});
  QVERIFY2(ai.out.contains(model) && !ai.out.contains(surface), ai.told());
}

void CliUsageTest::help_hides_what_is_not_built() {
  const QByteArray all = run_cli({"--help"}).out + run_cli({"segment", "--help"}).out;
  for (const char* word : {"reference"}) {
    const QRegularExpression whole(QString("(^|[\\s|])%1($|[\\s|,])").arg(QRegularExpression::escape(word)));
    QVERIFY2(!whole.match(QString::fromUtf8(all)).hasMatch(), word);
  }
}

void CliUsageTest::the_version_is_told() {
  const Outcome version = run_cli({"--version"});
  QCOMPARE(version.code, 0);
  QVERIFY2(QRegularExpression("^tidemark-cli \\d+\\.\\d+\\.\\d+\n$").match(version.out).hasMatch(),
           version.told());
}

void CliUsageTest::wrong_usage_ends_with_2_and_one_line_data() {
  QTest::addColumn<QStringList>("arguments");
  const QStringList segment{"segment", volume_, "--target", "1000", "--range", "500", "--alpha", "0.8"};
  const QStringList seeded = segment + QStringList{"--seed", "12,12,12,4"};
  QTest::newRow("nothing") << QStringList{};
  QTest::newRow("unknown command") << QStringList{"frobnicate"};
  QTest::newRow("unknown option") << seeded + QStringList{"--frobnicate"};
  QTest::newRow("no input") << QStringList{"segment"};
  QTest::newRow("second input") << seeded + QStringList{"other.nrrd"};
  QTest::newRow("no start") << segment;
  QTest::newRow("no target") << QStringList{"segment", volume_, "--range", "1",
                                            "--alpha", "1",     "--seed",  "1,1,1,1"};
  QTest::newRow("target is text") << QStringList{"segment", volume_, "--target", "ten"};
  QTest::newRow("target is nan") << QStringList{"segment", volume_, "--target", "nan"};
  QTest::newRow("target is infinite") << QStringList{"segment", volume_, "--target", "inf"};
  QTest::newRow("decimal comma") << QStringList{"segment", volume_, "--target", "1,5"};
  QTest::newRow("band below 2") << seeded + QStringList{"--band", "1"};
  QTest::newRow("alpha above 1") << QStringList{"segment", volume_,   "--target", "1",      "--range",
                                                "1",       "--alpha", "1.5",      "--seed", "1,1,1,1"};
  QTest::newRow("range 0") << QStringList{"segment", volume_,   "--target", "1",      "--range",
                                          "0",       "--alpha", "1",        "--seed", "1,1,1,1"};
  QTest::newRow("three numbers in a seed") << segment + QStringList{"--seed", "1,2,3"};
  QTest::newRow("five numbers in a seed") << segment + QStringList{"--seed", "1,2,3,4,5"};
  QTest::newRow("radius 0") << segment + QStringList{"--seed", "1,2,3,0"};
  QTest::newRow("empty number in a seed") << segment + QStringList{"--seed", "1,,3,4"};
  QTest::newRow("steps and converge") << seeded + QStringList{"--steps", "5", "--converge"};
  QTest::newRow("negative steps") << seeded + QStringList{"--steps", "-5"};
  QTest::newRow("half a step") << seeded + QStringList{"--steps", "1.5"};
  QTest::newRow("two inits") << segment + QStringList{"--init", volume_, "--init-threshold", "1,2"};
  QTest::newRow("limits reversed") << segment + QStringList{"--init-threshold", "2,1"};
  QTest::newRow("smoothing 0") << seeded + QStringList{"--smooth", "0"};
  QTest::newRow("smoothing that no recipe can hold") << seeded + QStringList{"--smooth", "1001"};
  QTest::newRow("unknown suffix") << seeded + QStringList{"--out", text(folder_ / "mask.xyz")};
  QTest::newRow("mesh as phi") << seeded + QStringList{"--out-phi", text(folder_ / "phi.stl")};
  QTest::newRow("stats not json") << seeded + QStringList{"--stats", text(folder_ / "stats.txt")};
  QTest::newRow("recipe not json") << seeded + QStringList{"--recipe", text(folder_ / "recipe.txt")};
  QTest::newRow("replay without a volume") << QStringList{"replay", "recipe.json"};
  QTest::newRow("replay with a start") << QStringList{"replay", "r.json", volume_, "--seed", "1,1,1,1"};
  QTest::newRow("one file twice") << seeded + QStringList{"--out", text(folder_ / "m.nrrd"), "--out-phi",
                                                          text(folder_ / "m.nrrd")};
  QTest::newRow("unknown executor") << seeded + QStringList{"--executor", "abacus"};
  QTest::newRow("unknown renderer") << seeded + QStringList{"--picture", text(folder_ / "p.png"),
                                                            "--renderer", "pencil"};
  QTest::newRow("no threads") << seeded + QStringList{"--threads", "0"};
  QTest::newRow("unknown scheme") << seeded + QStringList{"--scheme", "third"};
  QTest::newRow("empty threshold") << segment + QStringList{"--init-threshold", "5000,6000"};
  QTest::newRow("flood seed outside") << segment + QStringList{"--init-flood", "99,1,1,0,2000"};
  QTest::newRow("flood seed not in limits") << segment + QStringList{"--init-flood", "1,1,1,900,2000"};
  QTest::newRow("unknown phantom") << QStringList{"phantom", "teapot", "--out", text(folder_ / "p")};
  QTest::newRow("phantom to nowhere") << QStringList{"phantom", "sphere"};
  QTest::newRow("noise below 0") << QStringList{"phantom",           "sphere",  "--out",
                                                text(folder_ / "p"), "--noise", "-1"};
  const auto render = [&](const QStringList& more) {
    return QStringList{"render", volume_, "--out", "a.png"} + more;
  };
  QTest::newRow("render nothing") << render({});
  QTest::newRow("render a view of no name") << render({"--preset", "ct-bone", "--view", "front"});
  QTest::newRow("render by a renderer of no name") << render({"--preset", "ct-bone", "--renderer", "pencil"});
  QTest::newRow("render a preset of no name") << render({"--preset", "ct-none"});
  QTest::newRow("render a picture too large") << render({"--preset", "ct-bone", "--size", "9000x9"});
  QTest::newRow("render from nowhere") << render({"--preset", "ct-bone", "--camera", "1"});
  QTest::newRow("render a plane without normal") << render({"--preset", "ct-bone", "--clip", "0,0,0,1"});
  QTest::newRow("render a speed map without T") << render({"--view", "speed"});
  QTest::newRow("render the doubt of no examples") << render({"--view", "doubt", "--speed", "edges"});
  QTest::newRow("render the total speed without T") << render({"--mask", volume_, "--colour", "total"});
  QTest::newRow("render an oblique slice without normal") << render({"--view", "oblique"});
  QTest::newRow("render with a colour of no name") << render({"--mask", volume_, "--colour", "red"});
  QTest::newRow("render a surface more than opaque") << render({"--mask", volume_, "--opacity", "1.5"});
  QTest::newRow("render a surface of no number") << render({"--mask", volume_, "--occlusion", "nan"});
  QTest::newRow("render an inside without surface") << render({"--preset", "ct-bone", "--roi", "inside"});
  QTest::newRow("render a region preset without surface") << render({"--preset", "roi-tissue"});
  QTest::newRow("render a window without width") << render({"--view", "axial", "--window", "40,0"});
  QTest::newRow("render T without epsilon") << render({"--view", "sheet", "--target", "500"});
  QTest::newRow("render a slice in a mode of no name") << render({"--view", "axial", "--mode", "x"});
  QTest::newRow("render from too near") << render({"--preset", "ct-bone", "--camera", "0,0,1e300"});
  QTest::newRow("render a speed that nothing shows")
      << render({"--mask", volume_, "--view", "axial", "--speed", "edges"});
  QTest::newRow("render T without a tent")
      << render({"--view", "sheet", "--speed", "edges", "--target", "500", "--range", "100"});
  QTest::newRow("render walls in 3D") << render({"--mask", volume_, "--walls", volume_});
  QTest::newRow("render into no picture")
      << QStringList{"render", volume_, "--preset", "ct-bone", "--out", "a.jpg"};
  QTest::newRow("convert to nothing") << QStringList{"convert", volume_};
  QTest::newRow("surface of no mask") << QStringList{"convert", volume_, "--out", text(folder_ / "s.stl")};
  QTest::newRow("unknown case") << QStringList{"bench", "--case", "teapot"};
  QTest::newRow("band too narrow") << QStringList{"distance", volume_, "--band",
                                                  "1",        "--out", text(folder_ / "d.nrrd")};
}

void CliUsageTest::wrong_usage_ends_with_2_and_one_line() {
  QFETCH(QStringList, arguments);
  const Outcome outcome = run_cli(arguments);
  QVERIFY2(outcome.failed_in_one_line(2), outcome.told());
  QCOMPARE(names_in(folder_.path()), QStringList{"ball.nrrd"});
}

void CliUsageTest::an_unknown_option_is_named() {
  const Outcome outcome = run_cli({"segment", volume_, "--targt", "800"});
  QCOMPARE(outcome.err,
           QByteArray("tidemark-cli: error: unknown option --targt (see tidemark-cli segment --help)\n"));
}

void CliUsageTest::an_empty_value_is_named_data() {
  QTest::addColumn<QStringList>("arguments");
  const QStringList segment = QStringList{"segment", volume_, "--steps", "0"} + ball_arguments(Index3(24));
  for (const char* option : {"--walls", "--truth", "--stats", "--out-phi", "--rtstruct", "--series"}) {
    QTest::newRow(option) << segment + QStringList{option, ""};
  }
  QTest::newRow("--source") << QStringList{"convert",  volume_, "--out", text(folder_ / "c.nrrd"),
                                           "--source", ""};
  QTest::newRow("--key") << QStringList{"deidentify", volume_, "--out", text(folder_ / "anonymous"),
                                        "--key",      ""};
  QTest::newRow("INPUT") << QStringList{"segment", ""};
}

// A script makes one of a variable that is not set.
void CliUsageTest::an_empty_value_is_named() {
  QFETCH(QStringList, arguments);
  const QByteArray option = QTest::currentDataTag();
  const Outcome outcome = run_cli(arguments);
  QVERIFY2(outcome.failed_in_one_line(2), outcome.told());
  QVERIFY2(outcome.err.startsWith("tidemark-cli: error: " + option + ": the value is empty"), outcome.told());
  QCOMPARE(names_in(folder_.path()), QStringList{"ball.nrrd"});
}

void CliUsageTest::a_text_with_a_default_can_be_emptied() {
  const Outcome outcome = run_cli({"measure", volume_, volume_, "--note", ""});
  QVERIFY2(outcome.code != 2 && !outcome.err.contains("--note"), outcome.told());
}

void CliUsageTest::a_seed_outside_the_volume_is_named() {
  const QStringList segment{"segment", volume_, "--target", "1000", "--range", "500", "--alpha", "0.8"};
  for (const QStringList& seed : {QStringList{"--seed", "24,12,12,4"}, QStringList{"--seed-mm", "1,1,-30,5"},
                                  QStringList{"--seed", "12,12,12,4", "--erase", "12,-3,12,4"}}) {
    const Outcome outcome = run_cli(segment + seed + QStringList{"--out", text(folder_ / "mask.nrrd")});
    QVERIFY2(outcome.failed_in_one_line(2), outcome.told());
    QVERIFY2(outcome.err.contains(seed.at(seed.size() - 2).toUtf8() + " " + seed.last().toUtf8()),
             outcome.told());
    QVERIFY2(outcome.err.contains("24 x 24 x 24"), outcome.told());
    QCOMPARE(names_in(folder_.path()), QStringList{"ball.nrrd"});
  }
}

void CliUsageTest::an_eraser_that_takes_all_leaves_an_empty_start() {
  const Outcome outcome =
      run_cli(QStringList{"segment", volume_, "--erase", "12,12,12,9"} + ball_arguments(Index3(24)));
  QVERIFY2(outcome.failed_in_one_line(2), outcome.told());
  QVERIFY2(outcome.err.contains("empty"), outcome.told());
}

void CliUsageTest::negative_coordinates_are_numbers_not_options() {
  Volume shifted = ball(Index3(24), 8.0);
  shifted.geometry.origin_mm = {-30.0, -30.0, -30.0};
  const auto file = folder_ / "shifted.nrrd";
  QCOMPARE(failure(imaging::write_volume_file(shifted, file)), QString());
  const QStringList segment{"segment", text(file), "--target", "1000", "--range", "500",
                            "--alpha", "0.8",      "--steps",  "1",    "--json"};
  const Outcome apart = run_cli(segment + QStringList{"--seed-mm", "-18,-18,-18,4"});
  const Outcome joined = run_cli(segment + QStringList{"--seed-mm=-18,-18,-18,4"});
  std::filesystem::remove(file);
  QVERIFY2(apart.code == 0, apart.told());
  QVERIFY2(joined.code == 0, joined.told());
  QVERIFY(json_of(apart.out)["voxels_inside"].toInt() > 200);
  QCOMPARE(json_of(joined.out)["voxels_inside"], json_of(apart.out)["voxels_inside"]);
}

void CliUsageTest::an_output_may_not_be_the_input() {
  const QByteArray before = bytes_of(folder_ / "ball.nrrd");
  const Outcome outcome =
      run_cli(QStringList{"segment", volume_, "--out", volume_} + ball_arguments(Index3(24)));
  QVERIFY2(outcome.failed_in_one_line(2), outcome.told());
  QCOMPARE(bytes_of(folder_ / "ball.nrrd"), before);
  // Labels may be a picture.
  const QString labels = text(folder_ / "labels.png");
  const Outcome picture = run_cli({"render", volume_, "--labels", labels, "--out", labels});
  QVERIFY2(picture.failed_in_one_line(2) && picture.err.contains("read and written at once"), picture.told());
}

void CliUsageTest::the_program_links_no_qt() {
  QProcess ldd;
  ldd.start("ldd", {cli_program()});
  QVERIFY(ldd.waitForFinished());
  const QByteArray libraries = ldd.readAllStandardOutput();
  QVERIFY2(libraries.contains("libstdc++"), libraries);
  QVERIFY2(!libraries.contains("libQt"), libraries);
}

TIDEMARK_TEST(CliUsageTest)

}  // namespace tidemark::test::cli_usage_test

#include "cli_usage_test.moc"
