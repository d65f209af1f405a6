// Virtual memory: address translation, tables and fields for any page shape in 2, 3 and 4 dimensions, and
// what is checked of a level set.
#include <algorithm>
#include <glm/geometric.hpp>
#include <map>
#include <random>
#include <set>

#include "level_sets.h"
#include "solver/inside_region.h"
#include "solver/paging/paged_memory.h"
#include "solver/paging/validate.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::paging_test {

namespace {

constexpr Index3 kShapes[] = {{8, 8, 8}, {16, 16, 1}, {4, 4, 4}};

template <int kDimensions>
std::int64_t volume(Index<kDimensions> sizes) {
  std::int64_t result = 1;
  for (int axis = 0; axis < kDimensions; ++axis) result *= sizes[axis];
  return result;
}

// The voxel of that number in voxel order.
template <int kDimensions>
Index<kDimensions> voxel_at(Index<kDimensions> size, std::int64_t number) {
  Index<kDimensions> voxel;
  for (int axis = 0; axis < kDimensions; ++axis) {
    voxel[axis] = number % size[axis];
    number /= size[axis];
  }
  return voxel;
}

template <int kDimensions>
void check_addresses(Index<kDimensions> size, Index<kDimensions> shape) {
  const BasicPageLayout<kDimensions> layout(size, shape);
  QCOMPARE(layout.voxels_per_page(), volume<kDimensions>(shape));
  std::int64_t valid_voxels = 0;
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    QCOMPARE(layout.page_number(layout.page_coordinates(page)), page);
    QVERIFY(layout.contains_page(layout.page_coordinates(page)));
    valid_voxels += volume<kDimensions>(layout.valid_shape(page));
  }
  QCOMPARE(valid_voxels, volume<kDimensions>(size));
  QVERIFY(!layout.contains_page(layout.pages()));
  std::vector<bool> seen(static_cast<std::size_t>(layout.page_count() * layout.voxels_per_page()));
  for (std::int64_t number = 0; number < valid_voxels; ++number) {
    const Index<kDimensions> voxel = voxel_at<kDimensions>(size, number);
    const VirtualAddress address = layout.translate(voxel);
    const auto index = static_cast<std::size_t>(address.page * layout.voxels_per_page() + address.offset);
    QVERIFY(!seen[index]);
    seen[index] = true;
    QCOMPARE(voxel_at<kDimensions>(shape, address.offset) + layout.first_voxel(address.page), voxel);
  }
}

