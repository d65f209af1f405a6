// What a stroke of the brush for labels takes in, as it is drawn.
#include "ui/views/label_drag.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/views/mark_drags.h"

namespace tidemark::test::label_drag_test {

namespace {

// With voxels ten times as wide.
std::shared_ptr<const engine::LoadedStudy> wide_ball_study() {
  auto wide = std::make_shared<engine::LoadedStudy>(*ball_study());
  auto volume = std::make_shared<Volume>(*wide->volume);
  volume->geometry.spacing_mm *= 10.0;
  wide->summary = engine::summarise(*volume);
  wide->volume = std::move(volume);
  return wide;
}

}  // namespace

class LabelDragTest : public QObject {
  Q_OBJECT

 private slots:
  void balls_are_as_wide_as_the_brush_data() {
    QTest::addColumn<double>("radius");
    QTest::newRow("narrow") << 4.0;
    QTest::newRow("wide") << 57.0;
    QTest::newRow("widest") << 151.0;
  }
  void balls_are_as_wide_as_the_brush() {
    QFETCH(double, radius);
    PanelCase wide(wide_ball_study());
    const Geometry& grid = wide.proxy->volume().geometry;
    const std::vector<glm::dvec3> moves = moves_in(grid);
    ui::LabelDrag drag(view_of(wide, radius, {}), at(moves.front()));
    for (const glm::dvec3& place : moves) drag.move(at(place));
    std::vector<glm::dvec3> middles;
    for (const glm::dvec3& place : places_of(moves, radius))
      middles.push_back(grid.to_patient(
          glm::clamp(glm::round(grid.to_voxel(place)), glm::dvec3(0.0), glm::dvec3(grid.size - Index3(1)))));
    const auto in_a_ball = [&](Index3 voxel) {
      return std::ranges::any_of(middles, [&](const glm::dvec3& middle) {
        return glm::distance(middle, grid.to_patient(glm::dvec3(voxel))) <= radius + 1e-6;
      });
    };
    QVERIFY(drawn(wide) == those_of(grid, in_a_ball));
  }

  // Move by move as all at once.
  void only_voxels_with_the_values_are_taken_in() {
    constexpr double kRadius = 6.0;
    PanelCase the_case;
    const Geometry& grid = the_case.proxy->volume().geometry;
    const engine::ValueRange values{98.0, 103.0};
    engine::LabelBrush brush;
    brush.values = values;
    the_case.proxy->display().set_label_brush(brush);
    const std::vector<glm::dvec3> moves = moves_in(grid);
    const engine::SliceSlab slab(grid, moves.front(), {0.0, 0.0, 1.0});
    ui::LabelDrag drag(view_of(the_case, kRadius, slab), at(moves.front()));
    for (const glm::dvec3& place : moves) drag.move(at(place));
    std::vector<std::int64_t> discs;
    for (const glm::dvec3& place : places_of(moves, kRadius)) {
      const auto disc = slab.disc(place, kRadius);
      discs.insert(discs.end(), disc.begin(), disc.end());
    }
    std::ranges::sort(discs);
    const Volume& source = *the_case.proxy->source();
    const Region expected = those_of(grid, [&](Index3 voxel) {
      return std::ranges::binary_search(discs, grid.offset(voxel)) && values.contains(source.value(voxel));
    });
    QVERIFY(expected.count() > 20 && static_cast<std::size_t>(expected.count()) < discs.size());
    QVERIFY(drawn(the_case) == expected);
  }

 private:
  static ui::Pointer at(glm::dvec3 place_mm) {
    ui::Pointer pointer;
    pointer.button = Qt::LeftButton;
    pointer.patient_mm = place_mm;
    return pointer;
  }
  static ui::DragView view_of(PanelCase& of, double brush_mm, std::optional<engine::SliceSlab> slab) {
    of.proxy->display().change([&](engine::DisplaySettings& settings) { settings.brush_mm = brush_mm; });
    return {*of.proxy, QSizeF(100.0, 100.0), 1.0, [](glm::dvec3) { return QPointF(); }, slab};
  }
  // From the middle to the border and along it, and back across the way.
  static std::vector<glm::dvec3> moves_in(const Geometry& grid) {
    std::vector<glm::dvec3> moves;
    for (const glm::dvec2 voxel :
         {glm::dvec2(20.0, 20.0), {27.3, 22.0}, {46.8, 30.0}, {45.0, 12.0}, {23.0, 25.0}})
      moves.push_back(grid.to_patient(glm::dvec3(voxel, 12.0)));
    return moves;
  }
  // Where discs or balls of the stroke are.
  static std::vector<glm::dvec3> places_of(const std::vector<glm::dvec3>& moves, double radius_mm) {
    std::vector<glm::dvec3> places{moves.front()};
    for (std::size_t n = 1; n < moves.size(); ++n) {
      const auto way = ui::way_between(moves[n - 1], moves[n], 0.5 * radius_mm);
      places.insert(places.end(), way.begin(), way.end());
    }
    return places;
  }
  template <class Chosen>
  static Region those_of(const Geometry& grid, const Chosen& chosen) {
    Region region(VoxelRange{Index3(0), grid.size});
    for (std::int64_t offset = 0; offset < grid.voxel_count(); ++offset) {
      if (chosen(grid.voxel_at(offset))) region.add(grid.voxel_at(offset));
    }
    return region;
  }
  static Region drawn(PanelCase& of) {
    const auto& preview = of.proxy->display().drawn_label();
    return preview ? preview->regions.front().region : Region();
  }
};

TIDEMARK_TEST(LabelDragTest)

}  // namespace tidemark::test::label_drag_test

#include "label_drag_test.moc"
