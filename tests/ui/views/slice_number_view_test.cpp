// A view along the acquired plane names each slice by the number that the PACS shows.
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/views/slice_view.h"

namespace tidemark::test::slice_number_view_test {

namespace {

constexpr std::int64_t kSlices = 24;  // of the ball's study

// A ball whose slices are numbered downwards, so that the first is 124, on axes of its own.
std::shared_ptr<const engine::LoadedStudy> numbered_ball(const glm::dmat3& axes = glm::dmat3(1.0)) {
  auto study = std::make_shared<engine::LoadedStudy>(*test::ball_study());
  auto volume = std::make_shared<Volume>(*study->volume);
  volume->geometry.direction = axes;
  study->volume = volume;
  for (std::int64_t k = 0; k < kSlices; ++k) study->slice_numbers.push_back({101 + kSlices - 1 - k, {}});
  return study;
}

// About the patient's left-right axis.
glm::dmat3 turned(double degrees) {
  const double a = degrees * 3.14159265358979 / 180.0;
  return {{1.0, 0.0, 0.0}, {0.0, std::cos(a), std::sin(a)}, {0.0, -std::sin(a), std::cos(a)}};
}

struct View {
  explicit View(std::shared_ptr<const engine::LoadedStudy> study,
                ui::SlicePlane plane = ui::SlicePlane::axial)
      : proxy(engine, std::move(study), solver::ExecutorKind::host),
        view(proxy, plane, renderer::SliceContent::source) {
    show_slice(0.0);
  }
  void show_slice(double k) {
    const glm::dvec3 place = proxy.volume().geometry.to_patient({5.0, 5.0, k});
    proxy.display().change([&](engine::DisplaySettings& settings) { settings.cursor_mm = place; });
  }

  engine::Engine engine{false};
  engine::CaseProxy proxy;
  ui::SliceViewWidget view;
};

}  // namespace

class SliceNumberViewTest : public QObject {
  Q_OBJECT

 private slots:
  void each_slice_has_its_instance() {
    View one(numbered_ball());
    QCOMPARE(one.view.acquired_number(), QString("instance 124"));
    one.show_slice(23.0);
    QCOMPARE(one.view.acquired_number(), QString("instance 101"));
    one.show_slice(7.4);  // the crosshair need not lie in the middle of a slice
    QCOMPARE(one.view.acquired_number(), QString("instance 117"));
  }

  void places_beside_the_volume_have_none() {
    View one(numbered_ball());
    one.show_slice(-1.0);
    QCOMPARE(one.view.acquired_number(), QString());
    one.show_slice(24.0);
    QCOMPARE(one.view.acquired_number(), QString());
  }

  void frames_are_called_frames() {
    auto study = std::make_shared<engine::LoadedStudy>(*numbered_ball());
    study->slice_numbers[2] = {{}, 3};
    study->slice_numbers[3] = {9, 4};
    study->slice_numbers[4] = {};
    View one(study);
    one.show_slice(2.0);
    QCOMPARE(one.view.acquired_number(), QString("frame 3"));
    one.show_slice(3.0);
    QCOMPARE(one.view.acquired_number(), QString("instance 9, frame 4"));
    one.show_slice(4.0);
    QCOMPARE(one.view.acquired_number(), QString());
  }

  void views_along_other_planes_have_none() {
    for (const ui::SlicePlane plane : {ui::SlicePlane::coronal, ui::SlicePlane::sagittal}) {
      View one(numbered_ball(), plane);
      QCOMPARE(one.view.acquired_number(), QString());
    }
    View tilted(numbered_ball(turned(20.0)));
    QCOMPARE(tilted.view.acquired_number(), QString());
    View files(test::ball_study());
    QCOMPARE(files.view.acquired_number(), QString());
  }

  // Rows and columns of the images are level, and the convention of left and right is kept.
  void the_acquired_plane_of_a_tilted_series_is_shown_data() {
    QTest::addColumn<double>("degrees");
    QTest::addColumn<bool>("is_mirrored");
    for (const double degrees : {20.0, -40.0, 80.0}) {
      QTest::addRow("%g", degrees) << degrees << false;
      QTest::addRow("%g, mirrored", degrees) << degrees << true;
    }
  }

  void the_acquired_plane_of_a_tilted_series_is_shown() {
    QFETCH(double, degrees);
    QFETCH(bool, is_mirrored);
    glm::dmat3 axes = turned(degrees);
    if (is_mirrored) axes = {-axes[0], axes[1], -axes[2]};
    View one(numbered_ball(axes), ui::SlicePlane::oblique);
    const renderer::SliceOrientation plane = ui::acquired_plane(one.proxy.volume().geometry);
    const renderer::SliceOrientation standard = renderer::oblique(axes[2]);
    QVERIFY(std::abs(std::abs(glm::dot(plane.right, axes[0])) - 1.0) < 1e-12);
    QVERIFY(std::abs(std::abs(glm::dot(plane.up, axes[1])) - 1.0) < 1e-12);
    QVERIFY(glm::dot(plane.right, standard.right) > 0.7 && glm::dot(plane.up, standard.up) > 0.7);
    one.proxy.display().change([&](engine::DisplaySettings& settings) { settings.oblique = plane; });
    one.show_slice(3.0);
    QCOMPARE(one.view.acquired_number(), QString("instance 121"));
    QCOMPARE(one.view.place().slices, kSlices);
  }
};

TIDEMARK_TEST(SliceNumberViewTest)

}  // namespace tidemark::test::slice_number_view_test

#include "slice_number_view_test.moc"
