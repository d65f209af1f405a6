// Studies whose slices make no regular grid, on the command line.
#include <QJsonArray>
#include <algorithm>

#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_slices_test {

class CliSlicesTest : public QObject {
  Q_OBJECT

  std::unique_ptr<SphereStudy> study_;
  QString series_;

 private slots:
  // One slice near the ball's middle is taken out.
  void initTestCase() {
    study_ = std::make_unique<SphereStudy>();
    series_ = text(*study_ / "series");
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(*study_ / "series")) {
      files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    QVERIFY(std::filesystem::remove(files[files.size() / 2]));
  }

  void info_tells_what_could_be_done_and_what_would_be() {
    const QJsonObject refused =
        json_of(must_run({"info", series_, "--json"}).out)["series"].toArray()[0].toObject();
    QVERIFY(!refused["loadable"].toBool());
    QVERIFY(refused["fillable"].toBool());
    QVERIFY(refused["reason"].toString().contains("1 slice is missing between"));
    QVERIFY(must_run({"info", series_}).out.contains("--gaps fill"));
    const QJsonObject filled = json_of(must_run({"info", series_, "--gaps", "fill", "--json"}).out)["series"]
                                   .toArray()[0]
                                   .toObject();
    QVERIFY(filled["loadable"].toBool());
    QCOMPARE(filled["size"].toArray()[2].toInt(), filled["files"].toInt() + 1);
    QVERIFY(filled["changes"].toArray().last().toString().contains("is interpolated between"));
  }

  void every_command_refuses_gaps_and_names_the_way_to_fill_them() {
    const QString out = text(*study_ / "out.nrrd");
    for (const QStringList& command :
         {study_->arguments() + QStringList{"--out", out}, QStringList{"convert", series_, "--out", out},
          QStringList{"render", series_, "--view", "axial", "--out", text(*study_ / "out.png")}}) {
      const Outcome refused = run_cli(command);
      QVERIFY2(refused.failed_in_one_line(3), refused.told());
      QVERIFY2(refused.err.contains("1 slice is missing") && refused.err.contains("--gaps fill"),
               refused.told());
      const Outcome unknown = run_cli(command + QStringList{"--gaps", "guess"});
      QVERIFY2(unknown.failed_in_one_line(2), unknown.told());
    }
    QCOMPARE(must_run({"convert", series_, "--gaps", "fill", "--out", out}).code, 0);
  }

  void a_recipe_remembers_and_what_was_saved_fits() {
    const auto to = [&](const char* name) { return text(*study_ / name); };
    QStringList run = study_->arguments() + QStringList{"--gaps", "fill", "--tilt", "keep"};
    QCOMPARE(must_run(run + QStringList{"--out", to("a.nrrd"), "--out-phi", to("phi.nrrd"), "--recipe",
                                        to("recipe.json"), "--out", to("seg.dcm")})
                 .code,
             0);
    const QJsonObject source = json_of(bytes_of(*study_ / "recipe.json"))["source"].toObject();
    QCOMPARE(source["slices"].toObject(), QJsonObject({{"tilt", "keep"}, {"gaps", "fill"}}));
    const Outcome replay = must_run({"replay", to("recipe.json"), series_, "--out", to("b.nrrd")});
    QCOMPARE(replay.code, 0);
    QVERIFY2(replay.err.isEmpty(), replay.told());
    QCOMPARE(bytes_of(*study_ / "b.nrrd"), bytes_of(*study_ / "a.nrrd"));
    const Outcome refused =
        run_cli({"replay", to("recipe.json"), series_, "--gaps", "refuse", "--out", to("b.nrrd")});
    QVERIFY2(refused.failed_in_one_line(3), refused.told());
    // Back onto the grid that was filled.
    QCOMPARE(
        must_run({"convert", to("seg.dcm"), "--source", series_, "--gaps", "fill", "--out", to("c.nrrd")})
            .code,
        0);
    QCOMPARE(must_run({"segment", series_, "--gaps", "fill", "--target", "1000", "--range", "400", "--alpha",
                       "0.5", "--init-phi", to("phi.nrrd"), "--steps", "0", "--out", to("d.nrrd")})
                 .code,
             0);
    QCOMPARE(bytes_of(*study_ / "d.nrrd"), bytes_of(*study_ / "a.nrrd"));
  }
};

TIDEMARK_TEST(CliSlicesTest)

}  // namespace tidemark::test::cli_slices_test

#include "cli_slices_test.moc"
