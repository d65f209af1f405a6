// phi and brightness along a line, of fields that are linear along it.
#include "solver/line_profile.h"

#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::line_profile_test {

class LineProfileTest : public QObject {
  Q_OBJECT

  Geometry grid_{{20, 12, 8}, {0.5, 1.0, 2.0}, glm::dmat3(1.0), {10.0, 0.0, -4.0}};
  Volume source_;
  solver::Field phi_;

 private slots:
  // phi falls by one smallest spacing a voxel along x, and the value rises by 10.
  void initTestCase() {
    std::vector<float> phi;
    std::vector<float> values;
    for (std::int64_t offset = 0; offset < grid_.voxel_count(); ++offset) {
      const auto x = static_cast<float>(grid_.voxel_at(offset).x);
      phi.push_back(std::clamp(8.25F - x, -2.5F, 2.5F));
      values.push_back(10.0F * x);
    }
    phi_ = solver::Field::from_dense(grid_, phi, 2.5);
    source_.geometry = grid_;
    source_.voxels = values;
  }

  void values_lie_between_voxels_and_the_crossing_where_phi_is_0() {
    const auto profile = solver::line_profile(phi_, source_, {10.0, 4.5, 3.0}, {19.5, 4.5, 3.0}, 77);
    QCOMPARE(profile.points.size(), std::size_t{77});
    for (const solver::ProfilePoint& point : profile.points) {
      QVERIFY(std::abs(point.value - 20.0 * point.at_mm) < 1e-4);
      QVERIFY(std::abs(point.phi - std::clamp(8.25 - 2.0 * point.at_mm, -2.5, 2.5)) < 0.26);
    }
    QCOMPARE(profile.crossings_mm.size(), std::size_t{1});
    QVERIFY(std::abs(profile.crossings_mm[0] - 4.125) < 1e-5);
  }

  void what_is_outside_is_left_out() {
    // To the faces of the outer voxels, at 9.75 and 19.75.
    const auto profile = solver::line_profile(phi_, source_, {5.1, 4.5, 3.0}, {25.1, 4.5, 3.0}, 81);
    QCOMPARE(profile.points.front().at_mm, 4.75);
    QCOMPARE(profile.points.back().at_mm, 14.5);
    QVERIFY(std::abs(profile.crossings_mm[0] - 9.025) < 1e-5);
    QVERIFY(solver::line_profile(phi_, source_, {0.0, 50.0, 0.0}, {9.0, 50.0, 0.0}, 9).points.empty());
  }

  // Slices reached by steps of the wheel lie a rounding beside those of the grid.
  void the_outer_slices_have_values_to_their_faces() {
    const auto along = [&](double slice) {
      const double z = grid_.origin_mm.z + slice * grid_.spacing_mm.z;
      return solver::line_profile(phi_, source_, {10.25, 4.5, z}, {19.25, 4.5, z}, 73);
    };
    const auto inner = along(3.0);
    QCOMPARE(inner.points.size(), std::size_t{73});
    for (const double slice : {-4e-14, -0.3, 7.0 + 4e-14, 7.3}) {
      const auto outer = along(slice);
      QCOMPARE(outer.points.size(), inner.points.size());
      for (std::size_t n = 0; n < inner.points.size(); ++n) {
        QVERIFY(std::abs(outer.points[n].value - inner.points[n].value) < 1e-4);
        QVERIFY(std::abs(outer.points[n].phi - inner.points[n].phi) < 1e-6);
      }
      QCOMPARE(outer.crossings_mm.size(), std::size_t{1});
    }
    for (const double slice : {-0.6, 7.6}) QVERIFY(along(slice).points.empty());
  }

  void a_line_along_the_surface_has_no_crossing() {
    const auto profile = solver::line_profile(phi_, source_, {12.0, 0.0, 0.0}, {12.0, 10.0, 0.0}, 30);
    QVERIFY(profile.crossings_mm.empty());
    QVERIFY(std::abs(profile.points.front().phi - 2.5) < 1e-6);
  }
};

TIDEMARK_TEST(LineProfileTest)

}  // namespace tidemark::test::line_profile_test

#include "line_profile_test.moc"
