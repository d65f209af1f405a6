// Volume renderings by the processor that keep what no changed page is in front of.
#include <QTest>

#include "imaging/phantom/phantom.h"
#include "renderer/renderer.h"
#include "solver/executor.h"
#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::kept_picture_test {

namespace {

constexpr renderer::PictureSize kSize{160, 144};

std::unique_ptr<renderer::Renderer> renderer_for(const Scene& scene, const PageLayout& layout) {
  return std::move(*renderer::make_renderer(renderer::RendererKind::host, nullptr, scene.source, layout));
}

std::unique_ptr<solver::Executor> executor_for(const Scene& scene, double radius_mm) {
  solver::Parameters parameters;
  parameters.target = 100.0;
  parameters.range = 50.0;
  auto executor = solver::make_executor(solver::ExecutorKind::host, scene.source, parameters, {});
  if (!executor || !(*executor)->paint({scene.middle, radius_mm}, solver::Brush::add)) qFatal("no executor");
  return std::move(*executor);
}

renderer::Picture picture_of(renderer::Renderer& renderer, const renderer::VolumeView& view) {
  return std::move(*renderer.draw(view, kSize, {}));
}

// Between the picture of a renderer that may keep some of the one before, and of one that has none.
GreyDifference difference_to_fresh(renderer::Renderer& kept, const Scene& scene, solver::Executor& executor) {
  const auto fresh = renderer_for(scene, executor.snapshot()->layout);
  for (renderer::Renderer* one : {&kept, fresh.get()}) {
    if (const auto looks = one->look_at(executor, std::nullopt); !looks || !*looks)
      qFatal("it does not look");
  }
  return grey_difference(picture_of(kept, {}), picture_of(*fresh, {}));
}

// A ball of 100 in 0, and at its side another one.
double two_balls(glm::dvec3 p) {
  return glm::length(p - glm::dvec3(24.0)) < 14.0 || glm::length(p - glm::dvec3(60.0, 40.0, 30.0)) < 10.0
             ? 100.0
             : 0.0;
}

}  // namespace

class KeptPictureTest : public QObject {
  Q_OBJECT

 private slots:
  void the_pixels_are_those_of_a_picture_painted_whole_data() {
    QTest::addColumn<QString>("shows");
    QTest::addColumn<bool>("copies");
    for (const bool copies : {false, true}) {
      const char* const from = copies ? "copies" : "memory";
      for (const char* const shows : {"surface", "occlusion", "clip plane", "source inside"}) {
        QTest::addRow("%s, %s", shows, from) << QString(shows) << copies;
      }
    }
  }
  void the_pixels_are_those_of_a_picture_painted_whole() {
    QFETCH(QString, shows);
    QFETCH(bool, copies);
    const Scene scene = ball_scene(grid({80, 64, 48}), 6.0, two_balls);
    renderer::VolumeView view;
    view.camera.azimuth = 30.0;
    view.camera.elevation = 20.0;
    view.lighting.occlusion = shows == "occlusion" ? 1.0 : 0.0;
    if (shows == "clip plane")
      view.clip = renderer::ClipPlane{glm::normalize(glm::dvec3(0.3, -0.5, 0.8)), 26.0};
    if (shows == "source inside") {
      view.source = *renderer::preset("ct-soft-tissue");
      view.region = renderer::Region::inside;
      view.surface_colour.a = 0.4F;
    }
    const auto executor = executor_for(scene, 6.0);
    const PageLayout layout = executor->snapshot()->layout;
    const auto kept = renderer_for(scene, layout);
    const auto look = [&](renderer::Renderer& renderer) {
      if (copies) {
        QCOMPARE(failure(renderer.set_phi(*executor->snapshot())), QString());
      } else {
        const auto looks = renderer.look_at(*executor, std::nullopt);
        QVERIFY(looks && *looks);
      }
    };
    double least_painted = 1.0;
    for (int run = 0; run < 12; ++run) {
      if (run == 8) {  // somewhere else, after the front has come to rest
        QCOMPARE(failure(executor->paint({{60.0, 40.0, 30.0}, 5.0}, solver::Brush::add)), QString());
      } else {
        QCOMPARE(failure(executor->advance({run < 7 ? 7 : 400})), QString());
      }
      look(*kept);
      const renderer::Picture part = picture_of(*kept, view);
      least_painted = std::min(least_painted, part.painted);
      const auto fresh = renderer_for(scene, layout);
      look(*fresh);
      const renderer::Picture whole = picture_of(*fresh, view);
      QCOMPARE(whole.painted, 1.0);
      const GreyDifference difference = grey_difference(part, whole);
      QVERIFY2(difference.most <= 1, words(difference));
      QVERIFY2(difference.mean < 1e-3, words(difference));
    }
    QVERIFY2(least_painted < 0.35, qPrintable(QString::number(least_painted)));
  }

  void nothing_is_painted_where_nothing_changed() {
    const Scene scene = ball_scene(grid({64, 64, 48}), 12.0);
    const auto executor = executor_for(scene, 12.0);
    const auto renderer = renderer_for(scene, executor->snapshot()->layout);
    for (const double painted : {1.0, 0.0, 0.0}) {
      QVERIFY(*renderer->look_at(*executor, std::nullopt));
      QCOMPARE(picture_of(*renderer, {}).painted, painted);
    }
  }

  // Its memory may lie where the other one's did.
  void another_executor_is_another_surface() {
    const Scene scene = ball_scene(grid({64, 64, 48}), 12.0);
    const auto kept = renderer_for(scene, executor_for(scene, 12.0)->snapshot()->layout);
    for (const double radius : {12.0, 6.0, 15.0}) {
      QVERIFY(difference_to_fresh(*kept, scene, *executor_for(scene, radius)).most <= 1);
    }
  }

  void executors_that_live_side_by_side_are_told_apart() {
    const Scene scene = ball_scene(grid({64, 64, 48}), 12.0);
    const auto first = executor_for(scene, 12.0);
    const auto second = executor_for(scene, 6.0);
    const auto kept = renderer_for(scene, first->snapshot()->layout);
    for (solver::Executor* executor : {first.get(), second.get(), first.get()}) {
      QVERIFY(difference_to_fresh(*kept, scene, *executor).most <= 1);
    }
  }

  void a_view_that_shows_more_than_phi_is_painted_whole() {
    const Scene scene = ball_scene(grid({64, 64, 48}), 12.0);
    const auto executor = executor_for(scene, 12.0);
    const auto renderer = renderer_for(scene, executor->snapshot()->layout);
    QVERIFY(*renderer->look_at(*executor, std::nullopt));
    renderer::VolumeView coloured;
    coloured.colouring = renderer::SurfaceColouring::curvature;
    renderer::VolumeView turned;
    turned.camera.azimuth = 10.0;
    for (const renderer::VolumeView& view : {renderer::VolumeView(), coloured, coloured, turned}) {
      QCOMPARE(picture_of(*renderer, view).painted, 1.0);
    }
    PagedBytes labels(scene.source->geometry.size);
    labels.fill({20, 20, 20}, {4, 4, 4}, 1);
    QCOMPARE(failure(renderer->set_labels(labels)), QString());
    renderer::VolumeView labelled;
    labelled.label_opacity = 1.0;
    for (int i = 0; i < 2; ++i) QCOMPARE(picture_of(*renderer, labelled).painted, 1.0);
  }
};

TIDEMARK_TEST(KeptPictureTest)

}  // namespace tidemark::test::kept_picture_test

#include "kept_picture_test.moc"