// Pages come, go and are written to at random: all fields hold what was written last, and elsewhere the
// constants.
template <int kDimensions>
void check_memory(Index<kDimensions> size, Index<kDimensions> shape) {
  const BasicPageLayout<kDimensions> layout(size, shape);
  solver::PagedMemory<kDimensions> memory(layout, solver::kUnlimited);
  const auto phi = memory.template attach<float>(2);
  const auto speed = memory.template attach<std::int16_t>();
  const auto steps = memory.template attach<int, 1>();
  for (const bool inside : {false, true}) {
    const solver::PhysicalPage page = inside ? solver::kInsidePage : solver::kOutsidePage;
    phi.fill(page, inside ? 2.5F : -2.5F);
    speed.fill(page, inside ? 1 : -1);
  }
  const std::int64_t voxels = volume<kDimensions>(size);
  std::vector<float> wanted_phi[2];
  for (auto& buffer : wanted_phi) buffer.assign(static_cast<std::size_t>(voxels), -2.5F);
  std::vector<std::int16_t> wanted_speed(static_cast<std::size_t>(voxels), -1);
  std::map<std::int64_t, int> wanted_steps;  // of the resident pages
  std::set<std::int64_t> changed;
  memory.announce_changes();
  std::mt19937 random(3);
  const auto fill_wanted = [&](std::int64_t page, bool inside) {
    for (std::int64_t number = 0; number < voxels; ++number) {
      if (layout.translate(voxel_at<kDimensions>(size, number)).page != page) continue;
      for (auto& buffer : wanted_phi) buffer[static_cast<std::size_t>(number)] = inside ? 2.5F : -2.5F;
      wanted_speed[static_cast<std::size_t>(number)] = inside ? 1 : -1;
    }
  };
  const auto everything_is_there = [&] {
    for (std::int64_t number = 0; number < voxels; ++number) {
      const auto at = memory.translate(voxel_at<kDimensions>(size, number));
      const auto i = static_cast<std::size_t>(number);
      if (phi.values(at.page, 0)[at.offset] != wanted_phi[0][i] ||
          phi.values(at.page, 1)[at.offset] != wanted_phi[1][i] ||
          speed.values(at.page)[at.offset] != wanted_speed[i])
        return false;
    }
    return std::all_of(wanted_steps.begin(), wanted_steps.end(), [&](const auto& wanted) {
      return steps[memory.physical(wanted.first)] == wanted.second;
    });
  };
  std::set<std::int64_t> changed_since;  // what one who looks now and then has not seen
  auto moment = memory.end_moment();
  for (int change = 0; change < 1500; ++change) {
    const std::int64_t number = static_cast<std::int64_t>(random()) % voxels;
    const Index<kDimensions> voxel = voxel_at<kDimensions>(size, number);
    const std::int64_t page = layout.translate(voxel).page;
    const solver::PhysicalPage before = memory.physical(page);
    QCOMPARE(memory.physical(layout.page_coordinates(page)), before);
    changed.insert(page);
    changed_since.insert(page);
    if (solver::is_static_page(before) && random() % 4 == 0) {
      memory.set_static(page, random() % 2 == 0);
      fill_wanted(page, memory.physical(page) == solver::kInsidePage);
    } else if (!solver::is_static_page(before) && random() % 4 == 0) {
      memory.release(page, random() % 2 == 0);
      wanted_steps.erase(page);
      fill_wanted(page, memory.physical(page) == solver::kInsidePage);
    } else {
      if (solver::is_static_page(before)) {
        const solver::PhysicalPage made = memory.make_resident(page).value();
        QVERIFY(made >= solver::kFirstPage);
        QCOMPARE(memory.virtual_page(made), page);
        phi.fill(made, *phi.values(before));
        speed.fill(made, *speed.values(before));
        steps[made] = 0;
      }
      const auto at = memory.translate(voxel);
      const auto i = static_cast<std::size_t>(number);
      const int buffer = change % 2;
      phi.values(at.page, buffer)[at.offset] = wanted_phi[buffer][i] = static_cast<float>(change);
      speed.values(at.page)[at.offset] = wanted_speed[i] = static_cast<std::int16_t>(change);
      ++steps[at.page];
      ++wanted_steps[page];
      memory.note_change(page);
    }
    if ((change + 1) % 70 == 0) {
      for (std::int64_t it = 0; it < layout.page_count(); ++it) {
        QCOMPARE(memory.has_changed_since(it, moment), changed_since.contains(it));
      }
      changed_since.clear();
      moment = memory.end_moment();
    }
    if ((change + 1) % 250 != 0) continue;
    QVERIFY(everything_is_there());
    QCOMPARE(failure(memory.table().validate()), QString());
    std::set<std::int64_t> announced;
    memory.take_changes([&](std::int64_t it) { announced.insert(it); });
    QVERIFY(announced == changed);
    changed.clear();
  }
  // Whoever knows another memory alone, whose time has passed, finds everything changed.
  solver::PagedMemory<kDimensions> newer(layout, std::int64_t{1} << 30);
  newer.announce_changes();
  QVERIFY(newer.has_changed_since(0, moment) && newer.has_changed_since(layout.page_count() - 1, moment));
  // To full, and to empty.
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    if (solver::is_static_page(memory.physical(page))) QVERIFY(memory.make_resident(page));
  }
  QCOMPARE(memory.table().resident(), layout.page_count());
  QCOMPARE(memory.table().free_count(), std::int64_t{0});
  QCOMPARE(memory.peak_resident(), layout.page_count());
  QCOMPARE(failure(memory.table().validate()), QString());
  for (std::int64_t page = 0; page < layout.page_count(); ++page) memory.release(page, false);
  QCOMPARE(memory.table().resident(), std::int64_t{0});
  QCOMPARE(failure(memory.table().validate()), QString());
}

}  // namespace

class PagingTest : public QObject {
  Q_OBJECT

 private slots:
  void every_voxel_has_an_address_of_its_own() {
    for (const Index3 shape : kShapes) {
      for (const Index3 size : {Index3(1, 7, 61), Index3(17, 16, 5), Index3(8, 8, 8), Index3(175, 1, 3)}) {
        check_addresses<3>(size, shape);
      }
    }
    for (const Index<2> size : {Index<2>(1, 61), Index<2>(37, 16)}) {
      check_addresses<2>(size, {16, 16});
      check_addresses<2>(size, {5, 3});
    }
    check_addresses<4>({9, 8, 7, 5}, {4, 4, 4, 2});
    check_addresses<4>({1, 17, 3, 2}, {8, 8, 1, 1});
  }

