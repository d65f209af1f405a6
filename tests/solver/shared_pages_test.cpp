// Copies of a level set share the pages that have not changed, and what is measured on one holds for the
// next.
#include <algorithm>

#include "core/paging/shared_pages.h"
#include "settings.h"
#include "solver/statistics.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::shared_pages_test {

namespace {

using Kind = SharedPages::Kind;
using Pages = std::vector<std::int64_t>;

Pages differences(const SharedPages& a, const SharedPages& b) {
  Pages pages;
  SharedPages::for_each_difference(a, b, [&](std::int64_t page) { pages.push_back(page); });
  return pages;
}
Pages differences(const solver::Field& a, const solver::Field& b) {
  return differences(a.pages, b.pages);
}

// The pages whose values or kinds differ.
Pages compared(const solver::Field& a, const solver::Field& b) {
  Pages pages;
  const std::int64_t voxels = a.layout.voxels_per_page();
  for (std::int64_t page = 0; page < a.layout.page_count(); ++page) {
    const float* one = a.pages.values(page);
    const float* other = b.pages.values(page);
    const bool same =
        a.pages.kind(page) == b.pages.kind(page) && (one == nullptr || std::equal(one, one + voxels, other));
    if (!same) pages.push_back(page);
  }
  return pages;
}

void compare(const solver::SurfaceStatistics& a, const solver::SurfaceStatistics& b) {
  QCOMPARE(a.voxels_inside, b.voxels_inside);
  QVERIFY(a.volume_ml == b.volume_ml);
  QVERIFY(a.surface_mm2 == b.surface_mm2);
}

// A ball that grows into a box and rests there on one side while it goes on at the other.
struct GrowingBall {
  Geometry geometry = grid({96, 64, 56});
  std::unique_ptr<solver::Executor> level_set;

  explicit GrowingBall(const Setting& setting) {
    const auto source = volume_of(geometry, [](glm::dvec3 p) { return p.x > 14.0 ? 100.0 : 0.0; });
    solver::Parameters parameters;
    parameters.target = 100.0;
    parameters.range = 30.0;
    parameters.alpha = 0.6;
    level_set = setting.make(source, parameters);
    paint({24, 30, 28}, 12.0);
  }
  void paint(glm::dvec3 centre, double radius, solver::Brush brush = solver::Brush::add) const {
    if (const Status painted = level_set->paint({centre, radius}, brush); !painted)
      qFatal("%s", painted.error().message.c_str());
  }
  [[nodiscard]] solver::Field phi() const { return level_set->snapshot().value(); }
};

}  // namespace

class SharedPagesTest : public QObject {
  Q_OBJECT

 private slots:
  void what_is_set_in_a_copy_is_set_in_no_other() {
    SharedPages first(1000, 4);
    QCOMPARE(first.stored(), 0);
    std::fill_n(first.store(7), 4, 1.0F);
    std::fill_n(first.store(700), 4, 2.0F);
    first.set_constant(701, Kind::inside);
    QCOMPARE(first.stored_pages(), (Pages{7, 700}));
    QVERIFY(first.values(701) == nullptr);

    SharedPages second = first;
    QCOMPARE(differences(first, second), Pages{});
    second.change(7)[2] = 5.0F;
    second.set_constant(700, Kind::outside);
    std::fill_n(second.store(999), 4, 3.0F);
    QCOMPARE(differences(first, second), (Pages{7, 700, 999}));
    QCOMPARE(first.values(7)[2], 1.0F);
    QCOMPARE(second.values(7)[2], 5.0F);
    QCOMPARE(second.values(7)[3], 1.0F);
    QCOMPARE(first.kind(700), Kind::stored);
    QCOMPARE(second.kind(700), Kind::outside);
    QCOMPARE(second.stored(), 2);
    QCOMPARE(second.kind(701), Kind::inside);

    second.share(7, first);
    second.share(700, first);
    second.set_constant(999, Kind::outside);
    QCOMPARE(differences(first, second), Pages{});
    QCOMPARE(second.stored(), 2);
  }

  void copies_share_what_has_not_changed_data() { add_rows_with_host(); }
  void copies_share_what_has_not_changed() {
    const GrowingBall scene(this_row());
    const solver::Field begun = scene.phi();
    QVERIFY(begun.pages.stored() > 50);
    QCOMPARE(differences(begun, scene.phi()), Pages{});

    run(*scene.level_set, 7);
    const solver::Field evolved = scene.phi();
    QCOMPARE(differences(begun, evolved), compared(begun, evolved));
    QVERIFY(!differences(begun, evolved).empty());

    scene.paint({30, 30, 28}, 2.0, solver::Brush::erase);
    const solver::Field dabbed = scene.phi();
    const Pages below = differences(evolved, dabbed);
    QCOMPARE(below, compared(evolved, dabbed));
    QVERIFY(!below.empty() && static_cast<std::int64_t>(below.size()) < dabbed.pages.stored() / 2);

    QCOMPARE(failure(scene.level_set->restore(begun)), QString());
    QCOMPARE(differences(begun, scene.phi()), Pages{});
  }

  void resting_pages_are_copied_once() {
    // Pages of 16 x 16 x 1 reach over the whole volume from one another.
    const GrowingBall scene({solver::ExecutorKind::host, {8, 8, 8}});
    scene.paint({70, 30, 28}, 6.0);
    run_until_all_rest(*scene.level_set, 4000);
    const solver::Field resting = scene.phi();
    run(*scene.level_set, 20);
    QCOMPARE(differences(resting, scene.phi()), Pages{});
    scene.paint({60, 10, 10}, 3.0, solver::Brush::erase);
    run(*scene.level_set, 2);
    const solver::Field moving = scene.phi();
    QCOMPARE(differences(resting, moving), compared(resting, moving));
  }

  void what_is_measured_on_one_copy_holds_for_the_next_data() { add_rows_with_host(); }
  void what_is_measured_on_one_copy_holds_for_the_next() {
    const GrowingBall scene(this_row());
    solver::SurfaceMeter meter;
    const auto check = [&] {
      const solver::Field phi = scene.phi();
      compare(meter.measure(phi), solver::measure(phi));
    };
    check();
    for (int turn = 0; turn < 6; ++turn) {
      run(*scene.level_set, 5);
      check();
      scene.paint({20.0 + 9.0 * turn, 25, 30}, 5.0,
                  turn % 2 == 0 ? solver::Brush::erase : solver::Brush::add);
      check();
    }
    // All of it goes, and comes back.
    scene.paint({48, 32, 28}, 200.0, solver::Brush::erase);
    check();
    QCOMPARE(meter.measure(scene.phi()).voxels_inside, 0);
    scene.paint({48, 32, 28}, 200.0);
    check();
    scene.paint({48, 32, 28}, 9.0, solver::Brush::erase);
    check();
  }
};

TIDEMARK_TEST(SharedPagesTest)

}  // namespace tidemark::test::shared_pages_test

#include "shared_pages_test.moc"
