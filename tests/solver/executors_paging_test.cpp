// What every executor with pages must do, row by row: pages that come and go (T6, T6b), that rest, and that
// can be looked at.
#include <algorithm>
#include <functional>
#include <glm/vector_relational.hpp>
#include <random>

#include "settings.h"
#include "solver/gl/packed_view.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::executors_paging_test {

namespace {

// phi in voxel order as a shader finds it: by the page table, in the texture of packed pages.
std::vector<float> seen_through(const solver::PackedView& view) {
  const PageLayout& pages = view.layout.layout();
  const auto table = view.page_table->download_values<solver::PhysicalPage>(0, pages.page_count());
  const std::int64_t width = view.phi->width();
  const std::int64_t height = view.phi->height();
  const std::int64_t layer_texels = width * height;
  std::vector<float> texels(static_cast<std::size_t>(layer_texels * view.phi->layers()));
  for (std::int64_t layer = 0; layer < view.phi->layers(); ++layer) {
    const auto into = std::span(texels).subspan(static_cast<std::size_t>(layer * layer_texels),
                                                static_cast<std::size_t>(layer_texels));
    if (!view.phi->download(layer, {0, 0, width, height}, std::as_writable_bytes(into))) {
      qFatal("phi cannot be read");
    }
  }
  const Geometry geometry = grid(pages.domain_size());
  std::vector<float> phi(static_cast<std::size_t>(geometry.voxel_count()));
  std::vector<float> voxels(static_cast<std::size_t>(pages.voxels_per_page()));
  const Index3 shape = pages.page_shape();
  for (std::int64_t page = 0; page < pages.page_count(); ++page) {
    const solver::PhysicalPage physical = table[static_cast<std::size_t>(page)];
    const gpu::TexelRect rect = view.layout.rect(physical);
    view.layout.unpack(texels.data() + view.layout.layer(physical) * layer_texels + rect.y * width + rect.x,
                       width, voxels.data());
    const Index3 first = pages.first_voxel(page);
    const Index3 valid = pages.valid_shape(page);
    for (std::int64_t z = 0; z < valid.z; ++z) {
      for (std::int64_t y = 0; y < valid.y; ++y) {
        const float* row = voxels.data() + (y + shape.y * z) * shape.x;
        std::copy_n(row, valid.x, phi.data() + geometry.offset(first + Index3(0, y, z)));
      }
    }
  }
  return phi;
}

}  // namespace

class ExecutorsPagingTest : public QObject {
  Q_OBJECT

 private slots:
  void painting_and_erasing_leak_no_page_data() { add_rows_with_host(); }
  void painting_and_erasing_leak_no_page() {  // T6
    const Setting setting = this_row();
    const Geometry geometry = grid({90, 70, 50});
    const auto source = volume_of(geometry, [](glm::dvec3 p) { return 100.0 + 40.0 * std::sin(p.x / 4.0); });
    solver::Parameters parameters;
    parameters.target = 100.0;
    parameters.range = 30.0;
    const auto level_set = setting.make(source, parameters);
    const auto host = executor(solver::ExecutorKind::host, source, parameters);
    std::mt19937 random(5);
    for (int edit = 0; edit < 60; ++edit) {
      const glm::dvec3 voxel{random() % 90, random() % 70, random() % 50};
      const solver::Sphere sphere = solver::sphere_at_voxel(geometry, voxel, 1.0 + random() % 14);
      const solver::Brush brush = random() % 3 == 0 ? solver::Brush::erase : solver::Brush::add;
      const std::int64_t steps = random() % 4;
      for (solver::Executor* each : {level_set.get(), host.get()}) {
        QCOMPARE(failure(each->paint(sphere, brush)), QString());
        run(*each, steps);
      }
      QCOMPARE(failure(level_set->validate()), QString());
    }
    QVERIFY(dice(level_set->snapshot().value().mask(), host->snapshot().value().mask()) >= 0.999);
    QVERIFY(level_set->memory().peak_resident_pages > 200);
    // Erasing everything gives every page back.
    QVERIFY(level_set->paint(solver::sphere_at_voxel(geometry, {45, 35, 25}, 100.0), solver::Brush::erase));
    run(*level_set, 8);
    QCOMPARE(level_set->memory().resident_pages, std::int64_t{0});
    QCOMPARE(failure(level_set->validate()), QString());
    // And filling everything leaves nothing to compute.
    QVERIFY(level_set->paint(solver::sphere_at_voxel(geometry, {45, 35, 25}, 100.0), solver::Brush::add));
    QCOMPARE(level_set->snapshot().value().mask().count(), geometry.voxel_count());
    QCOMPARE(failure(level_set->validate()), QString());
  }

