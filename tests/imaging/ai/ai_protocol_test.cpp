// Both protocols with servers of tests: models, clicks, grids, probabilities, and what is sent.
#include <QTest>
#include <algorithm>

#include "imaging/ai/ai_services.h"
#include "tests/imaging/ai/model_server.h"
#include "tests/support/test_program.h"

namespace tidemark::test::ai_protocol_test {

using imaging::AiAnswer;
using imaging::AiModel;
using imaging::AiRequest;

class AiProtocolTest : public QObject {
  Q_OBJECT

  static QStringList names(const std::vector<AiModel>& models) {
    QStringList all;
    for (const AiModel& model : models) all << QString::fromStdString(model.name);
    all.sort();
    return all;
  }

 private slots:
  void models_are_listed_without_those_that_take_no_volume() {
    const ModelServer monai("monai-label");
    const auto models = imaging::ai_models(monai.server());
    QCOMPARE(failure(models), QString());
    QCOMPARE(names(*models), (QStringList{"deepedit", "deepgrow_3d", "segmentation_ball", "soft", "turned"}));
    const AiModel ball = model_of(monai.server(), "segmentation_ball");
    QCOMPARE(ball.clicks, AiModel::Clicks::none);
    QCOMPARE(QString::fromStdString(ball.description), QString("What is bright"));
    QVERIFY(ball.labels == (std::vector<imaging::AiLabel>{{2, "ball"}}));
    const AiModel edit = model_of(monai.server(), "deepedit");
    QCOMPARE(edit.clicks, AiModel::Clicks::optional);
    QVERIFY(edit.labels == (std::vector<imaging::AiLabel>{{1, "left"}, {2, "right"}}));
    for (const char* protocol : {"dls", "dls-old"}) {
      const ModelServer server(protocol);
      const auto listed = imaging::ai_models(server.server());
      QCOMPARE(failure(listed), QString());
      QCOMPARE(names(*listed), QStringList{"nnInteractive"});
      QCOMPARE(listed->front().clicks, AiModel::Clicks::required);
    }
  }

  void a_ball_is_found_by_clicks_where_it_lies_data() {
    QTest::addColumn<QString>("protocol");
    QTest::addColumn<QString>("model");
    QTest::newRow("MONAI Label") << "monai-label"
                                 << "deepgrow_3d";
    QTest::newRow("MONAI Label, the other way round") << "monai-label"
                                                      << "turned";
    QTest::newRow("DLS") << "dls"
                         << "nnInteractive";
    QTest::newRow("DLS before v2") << "dls-old"
                                   << "nnInteractive";
  }
  void a_ball_is_found_by_clicks_where_it_lies() {
    QFETCH(QString, protocol);
    QFETCH(QString, model);
    const ModelServer server(protocol.toStdString());
    const Volume volume = oblique_balls();
    AiRequest request{model_of(server.server(), model.toStdString()), {}, {}};
    request.clicks.inside = {kDimBall};
    const auto dim = imaging::ai_segment(server.server(), volume, request);
    QCOMPARE(failure(dim), QString());
    QVERIFY(!dim->is_probability);
    QVERIFY(dim->geometry == volume.geometry);
    QVERIFY(imaging::mask_of(*dim).voxels == voxels_of(volume, 400.0F).voxels);
    // Both balls by two clicks, and what a click outside takes away again.
    request.clicks.inside = {kDimBall, kBrightBall};
    const auto both = imaging::ai_segment(server.server(), volume, request);
    QCOMPARE(failure(both), QString());
    QCOMPARE(imaging::mask_of(*both).count(),
             voxels_of(volume, 400.0F).count() + voxels_of(volume, 900.0F).count());
    request.clicks.outside = {kDimBall};
    const auto bright = imaging::ai_segment(server.server(), volume, request);
    QCOMPARE(failure(bright), QString());
    QVERIFY(imaging::mask_of(*bright).voxels == voxels_of(volume, 900.0F).voxels);
  }

  void labels_come_with_their_names() {
    const ModelServer server("monai-label");
    const Volume volume = oblique_balls();
    const auto ball = imaging::ai_segment(server.server(), volume,
                                          {model_of(server.server(), "segmentation_ball"), {}, {}});
    QCOMPARE(failure(ball), QString());
    const auto segments = imaging::segments_of(*ball, "answer");
    QCOMPARE(failure(segments), QString());
    QCOMPARE(segments->list.size(), std::size_t{1});
    QCOMPARE(QString::fromStdString(segments->list.front().name), QString("ball"));
    QCOMPARE(segments->list.front().count(), voxels_of(volume, 900.0F).count());
    QCOMPARE(imaging::mask_of(*ball, 1).count(), 0);
    QCOMPARE(imaging::mask_of(*ball, 2).count(), voxels_of(volume, 900.0F).count());
    // Clicks belong to the label that is asked for.
    AiRequest request{model_of(server.server(), "deepedit"), "right", {{kDimBall}, {kAir}}};
    const auto right = imaging::ai_segment(server.server(), volume, request);
    QCOMPARE(failure(right), QString());
    QCOMPARE(QString::fromStdString(imaging::segments_of(*right, "answer")->list.front().name),
             QString("right"));
  }

