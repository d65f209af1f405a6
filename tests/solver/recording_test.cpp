// The record of a page's step is what the step does, and changes nothing.
#include <algorithm>
#include <glm/common.hpp>
#include <set>
#include <utility>

#include "balance_check.h"
#include "gpu/device.h"
#include "level_sets.h"
#include "solver/executor.h"
#include "solver/paging/page_neighbours.h"
#include "solver/stream/pass_record.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::recording_test {

using solver::PassRecord;

namespace {

template <class T>
T good(Result<T> result) {
  if (!result) qFatal("%s", result.error().message.c_str());
  return std::move(*result);
}

// A lumpy ball in a volume whose last pages are cut off by the border.
struct Scene {
  Geometry geometry = grid({52, 40, 24}, {1.0, 1.0, 1.3});
  std::shared_ptr<const Volume> source = volume_of(geometry, [this](glm::dvec3 p) {
    const double r = glm::distance(p, centre_of(geometry));
    return 100.0 - 6.0 * std::max(0.0, r - 10.0 - 2.0 * std::sin(p.x / 3.0)) + 5.0 * std::sin(p.y * 7.0);
  });
  solver::Parameters parameters;

  explicit Scene(solver::Scheme scheme = solver::Scheme::split) {
    parameters.target = 100.0;
    parameters.range = 25.0;
    parameters.alpha = 0.6;
    parameters.scheme = scheme;
  }
  [[nodiscard]] std::unique_ptr<solver::Executor> start(solver::ExecutorKind kind) const {
    auto level_set = executor(kind, source, parameters);
    if (!level_set->paint({centre_of(geometry), 7.0}, solver::Brush::add)) qFatal("paint failed");
    return level_set;
  }
};

std::vector<PassRecord> all_records(solver::Executor& level_set) {
  std::vector<PassRecord> records;
  const PageLayout layout(level_set.snapshot().value().geometry.size, {16, 16, 1});
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    PassRecord record = good(level_set.record_step(page));
    if (record.is_resident()) records.push_back(std::move(record));
  }
  return records;
}

std::size_t texel(std::int64_t x, std::int64_t y) {
  return static_cast<std::size_t>(x + PassRecord::kSide * y);
}

// phi of the page's voxels in a field.
bool holds(const solver::Field& phi, const PassRecord& record, const std::function<float(int, int)>& value) {
  const Index3 first = record.layout.first_voxel(record.page);
  const Index3 valid = record.valid();
  for (int y = 0; y < valid.y; ++y) {
    for (int x = 0; x < valid.x; ++x) {
      if (phi.at(first + Index3(x, y, 0)) != value(x, y)) return false;
    }
  }
  return true;
}

// The message of a page, worked out from phi after the step by the words of page_message.h.
std::uint8_t code_without_motion(const solver::Field& phi, const PassRecord& record) {
  const Index3 first = record.layout.first_voxel(record.page);
  const Index3 last = phi.geometry.size - Index3(1);
  const Index3 valid = record.valid();
  const auto band = static_cast<float>(phi.band);
  unsigned code = 0;
  bool all_inside = true;
  bool all_outside = true;
  for (int y = 0; y < valid.y; ++y) {
    for (int x = 0; x < valid.x; ++x) {
      const Index3 voxel = first + Index3(x, y, 0);
      const float here = phi.at(voxel);
      all_inside = all_inside && here == band;
      all_outside = all_outside && here == -band;
      const bool on_face[] = {x == 0, x == valid.x - 1, y == 0, y == valid.y - 1, true, true};
      for (int face = 0; face < solver::kFaces; ++face) {
        if (!on_face[face]) continue;
        const Index3 across = glm::clamp(voxel + solver::kFaceSteps[face], Index3(0), last);
        if (phi.at(across) != here) code |= 1U << face;
      }
    }
  }
  if (!all_inside && !all_outside) code |= 0x40U;
  if (all_inside) code |= 0x80U;
  return static_cast<std::uint8_t>(code);
}

}  // namespace

class RecordingTest : public QObject {
  Q_OBJECT

