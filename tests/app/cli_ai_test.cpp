// The commands under tidemark-cli ai, with a server of the tests.
#include <QJsonArray>
#include <QTest>

#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/app/cli_runner.h"
#include "tests/imaging/ai/model_server.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_ai_test {

class CliAiTest : public QObject {
  Q_OBJECT

  // The balls as a file, and the file of servers.
  struct Site {
    explicit Site(const std::string& protocol) : server(protocol) {
      server.write_configuration(folder / "ai.json");
      const Status written = imaging::write_volume_file(oblique_balls(), folder / "balls.nii.gz");
      if (!written) qFatal("%s", written.error().message.c_str());
    }
    [[nodiscard]] QStringList use() const { return {"--servers", text(folder / "ai.json")}; }
    [[nodiscard]] QString file(const char* name) const { return text(folder / name); }
    [[nodiscard]] static QString point(const char* side, Index3 at) {
      return QStringLiteral("%1:%2,%3,%4").arg(side).arg(at.x).arg(at.y).arg(at.z);
    }

    TemporaryFolder folder;
    ModelServer server;
  };

 private slots:
  void models_are_listed() {
    const Site site("monai-label");
    const Outcome json = run_cli(QStringList{"ai", "models", "models", "--json"} + site.use());
    QVERIFY2(json.code == 0, json.told());
    const QJsonArray models = json_of(json.out)["models"].toArray();
    QCOMPARE(models.size(), 5);
    const Outcome words = run_cli(QStringList{"ai", "models", "models"} + site.use());
    QVERIFY2(words.out.contains("segmentation_ball\n  What is bright\n  clicks  none\n  labels  ball\n"),
             words.told());
  }

  void a_ball_is_segmented_by_clicks_data() {
    QTest::addColumn<QString>("protocol");
    QTest::addColumn<QString>("model");
    QTest::newRow("MONAI Label") << "monai-label"
                                 << "deepgrow_3d";
    QTest::newRow("DLS") << "dls"
                         << "nnInteractive";
  }
  void a_ball_is_segmented_by_clicks() {
    QFETCH(QString, protocol);
    QFETCH(QString, model);
    const Site site(protocol.toStdString());
    const QStringList arguments = QStringList{"ai",      "segment",
                                              "models",  site.file("balls.nii.gz"),
                                              "--model", model,
                                              "--point", Site::point("inside", kDimBall),
                                              "--point", Site::point("inside", kBrightBall),
                                              "--point", Site::point("outside", kBrightBall),
                                              "--out",   site.file("mask.nii.gz")} +
                                  site.use();
    const Outcome segment = run_cli(arguments);
    QVERIFY2(segment.code == 0, segment.told());
    const QByteArray where = QByteArray::fromStdString(site.server.server().access.url);
    QVERIFY2(segment.out.contains("Sent to    models (" + where + "), on this machine\n"), segment.told());
    const auto mask = imaging::read_volume_file(site.folder / "mask.nii.gz");
    QCOMPARE(failure(mask), QString());
    const Volume balls = oblique_balls();
    QVERIFY(same_grid(mask->geometry, balls.geometry, 1e-3));
    QVERIFY(voxels_of(*mask, 1.0F).voxels == voxels_of(balls, 400.0F).voxels);
    const Outcome json = run_cli(arguments + QStringList{"--json"});
    QVERIFY2(json.code == 0, json.told());
    QCOMPARE(json_of(json.out)["form"].toString(), QString("labels"));
    QCOMPARE(json_of(json.out)["voxels"].toInt(), static_cast<int>(voxels_of(balls, 400.0F).count()));
    QCOMPARE(json_of(json.out)["encrypted"].toBool(true), false);
  }

