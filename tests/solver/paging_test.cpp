// Virtual memory: address translation and tables for any page shape, and what is checked of a level set.
#include <random>

#include "level_sets.h"
#include "solver/paging/page_table.h"
#include "solver/paging/validate.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::paging_test {

namespace {

constexpr Index3 kShapes[] = {{8, 8, 8}, {16, 16, 1}, {4, 4, 4}};

}  // namespace

class PagingTest : public QObject {
  Q_OBJECT

 private slots:
  void every_voxel_has_an_address_of_its_own() {
    for (const Index3 shape : kShapes) {
      for (const Index3 size : {Index3(1, 7, 61), Index3(17, 16, 5), Index3(8, 8, 8), Index3(175, 1, 3)}) {
        const solver::PageLayout layout(size, shape);
        std::vector<bool> seen(static_cast<std::size_t>(layout.page_count() * layout.voxels_per_page()));
        std::int64_t valid_voxels = 0;
        for (std::int64_t page = 0; page < layout.page_count(); ++page) {
          QCOMPARE(layout.page_number(layout.page_coordinates(page)), page);
          const Index3 valid = layout.valid_shape(page);
          valid_voxels += valid.x * valid.y * valid.z;
        }
        QCOMPARE(valid_voxels, size.x * size.y * size.z);
        for (std::int64_t z = 0; z < size.z; ++z) {
          for (std::int64_t y = 0; y < size.y; ++y) {
            for (std::int64_t x = 0; x < size.x; ++x) {
              const solver::VirtualAddress address = layout.translate({x, y, z});
              const auto index =
                  static_cast<std::size_t>(address.page * layout.voxels_per_page() + address.offset);
              QVERIFY(!seen[index]);
              seen[index] = true;
              const Index3 first = layout.first_voxel(address.page);
              QVERIFY(x - first.x < shape.x && y - first.y < shape.y && z - first.z < shape.z);
            }
          }
        }
      }
    }
  }

  void tables_stay_consistent_while_pages_come_and_go() {  // T6
    for (const Index3 shape : kShapes) {
      const solver::PageLayout layout({40, 33, 20}, shape);
      solver::PageTable table(layout);
      std::mt19937 random(3);
      std::vector<bool> resident(static_cast<std::size_t>(layout.page_count()));
      for (int change = 0; change < 3000; ++change) {
        const std::int64_t page = random() % layout.page_count();
        const auto index = static_cast<std::size_t>(page);
        if (resident[index]) {
          table.release(page, random() % 2 == 0);
        } else {
          const solver::PhysicalPage physical = table.allocate(page);
          QVERIFY(physical >= solver::kFirstPage);
          QCOMPARE(table.virtual_page(physical), page);
        }
        resident[index] = !resident[index];
        if (change % 100 == 0) QCOMPARE(failure(table.validate()), QString());
      }
      QCOMPARE(table.resident(), std::int64_t(std::count(resident.begin(), resident.end(), true)));
      // To full, and to empty.
      for (std::int64_t page = 0; page < layout.page_count(); ++page) {
        if (!resident[static_cast<std::size_t>(page)]) table.allocate(page);
      }
      QCOMPARE(table.free_count(), std::int64_t{0});
      QCOMPARE(failure(table.validate()), QString());
      for (std::int64_t page = 0; page < layout.page_count(); ++page) table.release(page, false);
      QCOMPARE(table.resident(), std::int64_t{0});
      QCOMPARE(failure(table.validate()), QString());
    }
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