 private slots:
  void the_record_is_what_the_step_does_data() {
    QTest::addColumn<int>("scheme");
    QTest::newRow("split") << int(solver::Scheme::split);
    QTest::newRow("paper") << int(solver::Scheme::paper);
  }
  void the_record_is_what_the_step_does() {
    QFETCH(int, scheme);
    const Scene scene(static_cast<solver::Scheme>(scheme));
    const auto level_set = scene.start(solver::ExecutorKind::stream);
    int mixed = 0;
    int asked = 0;
    int freed = 0;
    for (int step = 0; step < 10; ++step) {
      const solver::Field before = level_set->snapshot().value();
      const std::vector<PassRecord> records = all_records(*level_set);
      QVERIFY(records.size() > 10);
      run(*level_set, 1);
      const solver::Field after = level_set->snapshot().value();
      for (const PassRecord& record : records) {
        QVERIFY(holds(before, record, [&](int x, int y) { return record.phi_at(x, y); }));
        QVERIFY(record.quiet || holds(after, record, [&](int x, int y) { return record.next[texel(x, y)]; }));
        // Whether it moved in the window is known to the executor alone.
        const unsigned bits = record.message.is_mixed() ? 0x7fU : 0xffU;
        QCOMPARE(record.message.code & bits, code_without_motion(after, record) & bits);
        const PassRecord then = good(level_set->record_step(record.page));
        QCOMPARE(!then.is_resident(), record.decision.frees);
        const Index3 place = record.layout.page_coordinates(record.page);
        for (int face = 0; face < solver::kFaces; ++face) {
          if (!record.decision.allocates_across(face)) continue;
          ++asked;
          QVERIFY(good(level_set->record_step(record.layout.page_number(place + solver::kFaceSteps[face])))
                      .is_resident());
        }
        mixed += record.message.is_mixed() ? 1 : 0;
        freed += record.decision.frees ? 1 : 0;
      }
    }
    qInfo("%d messages of mixed pages, %d pages asked for, %d freed", mixed, asked, freed);
    QVERIFY(mixed > 100 && asked > 5);
  }

  void a_page_that_becomes_constant_is_freed_as_foretold() {
    Scene scene;
    scene.parameters.target = 1000.0;  // it shrinks
    const auto level_set = scene.start(solver::ExecutorKind::stream);
    int freed = 0;
    for (int step = 0; step < 20; ++step) {
      const std::vector<PassRecord> records = all_records(*level_set);
      run(*level_set, 1);
      for (const PassRecord& record : records) {
        const PassRecord then = good(level_set->record_step(record.page));
        QCOMPARE(!then.is_resident(), record.decision.frees);
        if (!record.decision.frees) continue;
        ++freed;
        QCOMPARE(then.physical, record.message.is_inside() ? solver::kInsidePage : solver::kOutsidePage);
      }
    }
    QVERIFY(freed > 10);
  }

  void records_change_nothing() {
    const Scene scene;
    const auto watched = scene.start(solver::ExecutorKind::stream);
    const auto alone = scene.start(solver::ExecutorKind::stream);
    const auto same = [&] {
      const solver::Field a = watched->snapshot().value();
      const solver::Field b = alone->snapshot().value();
      return a.pages.stored_pages() == b.pages.stored_pages() && a.dense() == b.dense() &&
             watched->quiet_pages().value() == alone->quiet_pages().value() &&
             watched->memory().state_bytes == alone->memory().state_bytes;
    };
    // Over windows of steps, odd and even ones.
    for (int step = 0; step < 36; ++step) {
      if (step % 3 == 0) all_records(*watched);
      run(*watched, 1);
      run(*alone, 1);
      QVERIFY(same());
    }
    // Until pages rest, and when they are woken.
    for (const auto* level_set : {&watched, &alone}) run(**level_set, 3000, true);
    const auto resting = [&] { return !alone->quiet_pages().value().empty(); };
    for (int window = 0; window < 40 && !resting(); ++window) {
      all_records(*watched);
      for (const auto* level_set : {&watched, &alone}) run(**level_set, 16);
    }
    QVERIFY(resting());
    QVERIFY(same());
    const std::vector<PassRecord> at_rest = all_records(*watched);
    QVERIFY(
        std::any_of(at_rest.begin(), at_rest.end(), [](const PassRecord& record) { return record.quiet; }));
    for (const auto* level_set : {&watched, &alone})
      QVERIFY((*level_set)->paint({centre_of(scene.geometry), 4.0}, solver::Brush::erase).has_value());
    for (int step = 0; step < 18; ++step) {
      if (step % 3 == 0) all_records(*watched);
      run(*watched, 1);
      run(*alone, 1);
      QVERIFY(same());
    }
    QCOMPARE(failure(watched->validate()), QString());
  }