  void a_probability_drives_a_surface() {
    const Site site("monai-label");
    const Outcome soft = run_cli(QStringList{"ai", "segment", "models", site.file("balls.nii.gz"), "--model",
                                             "soft", "--point", Site::point("inside", kDimBall), "--out",
                                             site.file("soft.nrrd"), "--json"} +
                                 site.use());
    QVERIFY2(soft.code == 0, soft.told());
    QCOMPARE(json_of(soft.out)["form"].toString(), QString("probability"));
    const Outcome segment =
        run_cli({"segment", site.file("balls.nii.gz"), "--speed", "image", "--speed-image",
                 site.file("soft.nrrd"), "--alpha", "0.9", "--seed",
                 QStringLiteral("%1,%2,%3,3").arg(kDimBall.x).arg(kDimBall.y).arg(kDimBall.z), "--out",
                 site.file("mask.nii.gz")});
    QVERIFY2(segment.code == 0, segment.told());
    const auto mask = imaging::load_mask(site.folder / "mask.nii.gz");
    QCOMPARE(failure(mask), QString());
    QVERIFY(dice(*mask, voxels_of(oblique_balls(), 400.0F)) > 0.8);
  }

  void failures_end_with_their_code_and_one_line_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<int>("code");
    QTest::addColumn<QByteArray>("said");
    const QStringList good{"segment",     "models", "balls.nii.gz", "--model",
                           "deepgrow_3d", "--out",  "m.nii.gz"};
    QTest::newRow("no command") << QStringList{} << 2 << QByteArray("ai --help");
    QTest::newRow("unknown server")
        << QStringList{"models", "nobody"} << 2
        << QByteArray("there is no AI server 'nobody': those that are configured are models");
    QTest::newRow("no model") << QStringList{"segment", "models", "balls.nii.gz", "--out", "m.nii.gz"} << 2
                              << QByteArray("--model");
    QTest::newRow("unknown model") << QStringList{"segment", "models", "balls.nii.gz", "--model",
                                                  "x",       "--out",  "m.nii.gz"}
                                   << 2
                                   << QByteArray("--model x: the server models has no such model: it has ");
    QTest::newRow("unknown label") << good + QStringList{"--label", "x"} << 2
                                   << QByteArray("has no such label");
    QTest::newRow("no click") << good << 2 << QByteArray("needs a click inside");
    QTest::newRow("a click elsewhere") << good + QStringList{"--point", "inside:99,0,0"} << 2
                                       << QByteArray("outside of the volume of 33 x 20 x 11");
    for (const char* point :
         {"1,2,3", "within:1,2,3", "inside:1,2", "inside:1,2,-3", "inside:1,2,x", "inside:1.5,2,3"})
      QTest::newRow(point) << good + QStringList{"--point", point} << 2
                           << QByteArray("inside:I,J,K or outside:I,J,K is wanted");
    QTest::newRow("a surface") << QStringList{"segment", "models", "balls.nii.gz", "--model",
                                              "soft",    "--out",  "m.stl"}
                               << 2 << QByteArray("m.stl");
    QTest::newRow("over the input") << QStringList{"segment", "models", "balls.nii.gz", "--model",
                                                   "soft",    "--out",  "balls.nii.gz"}
                                    << 2 << QByteArray("balls.nii.gz");
  }
  void failures_end_with_their_code_and_one_line() {
    QFETCH(QStringList, arguments);
    QFETCH(int, code);
    QFETCH(QByteArray, said);
    const Site site("monai-label");
    if (!arguments.isEmpty()) arguments += site.use();
    const Outcome outcome = run_cli(QStringList{"ai"} + arguments, {.folder = text(site.folder.path())});
    QVERIFY2(outcome.failed_in_one_line(code), outcome.told());
    QVERIFY2(outcome.err.contains(said), outcome.told());
    QCOMPARE(names_in(site.folder.path()), (QStringList{"ai.json", "balls.nii.gz"}));
  }

  void without_a_file_of_servers_nothing_is_asked() {
    const TemporaryFolder folder;
    RunOptions options;
    options.environment.insert("XDG_CONFIG_HOME", text(folder.path()));
    options.environment.insert("TIDEMARK_SITE", text(folder.path()));
    const Outcome none = run_cli({"ai", "models", "main"}, options);
    QVERIFY2(none.failed_in_one_line(3) && none.err.contains("tidemark/ai.json: no such file"), none.told());
    const ModelServer server("dls");
    server.write_configuration(folder / "ai.json");  // the site's
    const Outcome site = run_cli({"ai", "models", "models"}, options);
    QVERIFY2(site.code == 0 && site.out.contains("nnInteractive"), site.told());
  }
};

TIDEMARK_TEST(CliAiTest)

}  // namespace tidemark::test::cli_ai_test

#include "cli_ai_test.moc"
