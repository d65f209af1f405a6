// Painting and erasing while the surface moves, voxel by voxel.
#include "settings.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::editing_test {

namespace {

// D = 1 where x < 24 and -1 beyond, in a volume of 48 x 40 x 32 voxels; the surface has nothing else to obey.
struct TwoHalves {
  static constexpr double kBorder = 23.5;

  Geometry geometry = grid({48, 40, 32});
  std::shared_ptr<const Volume> source =
      volume_of(geometry, [](glm::dvec3 p) { return p.x < kBorder ? 100.0 : 0.0; });
  solver::Parameters parameters = [] {
    solver::Parameters p;
    p.target = 100.0;
    p.range = 20.0;
    p.alpha = 1.0;
    return p;
  }();

  // Calls visit(voxel) for each within the sphere.
  void for_each_voxel(const solver::Sphere& sphere, const std::function<void(Index3)>& visit) const {
    for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
      const Index3 v(i % 48, i / 48 % 40, i / (48 * 40));
      if (glm::distance(geometry.to_patient(v), sphere.centre_mm) < sphere.radius_mm) visit(v);
    }
  }
};

}  // namespace

class EditingTest : public QObject {
  Q_OBJECT

 private slots:
  void what_is_erased_while_it_plays_stays_out_where_nothing_attracts_data() { add_all_rows(); }
  void what_is_erased_while_it_plays_stays_out_where_nothing_attracts() {
    const Setting setting = this_row();
    const TwoHalves scene;
    const auto level_set = setting.make(scene.source, scene.parameters);
    // Half of it lies where D is -1, and goes back from its rim while it is erased.
    QCOMPARE(failure(level_set->paint({{23.5, 19.5, 15.5}, 13.0}, solver::Brush::add)), QString());
    const solver::Sphere erased{{24.5, 19.5, 15.5}, 6.0};
    run(*level_set, 7);
    int there = 0;
    solver::Field phi = level_set->snapshot().value();
    scene.for_each_voxel(erased, [&](Index3 v) { there += phi.at(v) > 0.0F ? 1 : 0; });
    QVERIFY(there > 700);
    QCOMPARE(failure(level_set->paint(erased, solver::Brush::erase)), QString());
    for (const int steps : {0, 1, 2, 5, 12, 30}) {
      run(*level_set, steps);
      phi = level_set->snapshot().value();
      int back = 0;
      scene.for_each_voxel(erased, [&](Index3 v) {
        // The front stands half a voxel off the border at most.
        const bool attracts = static_cast<double>(v.x) < TwoHalves::kBorder + 1.0;
        if (phi.at(v) > 0.0F && (steps == 0 || !attracts)) ++back;
      });
      QVERIFY2(back == 0, qPrintable(QString("%1 voxels are back after %2 steps").arg(back).arg(steps)));
      QCOMPARE(failure(level_set->validate()), QString());
    }
    // Where D is 1 it has grown again: it played.
    int grown = 0;
    int attracting = 0;
    scene.for_each_voxel(erased, [&](Index3 v) {
      if (static_cast<double>(v.x) > TwoHalves::kBorder - 1.0) return;
      ++attracting;
      grown += phi.at(v) > 0.0F ? 1 : 0;
    });
    QVERIFY2(grown > attracting * 9 / 10, qPrintable(QString("%1 of %2").arg(grown).arg(attracting)));
  }

  void what_is_added_while_it_plays_grows_where_D_attracts_and_goes_elsewhere_data() { add_all_rows(); }
  void what_is_added_while_it_plays_grows_where_D_attracts_and_goes_elsewhere() {
    const Setting setting = this_row();
    const TwoHalves scene;
    const auto level_set = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(level_set->paint({{6.0, 6.0, 6.0}, 4.0}, solver::Brush::add)), QString());
    run(*level_set, 9);
    const solver::Sphere added[] = {{{12.0, 28.0, 20.0}, 4.0}, {{38.0, 20.0, 14.0}, 4.0}};
    for (const solver::Sphere& sphere : added)
      QCOMPARE(failure(level_set->paint(sphere, solver::Brush::add)), QString());
    const auto inside = [&](const solver::Sphere& sphere) {
      const solver::Field phi = level_set->snapshot().value();
      int count = 0;
      int all = 0;
      scene.for_each_voxel(sphere, [&](Index3 v) {
        ++all;
        count += phi.at(v) > 0.0F ? 1 : 0;
      });
      return std::pair(count, all);
    };
    for (const solver::Sphere& sphere : added) QCOMPARE(inside(sphere).first, inside(sphere).second);
    run(*level_set, 20);
    const solver::Sphere larger{added[0].centre_mm, 7.0};
    QCOMPARE(inside(larger).first, inside(larger).second);
    QCOMPARE(inside(added[1]).first, 0);
    QCOMPARE(failure(level_set->validate()), QString());
  }
};

TIDEMARK_TEST(EditingTest)

}  // namespace tidemark::test::editing_test

#include "editing_test.moc"
