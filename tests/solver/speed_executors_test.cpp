// Every executor gives the same surface for every speed function.
#include "speed_functions.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::speed_executors_test {

using namespace tidemark::solver;

namespace {

// Two bright balls that melt into one, in noise, on thick slices.
struct Scene {
  Geometry geometry = grid({44, 40, 24}, {1.0, 1.0, 1.5});
  SpeedInputs inputs;

  [[nodiscard]] double object(glm::dvec3 p) const {
    const glm::dvec3 centre = centre_of(geometry);
    return 10.0 - std::min(glm::distance(p, centre + glm::dvec3(5.0, 2.0, 0.0)),
                           glm::distance(p, centre - glm::dvec3(5.0, 2.0, 0.0)));
  }

  [[nodiscard]] double start(glm::dvec3 p) const { return object(p) - 2.5; }

  Scene() {
    inputs.source =
        with_noise(volume_of(geometry, [&](glm::dvec3 p) { return object(p) > 0.0 ? 60.0 : 20.0; }), 6.0);
    inputs.map = volume_of(geometry, [&](glm::dvec3 p) { return 1.0 / (1.0 + std::exp(-object(p))); });
    inputs.strokes = strokes();
    inputs.parameters.target = 60.0;
    inputs.parameters.range = 25.0;
    inputs.parameters.alpha = 0.6;
  }

  // Well inside and well outside, some voxels of many.
  [[nodiscard]] std::shared_ptr<const Strokes> strokes() const {
    auto strokes = std::make_shared<Strokes>();
    const std::vector<float> depth = sample(geometry, [&](glm::dvec3 p) { return object(p); });
    for (std::size_t i = 0; i < depth.size(); i += 29) {
      if (depth[i] > 2.0F) strokes->inside.push_back(static_cast<std::int64_t>(i));
      if (depth[i] < -2.0F) strokes->outside.push_back(static_cast<std::int64_t>(i));
    }
    return strokes;
  }

  [[nodiscard]] Mask result(ExecutorKind kind, const SpeedSetting& setting) const {
    auto made = make_speed(setting, inputs);
    if (!made) qFatal("%s", made.error().message.c_str());
    const auto level_set = executor(kind, inputs.source, inputs.parameters);
    set_phi(*level_set, geometry, [&](glm::dvec3 p) { return start(p); });
    if (const auto status = level_set->set_speed(*made); !status)
      qFatal("%s", status.error().message.c_str());
    run(*level_set, 160);
    return level_set->snapshot()->mask();
  }
};

SpeedSetting joined(const std::string& one, const std::string& other, Combine combine) {
  return {{SpeedTerm{one, {}}, SpeedTerm{other, {}}}, combine};
}

}  // namespace

class SpeedExecutorsTest : public QObject {
  Q_OBJECT

 private slots:
  void all_give_the_same_surface_data() {
    QTest::addColumn<SpeedSetting>("setting");
    QTest::newRow("regions") << setting_of("regions");
    QTest::newRow("regions within 5 mm") << setting_of("regions", {{"radius", 5.0}});
    QTest::newRow("edges") << setting_of("edges");
    QTest::newRow("image") << setting_of("image");
    QTest::newRow("examples") << setting_of("examples");
    QTest::newRow("the product of examples and edges") << joined("examples", "edges", Combine::product);
    QTest::newRow("the least of tent and edges") << joined("tent", "edges", Combine::least);
    QTest::newRow("the product of regions and image") << joined("regions", "image", Combine::product);
  }

  void all_give_the_same_surface() {
    QFETCH(SpeedSetting, setting);
    const Scene scene;
    const Mask host = scene.result(ExecutorKind::host, setting);
    const auto phi = sample(scene.geometry, [&](glm::dvec3 p) { return scene.start(p); });
    const auto before = std::count_if(phi.begin(), phi.end(), [](float value) { return value > 0.0F; });
    QVERIFY(host.count() > before * 3 / 2);  // it has moved
    for (const ExecutorKind kind : {ExecutorKind::reference, ExecutorKind::compute, ExecutorKind::stream}) {
      const double overlap = dice(host, scene.result(kind, setting));
      QVERIFY2(overlap >= 0.999, qPrintable(QString::number(overlap)));
    }
  }
};

TIDEMARK_TEST(SpeedExecutorsTest)

}  // namespace tidemark::test::speed_executors_test

#include "speed_executors_test.moc"