  void painting_is_the_same_as_in_the_reference_data() { add_rows_with_host(); }
  void painting_is_the_same_as_in_the_reference() {
    const Setting setting = this_row();
    const Geometry geometry = grid({30, 26, 22}, {0.7, 0.9, 1.8});
    const auto source = zero_volume(geometry);
    const auto tested = setting.make(source, solver::Parameters());
    const auto reference = executor(solver::ExecutorKind::reference, source, solver::Parameters());
    std::mt19937 random(11);
    for (int edit = 0; edit < 20; ++edit) {
      const glm::dvec3 voxel{random() % 30, random() % 26, random() % 22};
      const solver::Sphere sphere = solver::sphere_at_voxel(geometry, voxel, 1.0 + random() % 8);
      const solver::Brush brush = edit % 3 == 2 ? solver::Brush::erase : solver::Brush::add;
      QVERIFY(tested->paint(sphere, brush));
      QVERIFY(reference->paint(sphere, brush));
    }
    QVERIFY(largest_difference(*tested, *reference) < 1e-5);
  }

  void padding_is_never_counted_data() { add_rows_with_host(); }
  void padding_is_never_counted() {  // T6b
    const Setting setting = this_row();
    for (const std::int64_t n : {1, 7, 61, 175}) {
      for (int axis = 0; axis < 3; ++axis) {
        Index3 size(13, 10, 9);
        size[axis] = n;
        const Geometry geometry = grid(size);
        const auto source =
            volume_of(geometry, [](glm::dvec3 p) { return 10.0 * std::sin(p.x + p.y * 2 + p.z); });
        solver::Parameters parameters;
        parameters.range = 5.0;
        const auto tested = setting.make(source, parameters);
        const auto reference = executor(solver::ExecutorKind::reference, source, parameters);
        QVERIFY(tested->paint({centre_of(geometry), 4.0}, solver::Brush::add));
        for (int step = 0; step < 4; ++step) {
          QVERIFY(reference->restore(tested->snapshot().value()));
          QVERIFY(run(*tested, 1).voxel_updates <= geometry.voxel_count());
          run(*reference, 1);
          QVERIFY(largest_difference(*tested, *reference) < 1e-5);
          QCOMPARE(failure(tested->validate()), QString());
        }
      }
    }
  }

  void the_budget_stops_the_run_and_keeps_what_was_computed_data() { add_rows_with_host(); }
  void the_budget_stops_the_run_and_keeps_what_was_computed() {  // T6
    const Setting setting = this_row();
    const Geometry geometry = grid({96, 96, 96});
    const auto source = zero_volume(geometry);
    solver::Parameters parameters;
    parameters.alpha = 1.0;
    solver::ExecutorOptions small = setting.options();
    small.memory_budget_bytes = 5 << 20;
    const auto limited = executor(setting.kind, source, parameters, small);
    const auto unlimited = setting.make(source, parameters);
    const solver::Sphere sphere{centre_of(geometry), 6.0};
    QCOMPARE(failure(limited->paint(sphere, solver::Brush::add)), QString());
    QVERIFY(unlimited->paint(sphere, solver::Brush::add));
    int steps = 0;
    for (;; ++steps) {
      QVERIFY(steps < 500);
      run(*unlimited, 1);
      const auto report = limited->advance({});
      if (report) continue;
      QCOMPARE(report.error().kind, ErrorKind::capability);
      QVERIFY2(report.error().message.find("budget is 5 MB") != std::string::npos,
               report.error().message.c_str());
      break;
    }
    QVERIFY(steps > 5);
    QVERIFY(limited->snapshot().value().dense() == unlimited->snapshot().value().dense());
    QVERIFY(limited->memory().state_bytes + limited->memory().source_bytes <= small.memory_budget_bytes);
    // It goes on when the surface needs less.
    QCOMPARE(failure(limited->paint({centre_of(geometry), 100.0}, solver::Brush::erase)), QString());
    run(*limited, 5);
    QCOMPARE(limited->memory().resident_pages, std::int64_t{0});
  }

