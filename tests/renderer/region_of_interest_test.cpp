// The paper's Fig. 13: the vessels of a liver, first among everything that is as bright, then in the liver
// alone.
#include <QTest>

#include "imaging/phantom/phantom.h"
#include "renderer/sheet.h"
#include "solver/distance_transform.h"
#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::region_of_interest_test {

namespace {

Mask above(const solver::Field& phi, float least) {
  const std::vector<float> values = phi.dense();
  Mask mask{phi.geometry, std::vector<std::uint8_t>(values.size())};
  std::transform(values.begin(), values.end(), mask.voxels.begin(),
                 [&](float value) { return static_cast<std::uint8_t>(value > least ? 1 : 0); });
  return mask;
}

// The liver with its vessels: closed over what is narrower than twice `voxels`.
Mask closed(const Mask& mask, double voxels) {
  const auto reach = static_cast<float>(voxels);
  const Mask larger = above(solver::distance_transform(mask, voxels + 1.0), -reach);
  return above(solver::distance_transform(larger, voxels + 1.0), reach);
}

}  // namespace

class RegionOfInterestTest : public QObject {
  Q_OBJECT

 private slots:
  void the_level_set_cuts_the_vessels_of_the_liver_out() {
    auto phantom = imaging::make_phantom("organ");
    QCOMPARE(failure(phantom), QString());
    Scene scene;
    const Mask liver = closed(phantom->truth, 8.0);
    scene.phi = solver::distance_transform(liver, solver::default_band(liver.geometry));
    scene.source = std::make_shared<const Volume>(std::move(phantom->volume));
    scene.middle = renderer::middle_of(scene.phi);
    Painter draw(scene);

    renderer::VolumeView surface;
    const renderer::Picture silhouette = draw(surface, 256, 256);
    renderer::VolumeView view;
    view.surface = false;
    view.source = transfer_function(
        R"({"source": [{"value": {"ramp": [150, 190]}, "opacity": 1, "colour": [0.85, 0.15, 0.12]}]})");
    const renderer::Picture everything = draw(view, 256, 256);
    view.region = renderer::Region::inside;
    const renderer::Picture inside = draw(view, 256, 256);

    const glm::ivec3 background = pixel(inside, 0, 0);
    const auto is_vessel = [](glm::ivec3 c) { return c.r > 100 && c.r > c.g + 50; };
    std::int64_t elsewhere = 0;  // as bright, but not in the liver
    std::int64_t vessels = 0;
    for (std::int64_t y = 1; y < 255; ++y) {
      for (std::int64_t x = 1; x < 255; ++x) {
        bool near_liver = false;
        for (std::int64_t v = y - 1; v <= y + 1; ++v) {
          for (std::int64_t u = x - 1; u <= x + 1; ++u) near_liver |= is_surface(pixel(silhouette, u, v));
        }
        if (near_liver) {
          vessels += is_vessel(pixel(inside, x, y)) ? 1 : 0;
        } else {
          QCOMPARE(pixel(inside, x, y), background);
          elsewhere += is_vessel(pixel(everything, x, y)) ? 1 : 0;
        }
      }
    }
    qInfo("%lld pixels of vessels; %lld as bright elsewhere, hidden", static_cast<long long>(vessels),
          static_cast<long long>(elsewhere));
    QVERIFY(vessels > 500);
    QVERIFY(elsewhere > 5000);
  }
};

TIDEMARK_TEST(RegionOfInterestTest)

}  // namespace tidemark::test::region_of_interest_test

#include "region_of_interest_test.moc"
