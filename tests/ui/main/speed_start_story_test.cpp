// A surface that begins wherever it would grow: in every object like the one that was painted in.
#include <QPushButton>
#include <algorithm>
#include <glm/geometric.hpp>

#include "imaging/files/volume_file.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/initialise_panel.h"

namespace tidemark::test::speed_start_story_test {

class SpeedStartStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void strokes_in_one_object_find_the_others();

 private:
  static constexpr std::int64_t kSide = 64;
  static constexpr double kRadius = 6.0;

  // Balls of 900 with some noise, in 400.
  QString study();
  static std::vector<glm::dvec3> centres() {
    return {{20, 20, 32}, {46, 24, 32}, {24, 48, 14}, {44, 44, 50}};
  }

  TemporaryFolder folder_;
  Mask truth_;
};

QString SpeedStartStoryTest::study() {
  Volume volume;
  volume.geometry.size = Index3(kSide);
  truth_.geometry = volume.geometry;
  std::vector<float> values;
  std::uint32_t random = 7;
  for (std::int64_t i = 0; i < volume.geometry.voxel_count(); ++i) {
    const glm::dvec3 p(volume.geometry.voxel_at(i));
    const auto balls = centres();
    const bool inside =
        std::any_of(balls.begin(), balls.end(), [&](glm::dvec3 c) { return glm::distance(p, c) < kRadius; });
    random = random * 1664525U + 1013904223U;
    values.push_back((inside ? 900.0F : 400.0F) + static_cast<float>(random >> 16U) / 655.36F);
    truth_.voxels.push_back(inside ? 1 : 0);
  }
  volume.voxels = std::move(values);
  const std::filesystem::path path = folder_ / "balls.nii.gz";
  if (const auto written = imaging::write_volume_file(volume, path); !written) qFatal("no study");
  return QString::fromStdString(path.string());
}

void SpeedStartStoryTest::strokes_in_one_object_find_the_others() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open(study()));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const Geometry& grid = desktop.proxy().volume().geometry;
  const auto patient = [&](glm::dvec3 voxel) { return grid.to_patient(voxel); };
  desktop.proxy().display().change(
      [&](engine::DisplaySettings& settings) { settings.cursor_mm = patient(centres().front()); });
  desktop.press(Qt::Key_M);
  Desktop::drag(*axial, {patient({18, 20, 32}), patient({22, 20, 32})});
  Desktop::drag(*axial, {patient({8, 8, 32}), patient({30, 8, 32})}, Qt::RightButton);
  Desktop::drag(*axial, {patient({30, 34, 32}), patient({34, 34, 32})}, Qt::RightButton);
  desktop.wait_until_idle();
  QVERIFY(!desktop.state().begun);

  // What a stroke says of its surroundings must not speak against the other balls.
  desktop.window().panels().show("level-set");
  desktop.wait_until_idle();
  desktop.type_into("Edges", "200");
  QCOMPARE(desktop.proxy().drive().setting.terms.front().values.at("edges"), 200.0);

  desktop.window().panels().show("initialise");
  desktop.wait_until_idle();
  auto* panel = desktop.window().findChild<ui::InitialisePanel*>();
  QVERIFY(panel && panel->isVisible());
  Desktop::choose_in(*panel, "Begin with", "Speed above 0");
  const auto buttons = panel->findChildren<QPushButton*>();
  const auto place = std::find_if(buttons.begin(), buttons.end(),
                                  [](const QPushButton* one) { return one->text() == "Place surface"; });
  QVERIFY(place != buttons.end() && (*place)->isEnabled());
  desktop.screenshot("speed-start-0-panel");
  QTest::mouseClick(*place, Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().begun; }));
  desktop.wait_until_idle();
  desktop.screenshot("speed-start-1-placed");
  const Mask placed = desktop.state().phi->mask();
  for (const glm::dvec3 centre : centres())
    QVERIFY(placed.voxels[static_cast<std::size_t>(grid.offset(Index3(centre)))] != 0);
  const double overlap = tidemark::dice(placed, truth_);
  QVERIFY2(overlap >= 0.85, qPrintable(QString::number(overlap)));

  // One entry of the history.
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(!desktop.state().begun);
}

TIDEMARK_TEST(SpeedStartStoryTest)

}  // namespace tidemark::test::speed_start_story_test

#include "speed_start_story_test.moc"