  void a_probability_stays_one() {
    const ModelServer server("monai-label");
    const Volume volume = oblique_balls();
    const auto soft = imaging::ai_segment(
        server.server(), volume, {model_of(server.server(), "soft"), {}, {{kDimBall, kBrightBall}, {}}});
    QCOMPARE(failure(soft), QString());
    QVERIFY(soft->is_probability);
    const auto map = imaging::map_of(*soft);
    QCOMPARE(map[static_cast<std::size_t>(volume.geometry.offset(kDimBall))], 0.9F);
    QCOMPARE(map[static_cast<std::size_t>(volume.geometry.offset(kAir))], 0.25F);
    QCOMPARE(imaging::segments_of(*soft, "soft")->list.front().count(), imaging::mask_of(*soft).count());
    QVERIFY(imaging::mask_of(*soft).voxels[static_cast<std::size_t>(volume.geometry.offset(kBrightBall))] ==
            1);
  }

  void nothing_that_says_whose_it_is_is_sent() {
    const Volume volume = oblique_balls();  // whose description names a patient
    for (const char* protocol : {"monai-label", "dls"}) {
      const ModelServer server(protocol);
      const bool is_monai = server.server().protocol == imaging::AiServer::Protocol::monai_label;
      const AiModel model = model_of(server.server(), is_monai ? "deepgrow_3d" : "nnInteractive");
      QCOMPARE(failure(imaging::ai_segment(server.server(), volume, {model, {}, {{kDimBall}, {}}})),
               QString());
      const std::string heard = server.heard();
      QVERIFY(heard.size() > 1000);
      for (const char* secret : {"Phantom", "Paula", "root", "home"}) {
        QVERIFY2(heard.find(secret) == std::string::npos, secret);
      }
    }
  }

  void a_session_ends_on_the_server_whatever_comes() {
    const ModelServer server("dls");
    const Volume volume = oblique_balls();
    const AiModel model = model_of(server.server(), "nnInteractive");
    QCOMPARE(failure(imaging::ai_segment(server.server(), volume, {model, {}, {{kDimBall}, {}}})), QString());
    const auto ends = [&] {
      const std::string heard = server.heard();
      int count = 0;
      for (std::size_t at = heard.find("/end_session/"); at != std::string::npos;
           at = heard.find("/end_session/", at + 1))
        ++count;
      return count;
    };
    QCOMPARE(ends(), 1);
    std::stop_source stop;
    Progress progress;
    progress.stop = stop.get_token();
    progress.report = [&](double, std::string_view what) {
      if (what == "waiting for the model") stop.request_stop();
    };
    const auto stopped =
        imaging::ai_segment(server.server(), volume, {model, {}, {{kDimBall}, {}}}, progress);
    QVERIFY(!stopped);
    QCOMPARE(stopped.error().kind, ErrorKind::cancelled);
    QCOMPARE(ends(), 2);
  }

  void what_makes_no_sense_is_not_sent() {
    const ModelServer server("dls");
    const Volume volume = oblique_balls();
    AiModel model = model_of(server.server(), "nnInteractive");
    const auto none = imaging::ai_segment(server.server(), volume, {model, {}, {{}, {kAir}}});
    QVERIFY2(failure(none).contains("needs a click inside"), qPrintable(failure(none)));
    QCOMPARE(none.error().kind, ErrorKind::usage);
    const auto beyond = imaging::ai_segment(server.server(), volume, {model, {}, {{Index3{33, 0, 0}}, {}}});
    QVERIFY2(failure(beyond).contains("voxel 33, 0, 0 is outside of the volume of 33 x 20 x 11"),
             qPrintable(failure(beyond)));
    model.name = "other";
    const auto unknown = imaging::ai_segment(server.server(), volume, {model, {}, {{kDimBall}, {}}});
    QVERIFY2(failure(unknown).contains("(HTTP 404)"), qPrintable(failure(unknown)));
    const ModelServer monai("monai-label");
    const auto refused = imaging::ai_segment(monai.server(), volume, {model, {}, {{kDimBall}, {}}});
    QVERIFY2(failure(refused).endsWith("(HTTP 500): Inference Task is not Initialized. There is no model "
                                       "'other' available"),
             qPrintable(failure(refused)));
    // The air and the ball are alike to nothing: the model finds nothing.
    const auto empty = imaging::ai_segment(
        server.server(), volume, {model_of(server.server(), "nnInteractive"), {}, {{kAir}, {kAir}}});
    QVERIFY2(failure(empty).contains("has found nothing"), qPrintable(failure(empty)));
  }
};

TIDEMARK_TEST(AiProtocolTest)

}  // namespace tidemark::test::ai_protocol_test

#include "ai_protocol_test.moc"