  // With as little memory as its own pages take; what lies beside them is missing then.
  void an_edit_is_done_or_refused_as_a_whole_data() { add_rows_with_host(); }
  void an_edit_is_done_or_refused_as_a_whole() {
    const Setting setting = this_row();
    const Geometry geometry = grid({96, 96, 96});
    const auto source = zero_volume(geometry);
    // It ends at the last voxels of pages of any shape.
    const solver::Sphere ball{centre_of(geometry), 29.5};
    const auto in_box = [](glm::dvec3 p) {
      return glm::all(glm::greaterThanEqual(p, glm::dvec3(32.0))) &&
             glm::all(glm::lessThan(p, glm::dvec3(64.0)));
    };
    const auto box = solver::Field::from_dense(
        geometry, sample(geometry, [&](glm::dvec3 p) { return in_box(p) ? 0.5 : -100.0; }), 2.5);
    auto anchors = std::make_shared<solver::Constraints>(geometry.size);
    anchors->set(BitMask(box.mask()), solver::Constraint::anchor);
    auto walls = std::make_shared<solver::Constraints>(geometry.size);
    walls->set(geometry, {centre_of(geometry), 2.0}, solver::Constraint::wall);
    struct Edit {
      const char* name;
      std::function<Status(solver::Executor&)> make;
    };
    const Edit edits[] = {
        {"paint", [&](solver::Executor& level_set) { return level_set.paint(ball, solver::Brush::add); }},
        {"paint around walls",
         [&](solver::Executor& level_set) -> Status {
           TIDEMARK_TRY(level_set.set_constraints(walls));
           return level_set.paint(ball, solver::Brush::add);
         }},
        {"restore", [&](solver::Executor& level_set) { return level_set.restore(box); }},
        {"anchors", [&](solver::Executor& level_set) { return level_set.set_constraints(anchors); }}};
    for (const Edit& edit : edits) {
      const auto free = setting.make(source, solver::Parameters());
      const std::vector<float> before = free->snapshot().value().dense();
      QCOMPARE(failure(edit.make(*free)), QString());
      const std::vector<float> after = free->snapshot().value().dense();
      QVERIFY(after != before);
      // The least memory that holds it, to less than a page of the host's.
      std::unique_ptr<solver::Executor> least;
      std::int64_t too_small = 0;
      std::int64_t enough = 8 << 20;
      while (enough - too_small > 4096) {
        solver::ExecutorOptions options = setting.options();
        options.memory_budget_bytes = (too_small + enough) / 2;
        auto made = solver::make_executor(setting.kind, source, solver::Parameters(), options);
        const bool is_done = made && edit.make(**made);
        if (made) {
          const std::vector<float> there = (*made)->snapshot().value().dense();
          QVERIFY2(there == (is_done ? after : before), edit.name);
        }
        (is_done ? enough : too_small) = options.memory_budget_bytes;
        if (is_done) least = std::move(*made);
      }
      QVERIFY2(least != nullptr, edit.name);
      const auto refused = least->advance({});
      QVERIFY2(!refused, edit.name);
      QCOMPARE(refused.error().kind, ErrorKind::capability);
      QCOMPARE(least->steps_of_last_run(), std::int64_t{0});
      QVERIFY2(least->snapshot().value().dense() == after, edit.name);
      // It goes on when the surface needs less.
      if (edit.name == std::string("anchors")) continue;  // which nothing erases
      QCOMPARE(failure(least->paint({centre_of(geometry), 100.0}, solver::Brush::erase)), QString());
      run(*least, 5);
      QCOMPARE(least->memory().resident_pages, std::int64_t{0});
      QCOMPARE(failure(least->validate()), QString());
    }
  }

  void memory_follows_the_surface_data() { add_rows_with_host(); }
  void memory_follows_the_surface() {
    const Setting setting = this_row();
    const Geometry geometry = grid({128, 128, 128});
    const auto level_set = setting.make(zero_volume(geometry), solver::Parameters());
    set_phi(*level_set, geometry, [&](glm::dvec3 p) { return 45.0 - glm::distance(p, centre_of(geometry)); });
    const solver::MemoryReport memory = level_set->memory();
    const auto voxels = static_cast<double>(memory.resident_pages * memory.page_shape.x *
                                            memory.page_shape.y * memory.page_shape.z);
    QVERIFY(memory.resident_pages > 300);
    QVERIFY2(static_cast<double>(memory.state_bytes) / voxels <= 10.0,
             qPrintable(QString::number(static_cast<double>(memory.state_bytes) / voxels)));
  }