  void memory_holds_what_was_written_in_2_3_and_4_dimensions() {  // T6
    for (const Index3 shape : kShapes) check_memory<3>({40, 33, 20}, shape);
    check_memory<2>({200, 133}, {16, 16});
    check_memory<4>({20, 17, 9, 6}, {8, 8, 4, 2});
  }

  void memory_keeps_its_budget() {
    constexpr std::int64_t kPages = 20;
    const BasicPageLayout<2> layout({160, 160}, {16, 16});
    // What so many pages need, told by a memory without a budget.
    solver::PagedMemory<2> free(layout, solver::kUnlimited);
    const auto its_field = free.attach<float>(2);
    QCOMPARE(its_field.page_bytes(), std::int64_t{2 * 256 * 4});
    for (std::int64_t page = 0; page < kPages; ++page) QVERIFY(free.make_resident(page));
    QCOMPARE(free.field_bytes(), (kPages + solver::kFirstPage) * its_field.page_bytes());
    const std::int64_t budget = free.field_bytes() + free.table_bytes() + 64 * (kPages + solver::kFirstPage);

    solver::PagedMemory<2> memory(layout, budget);
    auto field = memory.attach<float>(2);
    std::int64_t page = 0;
    auto made = memory.make_resident(page);
    while (made && page + 1 < layout.page_count()) made = memory.make_resident(++page);
    QVERIFY(!made && made.error().kind == ErrorKind::capability);
    QVERIFY(std::abs(page - kPages) <= 1);
    QCOMPARE(memory.physical(page), solver::kOutsidePage);  // nothing has changed
    QCOMPARE(failure(memory.table().validate()), QString());
    // A page that was given back can be had again, and a field that was detached makes room.
    memory.release(0, true);
    QVERIFY(memory.make_resident(page));
    memory.detach(field);
    QVERIFY(!field.is_attached());
    QVERIFY(memory.make_resident(0));
  }

  void a_field_is_the_same_in_every_layout() {
    const Geometry geometry = grid({37, 22, 19});
    const auto values = sample(geometry, [&](glm::dvec3 p) {
      return std::clamp(7.0 - glm::distance(p, centre_of(geometry)), -2.5, 2.5);
    });
    for (const Index3 shape : kShapes) {
      const solver::Field field = solver::Field::from_dense(geometry, values, 2.5, shape);
      QCOMPARE(field.dense(), values);
      QVERIFY(field.pages.stored() > 0);
      QVERIFY(field.pages.stored() < field.layout.page_count());
      QCOMPARE(field.mask().count(),
               std::int64_t(std::count_if(values.begin(), values.end(), [](float v) { return v > 0; })));
    }
  }

  void a_field_moves_from_page_to_page_and_band_to_band() {
    const Geometry geometry = grid({37, 22, 19});
    const auto values = sample(geometry, [&](glm::dvec3 p) {
      return std::clamp(7.0 - glm::distance(p, centre_of(geometry)), -2.5, 2.5);
    });
    std::vector<float> wider = values;  // what is as far away as a band reaches stays so
    for (float& phi : wider) phi = std::abs(phi) == 2.5F ? std::copysign(4.0F, phi) : phi;
    for (const Index3 from : kShapes) {
      const solver::Field field = solver::Field::from_dense(geometry, values, 2.5, from);
      for (const Index3 to : kShapes) {
        for (const double band : {1.25, 2.5, 4.0}) {
          const solver::Field made = field.repaged(band, to);
          const solver::Field wanted =
              solver::Field::from_dense(geometry, band > 2.5 ? wider : values, band, to);
          QCOMPARE(made.band, band);
          QVERIFY(made.layout == wanted.layout);
          QVERIFY(made.pages.stored_pages() == wanted.pages.stored_pages());
          QVERIFY(made.dense() == wanted.dense());
        }
      }
    }
  }

  // Executors look for the surface on stored pages alone.
  void a_surface_between_two_pages_is_on_one_of_them() {
    const Geometry geometry = grid({32, 32, 20}, {1.0, 1.0, 5.0});
    const auto values =
        sample(geometry, [](glm::dvec3 p) { return p.z < 57.5 ? 2.0 : -2.0; });  // after slice 11
    const solver::Field field = solver::Field::from_dense(geometry, values, 2.0, {8, 8, 8});
    for (const Index3 shape : kShapes) {
      const solver::Field made = field.repaged(2.0, shape);
      QVERIFY(made.dense() == values);
      QVERIFY(made.pages.stored() > 0);
      const solver::Field wanted = solver::Field::from_dense(geometry, values, 2.0, shape);
      QVERIFY(made.pages.stored_pages() == wanted.pages.stored_pages());
    }
  }