  // The sum of the terms, as solver/balance.h has them.
  void the_speed_terms_are_those_of_the_balance_data() { the_record_is_what_the_step_does_data(); }
  void the_speed_terms_are_those_of_the_balance() {
    QFETCH(int, scheme);
    const Scene scene(static_cast<solver::Scheme>(scheme));
    const auto level_set = scene.start(solver::ExecutorKind::stream);
    run(*level_set, 7);
    const solver::StepInputs inputs = inputs_of(*level_set, scene.source);
    int compared = 0;
    for (const PassRecord& record : all_records(*level_set)) {
      const Index3 first = record.layout.first_voxel(record.page);
      const Index3 valid = record.valid();
      for (std::int64_t y = 0; y < valid.y; ++y) {
        for (std::int64_t x = 0; x < valid.x; ++x) {
          const float phi = record.phi_at(static_cast<int>(x), static_cast<int>(y));
          if (std::abs(phi) > 1.0F) continue;  // beside the surface
          const solver::Pushes pushes =
              solver::PlaceBalance(inputs, glm::dvec3(first + Index3(x, y, 0))).balance().pushes;
          const glm::vec4 upwind = record.differences[PassRecord::upwind][texel(x, y)];
          const glm::vec4 speeds = record.speeds[texel(x, y)];
          const float rate = record.one_gradient ? speeds.x + speeds.y : speeds.x;
          const float gradient = rate > 0.0F ? upwind.y : upwind.z;
          const double data = speeds.x * gradient;
          const double curvature = record.one_gradient ? speeds.y * gradient : speeds.y;
          const double sum = data + curvature + speeds.z + speeds.w;
          QVERIFY(std::abs(data - pushes.data) <= 0.01 * std::abs(pushes.data) + 1e-5);
          QVERIFY(std::abs(curvature - pushes.curvature) <= 0.01 * std::abs(pushes.curvature) + 1e-4);
          QVERIFY(std::abs(speeds.z - pushes.rescaling) <= 0.01 * std::abs(pushes.rescaling) + 1e-5);
          QVERIFY(std::abs(sum + pushes.limits - pushes.sum()) <= 0.01 * std::abs(pushes.sum()) + 1e-4);
          const double change = record.next[texel(x, y)] - phi;
          QVERIFY(std::abs(record.time_step * pushes.sum() - change) <= 0.01 * std::abs(change) + 2e-6);
          ++compared;
        }
      }
    }
    QVERIFY(compared > 500);
  }

  // In one texture, and in layers of 32 x 32 pages.
  void the_address_of_a_page_leads_to_it_and_back_data() {
    QTest::addColumn<int>("largest_texture");
    QTest::newRow("one texture") << 0;
    QTest::newRow("layers") << 512;
  }
  void the_address_of_a_page_leads_to_it_and_back() {
    QFETCH(int, largest_texture);
    gpu::DeviceOptions wanted;
    wanted.version = gpu::GlVersion::gl33;
    wanted.largest_texture = largest_texture;
    solver::ExecutorOptions options;
    options.device = good(gpu::Device::create_headless(wanted));
    Scene scene;
    if (largest_texture > 0) {
      scene.geometry = grid({120, 120, 90});
      scene.source = zero_volume(scene.geometry);
    }
    const auto level_set = executor(solver::ExecutorKind::stream, scene.source, scene.parameters, options);
    const double radius_mm = largest_texture > 0 ? 42.0 : 7.0;
    QVERIFY(level_set->paint({centre_of(scene.geometry), radius_mm}, solver::Brush::add));
    run(*level_set, 3);
    const std::vector<PassRecord> records = all_records(*level_set);
    QCOMPARE(std::any_of(records.begin(), records.end(),
                         [](const PassRecord& record) { return record.address.y >= 512; }),
             largest_texture > 0);
    std::set<std::pair<std::int64_t, std::int64_t>> addresses;
    for (const PassRecord& record : records) {
      addresses.insert({record.address.x, record.address.y});
      QCOMPARE(record.inverse.at(static_cast<std::size_t>(record.physical)), record.page);
      QVERIFY(record.address.x + PassRecord::kSide <= record.memory_size.x);
      QVERIFY(record.address.y + PassRecord::kSide <= record.memory_size.y);
      const Index3 place = record.layout.page_coordinates(record.page);
      QCOMPARE(record.slice.at(static_cast<std::size_t>(place.x + record.layout.pages().x * place.y)),
               record.physical);
    }
    QCOMPARE(addresses.size(), records.size());
  }

  void what_cannot_be_recorded_is_refused() {
    const Scene scene;
    const auto stream = scene.start(solver::ExecutorKind::stream);
    QCOMPARE(failure(stream->record_step(-1)), QStringLiteral("there is no page -1: the volume has 288"));
    const PassRecord corner = good(stream->record_step(0));
    QVERIFY(!corner.is_resident());
    QCOMPARE(corner.physical, solver::kOutsidePage);
    const auto host = scene.start(solver::ExecutorKind::host);
    QCOMPARE(failure(host->record_step(0)),
             QStringLiteral("the executor host runs no passes that could be recorded"));
  }
};

TIDEMARK_TEST(RecordingTest)

}  // namespace tidemark::test::recording_test

#include "recording_test.moc"
