// Virtual memory: address translation and tables for any page shape; pages that come and go (T6, T6b).
#include <random>

#include "level_sets.h"
#include "solver/paging/page_table.h"
#include "solver/paging/validate.h"
#include "solver/reference/reference_executor.h"
#include "tests/support/support.h"

using namespace tidemark;
using namespace tidemark::test;

namespace {

constexpr Index3 kShapes[] = {{8, 8, 8}, {16, 16, 1}, {4, 4, 4}};

}  // namespace

class PagingTest : public QObject {
  Q_OBJECT

 private slots:
  void every_voxel_has_an_address_of_its_own() {
    for (const Index3 shape : kShapes) {
      for (const Index3 size : {Index3(1, 7, 61), Index3(17, 16, 5), Index3(8, 8, 8), Index3(175, 1, 3)}) {
        const PageLayout layout(size, shape);
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
              const VirtualAddress address = layout.translate({x, y, z});
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
      const PageLayout layout({40, 33, 20}, shape);
      PageTable table(layout);
      std::mt19937 random(3);
      std::vector<bool> resident(static_cast<std::size_t>(layout.page_count()));
      for (int change = 0; change < 3000; ++change) {
        const std::int64_t page = random() % layout.page_count();
        const auto index = static_cast<std::size_t>(page);
        if (resident[index]) {
          table.release(page, random() % 2 == 0);
        } else {
          const PhysicalPage physical = table.allocate(page);
          QVERIFY(physical >= kFirstPage);
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
      const Field field = Field::from_dense(geometry, values, 2.5, shape);
      QCOMPARE(field.dense(), values);
      QVERIFY(field.resident_pages() > 0);
      QVERIFY(field.resident_pages() < field.layout.page_count());
      QCOMPARE(field.mask().count(),
               std::int64_t(std::count_if(values.begin(), values.end(), [](float v) { return v > 0; })));
    }
  }

  void validate_finds_what_is_broken() {
    const Geometry geometry = grid({32, 32, 32});
    const auto values = sample(geometry, [&](glm::dvec3 p) {
      return std::clamp(9.0 - glm::distance(p, centre_of(geometry)), -2.5, 2.5);
    });
    const auto level_set = executor(ExecutorKind::host, zero_volume(geometry), Parameters());
    QVERIFY(level_set->restore(Field::from_dense(geometry, values, 2.5)));
    const Field field = level_set->snapshot().value();
    QCOMPARE(failure(validate(field)), QString());
    Field broken = field;
    broken.pages[100] = std::numeric_limits<float>::quiet_NaN();
    QVERIFY(!validate(broken));
    broken = field;
    broken.pages[100] = 2.6F;
    QVERIFY(!validate(broken));
    broken = field;  // a resident page dropped although its neighbours are not flat
    broken.table[static_cast<std::size_t>(field.layout.translate({16, 16, 8}).page)] = Field::kOutside;
    QVERIFY(!validate(broken));
  }

  void painting_and_erasing_leak_no_page() {  // T6
    const Geometry geometry = grid({90, 70, 50});
    const auto source = volume_of(geometry, [](glm::dvec3 p) { return 100.0 + 40.0 * std::sin(p.x / 4.0); });
    Parameters parameters;
    parameters.target = 100.0;
    parameters.range = 30.0;
    const auto level_set = executor(ExecutorKind::host, source, parameters);
    std::mt19937 random(5);
    for (int edit = 0; edit < 120; ++edit) {
      const glm::dvec3 voxel(random() % 90, random() % 70, random() % 50);
      const double radius = 1.0 + random() % 14;
      QVERIFY(level_set->paint(sphere_at_voxel(geometry, voxel, radius),
                               random() % 3 == 0 ? Brush::erase : Brush::add));
      run(*level_set, random() % 4);
      QCOMPARE(failure(level_set->validate()), QString());
    }
    const std::int64_t peak = level_set->memory().peak_resident_pages;
    QVERIFY(peak > 200);
    // Erasing everything gives every page back.
    QVERIFY(level_set->paint(sphere_at_voxel(geometry, {45, 35, 25}, 100.0), Brush::erase));
    run(*level_set, 8);
    QCOMPARE(level_set->memory().resident_pages, std::int64_t{0});
    QCOMPARE(failure(level_set->validate()), QString());
    // And filling everything leaves nothing to compute.
    QVERIFY(level_set->paint(sphere_at_voxel(geometry, {45, 35, 25}, 100.0), Brush::add));
    QCOMPARE(level_set->snapshot().value().mask().count(), geometry.voxel_count());
    QCOMPARE(failure(level_set->validate()), QString());
  }

  void painting_is_the_same_as_in_the_reference() {
    const Geometry geometry = grid({30, 26, 22}, {0.7, 0.9, 1.8});
    const auto source = zero_volume(geometry);
    const auto host = executor(ExecutorKind::host, source, Parameters());
    ReferenceExecutor reference(source, Parameters());
    std::mt19937 random(11);
    for (int edit = 0; edit < 20; ++edit) {
      const glm::dvec3 voxel(random() % 30, random() % 26, random() % 22);
      const Sphere sphere = sphere_at_voxel(geometry, voxel, 1.0 + random() % 8);
      const Brush brush = edit % 3 == 2 ? Brush::erase : Brush::add;
      QVERIFY(host->paint(sphere, brush));
      QVERIFY(reference.paint(sphere, brush));
    }
    const std::vector<float> phi = host->snapshot().value().dense();
    for (std::size_t i = 0; i < phi.size(); ++i) {
      QVERIFY(std::abs(static_cast<double>(phi[i]) - reference.values()[i]) < 1e-5);
    }
  }

  void the_budget_stops_the_run_and_keeps_what_was_computed() {  // T6
    const Geometry geometry = grid({96, 96, 96});
    const auto source = zero_volume(geometry);
    Parameters parameters;
    parameters.alpha = 1.0;
    ExecutorOptions small;
    small.memory_budget_bytes = 3 << 20;
    const auto limited = executor(ExecutorKind::host, source, parameters, small);
    const auto unlimited = executor(ExecutorKind::host, source, parameters);
    const Sphere sphere{centre_of(geometry), 6.0};
    QVERIFY(limited->paint(sphere, Brush::add));
    QVERIFY(unlimited->paint(sphere, Brush::add));
    int steps = 0;
    for (;; ++steps) {
      QVERIFY(steps < 500);
      run(*unlimited, 1);
      const auto report = limited->advance({});
      if (report) continue;
      QCOMPARE(report.error().kind, ErrorKind::capability);
      QVERIFY(report.error().message.find("budget is 3 MB") != std::string::npos);
      break;
    }
    QVERIFY(steps > 20);
    QCOMPARE(limited->snapshot().value().dense(), unlimited->snapshot().value().dense());
    QVERIFY(limited->memory().state_bytes + limited->memory().source_bytes <= small.memory_budget_bytes);
    // It goes on when the surface needs less.
    QVERIFY(limited->paint({centre_of(geometry), 100.0}, Brush::erase));
    run(*limited, 5);
    QCOMPARE(limited->memory().resident_pages, std::int64_t{0});
  }

  void padding_is_never_counted() {  // T6b
    for (const std::int64_t n : {1, 7, 61, 175}) {
      for (int axis = 0; axis < 3; ++axis) {
        Index3 size(13, 10, 9);
        size[axis] = n;
        const Geometry geometry = grid(size);
        const auto source =
            volume_of(geometry, [](glm::dvec3 p) { return 10.0 * std::sin(p.x + p.y * 2 + p.z); });
        Parameters parameters;
        parameters.range = 5.0;
        ExecutorOptions options;
        options.skip_quiet_pages = false;
        const auto host = executor(ExecutorKind::host, source, parameters, options);
        ReferenceExecutor reference(source, parameters);
        QVERIFY(host->paint({centre_of(geometry), 4.0}, Brush::add));
        for (int step = 0; step < 6; ++step) {
          QVERIFY(reference.restore(host->snapshot().value()));
          const AdvanceReport report = run(*host, 1);
          QVERIFY(reference.advance({}));
          QVERIFY(report.voxel_updates <= geometry.voxel_count());
          const std::vector<float> phi = host->snapshot().value().dense();
          for (std::size_t i = 0; i < phi.size(); ++i) {
            QVERIFY(std::abs(static_cast<double>(phi[i]) - reference.values()[i]) < 1e-5);
          }
          QCOMPARE(failure(host->validate()), QString());
        }
      }
    }
  }

  void memory_follows_the_surface() {
    const Geometry geometry = grid({128, 128, 128});
    const auto level_set = executor(ExecutorKind::host, zero_volume(geometry), Parameters());
    QVERIFY(level_set->paint({centre_of(geometry), 40.0}, Brush::add));
    const MemoryReport memory = level_set->memory();
    const double bytes =
        static_cast<double>(memory.peak_state_bytes) / static_cast<double>(memory.peak_resident_pages * 512);
    qInfo("%.2f bytes of state per resident voxel, %lld pages", bytes,
          static_cast<long long>(memory.resident_pages));
    QVERIFY(bytes <= 10.0);
  }
};

QTEST_APPLESS_MAIN(PagingTest)
#include "paging_test.moc"