  // The box of the inside does not depend on pages: a ball with whole pages in it, and voxels far from it.
  void the_inside_has_the_same_bounds_in_pages_of_any_shape() {
    const Geometry geometry = grid({67, 58, 49});
    const auto with = [&](const std::vector<glm::dvec3>& alone, double radius) {
      return sample(geometry, [&](glm::dvec3 p) {
        const bool is_alone = std::find(alone.begin(), alone.end(), p) != alone.end();
        return is_alone ? 0.5 : std::clamp(radius - glm::distance(p, {30.0, 27.0, 25.0}), -2.5, 2.5);
      });
    };
    const std::pair<std::vector<float>, VoxelRange> cases[] = {
        {with({}, 20.5), {{10, 7, 5}, {51, 48, 46}}},
        {with({{66, 20, 25}, {30, 0, 25}}, 20.5), {{10, 0, 5}, {67, 48, 46}}},
        {with({{3, 4, 48}}, 0.0), {{3, 4, 48}, {4, 5, 49}}},
        {with({}, 0.0), {}},
        {with({}, 100.0), {{0, 0, 0}, {67, 58, 49}}}};
    for (const Index3 shape : kShapes) {
      for (const auto& [values, wanted] : cases) {
        const solver::Field phi = solver::Field::from_dense(geometry, values, 2.5, shape);
        QVERIFY(solver::inside_bounds(phi) == wanted);
        QVERIFY(solver::inside_region(phi).bounds() == wanted);
        QCOMPARE(solver::inside_region(phi).count(),
                 std::count_if(values.begin(), values.end(), [](float value) { return value > 0.0F; }));
      }
    }
  }

  // A box of whole pages: no page has voxels on both sides of its surface.
  void a_surface_between_pages_is_found() {
    const Index3 page = kDefaultPageShape;
    const Geometry geometry = grid(Index3(3) * page);
    const auto values = sample(geometry, [&](glm::dvec3 p) {
      return glm::all(glm::greaterThanEqual(p, glm::dvec3(page))) &&
                     glm::all(glm::lessThan(p, glm::dvec3(2) * glm::dvec3(page)))
                 ? 2.5
                 : -2.5;
    });
    const solver::Field box = solver::Field::from_dense(geometry, values, 2.5);
    QVERIFY(box.dense() == values);
    solver::Parameters curvature;
    curvature.data_term = false;
    curvature.alpha = 1.0;
    std::vector<std::vector<float>> after;
    for (const auto kind : {solver::ExecutorKind::reference, solver::ExecutorKind::host}) {
      const auto level_set = executor(kind, zero_volume(geometry), curvature);
      QCOMPARE(failure(level_set->restore(box)), QString());
      QVERIFY(level_set->advance({50}));
      after.push_back(level_set->snapshot().value().dense());
    }
    QVERIFY(after[0] != values);
    double largest = 0.0;
    for (std::size_t v = 0; v < values.size(); ++v)
      largest = std::max(largest, std::abs(double{after[0][v]} - after[1][v]));
    QVERIFY2(largest < 1e-3, qPrintable(QString::number(largest)));
  }

  void validate_finds_what_is_broken() {
    const Geometry geometry = grid({32, 32, 32});
    const auto values = sample(geometry, [&](glm::dvec3 p) {
      return std::clamp(9.0 - glm::distance(p, centre_of(geometry)), -2.5, 2.5);
    });
    const auto level_set = executor(solver::ExecutorKind::host, zero_volume(geometry), solver::Parameters());
    QVERIFY(level_set->restore(solver::Field::from_dense(geometry, values, 2.5)));
    const solver::Field field = level_set->snapshot().value();
    QCOMPARE(failure(validate(field)), QString());
    solver::Field broken = field;
    const std::int64_t page = field.pages.stored_pages().front();
    broken.pages.change(page)[100] = std::numeric_limits<float>::quiet_NaN();
    QVERIFY(!validate(broken));
    broken = field;
    broken.pages.change(page)[100] = 2.6F;
    QVERIFY(!validate(broken));
    broken = field;  // a resident page dropped although its neighbours are not flat
    broken.pages.set_constant(field.layout.translate({16, 16, 8}).page, solver::Field::Kind::outside);
    QVERIFY(!validate(broken));
  }
};

TIDEMARK_TEST(PagingTest)

}  // namespace tidemark::test::paging_test

#include "paging_test.moc"