  void it_says_which_pages_are_quiet_data() { add_rows_with_host(); }
  void it_says_which_pages_are_quiet() {
    const Setting setting = this_row();
    Scene scene = lumpy_scene({45, 40, 35});
    scene.parameters.range = 12.0;  // the surface rests near its start
    scene.source = volume_of(scene.geometry, [&](glm::dvec3 p) {
      return 100.0 - 2.0 * glm::distance(p, centre_of(scene.geometry));
    });
    const auto level_set = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
    QVERIFY(level_set->quiet_pages().value().empty());
    run_until_all_rest(*level_set, 4000);
    const std::vector<std::int64_t> at_rest = level_set->quiet_pages().value();
    const solver::Field phi = level_set->snapshot().value();
    QVERIFY(at_rest.size() > 20);
    QCOMPARE(static_cast<std::int64_t>(at_rest.size()), phi.pages.stored());
    QCOMPARE(static_cast<std::int64_t>(at_rest.size()), level_set->memory().quiet_pages);
    for (const std::int64_t page : at_rest) QVERIFY(phi.pages.is_stored(page));

    // A dent in the surface, on the low side of x.
    Index3 voxel(0, 20, 17);
    while (phi.at(voxel) <= 0.0F) ++voxel.x;
    QCOMPARE(failure(level_set->paint({scene.geometry.to_patient(voxel), 3.0}, solver::Brush::erase)),
             QString());
    const std::vector<std::int64_t> quiet = level_set->quiet_pages().value();
    QVERIFY(!quiet.empty() && quiet.size() < at_rest.size());
    for (const Index3 step : {Index3(-3, 0, 0), Index3(3, 0, 0), Index3(0, -3, 0), Index3(0, 3, 0),
                              Index3(0, 0, -3), Index3(0, 0, 3)}) {
      const std::int64_t page = phi.layout.translate(voxel + step).page;
      QVERIFY(std::find(quiet.begin(), quiet.end(), page) == quiet.end());
    }
  }

  void a_page_that_has_just_become_quiet_wakes_when_painted_data() { add_rows_with_host(); }
  void a_page_that_has_just_become_quiet_wakes_when_painted() {
    const Setting setting = this_row();
    const Scene scene = resting_scene({45, 40, 35});
    const auto level_set = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
    std::vector<std::int64_t> quiet;
    for (int i = 0; i < 200 && quiet.empty(); ++i) {
      run(*level_set, solver::kConvergenceWindow);
      quiet = level_set->quiet_pages().value();
    }
    QVERIFY(!quiet.empty());
    const solver::Field phi = level_set->snapshot().value();
    const Index3 voxel = phi.layout.first_voxel(quiet.front());
    const solver::Brush other = phi.at(voxel) > 0.0F ? solver::Brush::erase : solver::Brush::add;
    QCOMPARE(failure(level_set->paint({scene.geometry.to_patient(voxel), 2.0}, other)), QString());
    const std::vector<std::int64_t> still = level_set->quiet_pages().value();
    QVERIFY(std::find(still.begin(), still.end(), quiet.front()) == still.end());
    run(*level_set, 2);
    QVERIFY((level_set->snapshot().value().at(voxel) > 0.0F) == (other == solver::Brush::add));
    QCOMPARE(failure(level_set->validate()), QString());
  }

  void its_phi_can_be_drawn_where_it_lies_data() { add_rows(); }
  void its_phi_can_be_drawn_where_it_lies() {
    const Setting setting = this_row();
    const Scene scene = lumpy_scene({61, 50, 47});
    const auto level_set = setting.make(scene.source, scene.parameters);
    solver::PackedView view;
    const auto shows_the_level_set = [&] {
      return level_set->packed_view(view) && view.band == static_cast<float>(level_set->band()) &&
             seen_through(view) == level_set->snapshot().value().dense();
    };
    QVERIFY(shows_the_level_set());
    QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
    QVERIFY(shows_the_level_set());
    const std::int64_t bytes = level_set->memory().state_bytes;
    for (const std::int64_t steps : {1, 2, 40, 41, 60}) {
      run(*level_set, steps);
      QVERIFY(shows_the_level_set());
    }
    QVERIFY(level_set->memory().state_bytes > bytes);  // it has grown
    QCOMPARE(failure(level_set->paint({scene.seed.centre_mm, 100.0}, solver::Brush::add)), QString());
    QVERIFY(shows_the_level_set());
    QCOMPARE(failure(level_set->restore(solver::Field::empty(scene.geometry, level_set->band()))), QString());
    QVERIFY(shows_the_level_set());
  }

  void on_the_processor_there_is_nothing_to_draw_from() {
    const Scene scene = lumpy_scene({20, 20, 20});
    solver::PackedView view;
    for (const solver::ExecutorKind kind : {solver::ExecutorKind::host, solver::ExecutorKind::reference}) {
      QVERIFY(!executor(kind, scene.source, scene.parameters)->packed_view(view));
    }
  }

  void the_driver_had_no_complaint() {  // last: after all that went before
    QCOMPARE(shared_device()->severe_messages(), std::int64_t{0});
  }
};

TIDEMARK_TEST(ExecutorsPagingTest)

}  // namespace tidemark::test::executors_paging_test

#include "executors_paging_test.moc"
