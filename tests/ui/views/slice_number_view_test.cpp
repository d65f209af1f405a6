// Which slice a view shows: its number in the view, whatever its sides, and the one that the PACS shows.
#include <QWheelEvent>
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
  void show_sides(bool radiological) {
    proxy.display().change([=](engine::DisplaySettings& settings) { settings.radiological = radiological; });
  }
  void turn_wheel() {
    const QPointF there = view.rect().center();
    QWheelEvent event(there, view.mapToGlobal(there), {}, {0, 120}, Qt::NoButton, {}, Qt::NoScrollPhase,
                      false);
    QCoreApplication::sendEvent(&view, &event);
  }
  void show_slice(double k) { show_place({5.0, 5.0, k}); }
  void show_place(glm::dvec3 voxel) {
    const glm::dvec3 place = proxy.volume().geometry.to_patient(voxel);
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

  void the_choice_of_sides_leaves_the_count_of_slices_data() {
    QTest::addColumn<ui::SlicePlane>("plane");
    QTest::newRow("axial") << ui::SlicePlane::axial;
    QTest::newRow("coronal") << ui::SlicePlane::coronal;
    QTest::newRow("sagittal") << ui::SlicePlane::sagittal;
    QTest::newRow("oblique") << ui::SlicePlane::oblique;
  }

  void the_choice_of_sides_leaves_the_count_of_slices() {
    QFETCH(ui::SlicePlane, plane);
    View one(numbered_ball(), plane);
    std::vector<std::vector<std::int64_t>> counted;
    std::vector<glm::dvec3> ends;
    for (const bool radiological : {true, false}) {
      one.show_sides(radiological);
      one.show_place({20.0, 15.0, 7.0});
      auto& numbers = counted.emplace_back();
      numbers.push_back(one.view.place().slice);
      one.turn_wheel();
      numbers.push_back(one.view.place().slice);
      QTest::keyClick(&one.view, Qt::Key_PageUp);
      numbers.push_back(one.view.place().slice);
      QVERIFY(numbers[1] == numbers[0] + 1 && numbers[2] == numbers[0] + 11);
      ends.push_back(one.proxy.display().settings().cursor_mm);
    }
    QCOMPARE(counted[1], counted[0]);
    QVERIFY(glm::distance(ends[0], ends[1]) < 1e-9);
  }

  // Left and right change places, front and back do not: also where slices were acquired across them.
  void the_choice_of_sides_mirrors_left_and_right_alone_data() {
    QTest::addColumn<bool>("is_sagittal");
    QTest::newRow("tilted") << false;
    QTest::newRow("sagittal") << true;
  }

  void the_choice_of_sides_mirrors_left_and_right_alone() {
    QFETCH(bool, is_sagittal);
    const glm::dmat3 across_sides{{0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}, {-1.0, 0.0, 0.0}};
    View one(numbered_ball(is_sagittal ? across_sides : turned(20.0)), ui::SlicePlane::oblique);
    one.view.resize(300, 300);
    const Geometry& geometry = one.proxy.volume().geometry;
    one.proxy.display().change(
        [&](engine::DisplaySettings& settings) { settings.oblique = ui::acquired_plane(geometry); });
    const glm::dvec3 place = geometry.to_patient({40.0, 30.0, 0.0});
    const QPointF radiological = one.view.position_of(place);
    one.show_sides(false);
    const QPointF neurological = one.view.position_of(place);
    const auto from_middle = [&](QPointF position) { return position.x() - 0.5 * one.view.width(); };
    QVERIFY(std::abs(from_middle(radiological)) > 5.0);
    const double expected = (is_sagittal ? 1.0 : -1.0) * from_middle(radiological);
    QVERIFY(std::abs(from_middle(neurological) - expected) < 1e-6);
    QVERIFY(std::abs(neurological.y() - radiological.y()) < 1e-6);
  }
};

TIDEMARK_TEST(SliceNumberViewTest)

}  // namespace tidemark::test::slice_number_view_test

#include "slice_number_view_test.moc"
