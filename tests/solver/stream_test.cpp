// The stream executor: substreams, messages, sub-regions, and agreement with the host.
#include <random>
#include <regex>
#include <set>

#include "gpu/device.h"
#include "gpu/draw.h"
#include "gpu/shader_source.h"
#include "level_sets.h"
#include "solver/speed/tent_speed.h"
#include "solver/stream/stream_executor.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::stream_test {

namespace {

constexpr Index3 kPageShape{16, 16, 1};
constexpr std::int64_t kPageTexels = 256;

std::shared_ptr<gpu::Device> device() {
  auto made = gpu::Device::create_headless({gpu::GlVersion::gl33, true});
  if (!made) qFatal("%s", made.error().message.c_str());
  return *made;
}

template <class T>
T good(Result<T> result) {
  if (!result) qFatal("%s", result.error().message.c_str());
  return std::move(*result);
}

// Physical memory with every page of a volume resident.
struct FullMemory {
  std::shared_ptr<gpu::Device> gpu = device();
  PageLayout pages;
  solver::PackedLayout layout;
  solver::PagedMemory<3> table;
  std::vector<solver::PhysicalPage> list;
  solver::PhysicalMemory memory;
  solver::GeometryEngine geometry;

  explicit FullMemory(Index3 size)
      : pages(size, kPageShape), layout(pages, gpu->capabilities()), table(pages, solver::kUnlimited) {
    for (std::int64_t page = 0; page < pages.page_count(); ++page)
      list.push_back(table.make_resident(page).value());
    memory = good(solver::PhysicalMemory::create(*gpu, layout, table.table().capacity(), 2.5F));
    geometry = solver::GeometryEngine::create(*gpu, layout);
    if (!geometry.describe(*gpu, table, list)) qFatal("describe failed");
    gpu::begin_exact_drawing();
  }

  // How often each texel of G is drawn, in the order of physical pages.
  std::vector<float> count(std::initializer_list<solver::Substream> substreams) {
    memory.draw_into(solver::PhysicalMemory::Target::first, 0);
    gpu::clear_colours(1);
    for (const solver::Substream substream : substreams) {
      gpu::Defines defines = geometry.defines(substream);
      defines.emplace_back("IN_MEMORY", "");
      const auto program = good(gpu::Program::render(*gpu, solver::GeometryEngine::vertex_shader(substream),
                                                     "", "solver/stream/constant.frag", defines));
      const gpu::BlendScope added(gpu::Blending::add);
      program.use();
      program.set("value", glm::vec4(1.0F));
      program.set("target_layer", 0);
      geometry.draw(program, substream, 0, geometry.size(), memory.size());
    }
    return good(memory.field().download(0));
  }
};

// Whether each voxel is drawn once, and nothing else is drawn.
bool drawn_once(const FullMemory& full, const std::vector<float>& counts) {
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const auto page = static_cast<solver::PhysicalPage>(i / kPageTexels);
    const auto x = static_cast<std::int64_t>(i % 16);
    const auto y = static_cast<std::int64_t>(i / 16 % 16);
    bool is_voxel = page >= solver::kFirstPage && page < full.table.table().capacity();
    if (is_voxel) {
      const Index3 valid = full.pages.valid_shape(full.table.virtual_page(page));
      is_voxel = x < valid.x && y < valid.y;
    }
    if (counts[i] != (is_voxel ? 1.0F : 0.0F)) return false;
  }
  return true;
}

// A lumpy source with a ball in it.
struct Scene {
  Geometry geometry;
  std::shared_ptr<const Volume> source;
  solver::Parameters parameters;

  explicit Scene(Index3 size, glm::dvec3 spacing = glm::dvec3(1.0)) : geometry(grid(size, spacing)) {
    source = volume_of(geometry, [this](glm::dvec3 p) {
      const double r = glm::distance(p, centre_of(geometry));
      return 100.0 - 6.0 * std::max(0.0, r - 12.0 - 2.0 * std::sin(p.x / 3.0)) + 5.0 * std::sin(p.y * 7.0);
    });
    parameters.target = 100.0;
    parameters.range = 25.0;
    parameters.alpha = 0.6;
  }

  std::unique_ptr<solver::Executor> start(solver::ExecutorKind kind,
                                          solver::ExecutorOptions options = {}) const {
    auto level_set = executor(kind, source, parameters, options);
    if (!level_set->paint({centre_of(geometry), 5.0}, solver::Brush::add)) qFatal("paint failed");
    return level_set;
  }
};

bool same_bits(const solver::Executor& a, const solver::Executor& b) {
  const solver::Field first = good(a.snapshot());
  const solver::Field second = good(b.snapshot());
  return first.pages.stored_pages() == second.pages.stored_pages() && first.dense() == second.dense();
}

}  // namespace

class StreamTest : public QObject {
  Q_OBJECT

 private slots:
  void every_voxel_of_every_page_is_covered_once() {
    for (const Index3 size :
         {Index3(48, 48, 3), Index3(61, 7, 5), Index3(7, 61, 3), Index3(17, 18, 3), Index3(19, 33, 2),
          Index3(1, 1, 4), Index3(2, 3, 2), Index3(34, 50, 1), Index3(600, 300, 2)}) {
      FullMemory full(size);
      const auto substreams =
          full.count({solver::Substream::interior, solver::Substream::edges, solver::Substream::corners});
      QVERIFY2(drawn_once(full, substreams),
               qPrintable(QString("substreams, %1 x %2").arg(size.x).arg(size.y)));
      const auto whole = full.count({solver::Substream::whole_page});
      QVERIFY2(drawn_once(full, whole), qPrintable(QString("whole pages, %1 x %2").arg(size.x).arg(size.y)));
      QCOMPARE(full.gpu->severe_messages(), 0);
    }
  }

  // GALLIUM_DRIVER names one of Mesa's drivers, and another must not pass for it.
  void a_small_ball_is_the_references_on_the_driver_asked_for() {
    const QByteArray asked = qgetenv("GALLIUM_DRIVER");
    const QByteArray found = QByteArray::fromStdString(device()->capabilities().renderer);
    QVERIFY2(asked.isEmpty() || found.contains(asked), found.constData());
    const Scene scene({32, 30, 24}, {1.0, 1.0, 1.5});
    const auto tested = scene.start(solver::ExecutorKind::stream);
    const auto reference = scene.start(solver::ExecutorKind::reference);
    for (solver::Executor* level_set : {tested.get(), reference.get()}) run(*level_set, 20);
    const Mask a = good(tested->snapshot()).mask();
    const Mask b = good(reference->snapshot()).mask();
    double both = 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < a.voxels.size(); ++i) {
      both += a.voxels[i] != 0 && b.voxels[i] != 0 ? 1.0 : 0.0;
      sum += (a.voxels[i] != 0 ? 1.0 : 0.0) + (b.voxels[i] != 0 ? 1.0 : 0.0);
    }
    qInfo("Dice %.5f on %s", 2.0 * both / sum, found.constData());
    QVERIFY(sum > 1000.0);
    QVERIFY(2.0 * both / sum >= 0.999);
  }

  void interior_edges_and_corners_have_the_papers_shares() {
    FullMemory full({64, 48, 3});
    const auto share = [&](solver::Substream substream) {
      double sum = 0.0;
      for (const float count : full.count({substream})) sum += static_cast<double>(count);
      return sum / (64.0 * 48.0 * 3.0);
    };
    QCOMPARE(share(solver::Substream::interior), 196.0 / 256.0);  // 76.6 %
    QCOMPARE(share(solver::Substream::edges), 56.0 / 256.0);      // 21.9 %
    QCOMPARE(share(solver::Substream::corners), 4.0 / 256.0);     // 1.6 %
  }

  void each_single_voxel_makes_its_bit_arrive() {
    const Geometry geometry = grid({48, 48, 3});
    const auto source = zero_volume(geometry);
    const auto tent = std::make_shared<solver::TentSpeed>(source, solver::Parameters());
    const solver::Model model(source->geometry, {}, *tent);
    const auto gpu = device();
    const PageLayout pages(geometry.size, kPageShape);
    const solver::PackedLayout layout(pages, gpu->capabilities());
    solver::PagedMemory<3> table(pages, solver::kUnlimited);
    const solver::PhysicalPage page = table.make_resident(pages.page_number({1, 1, 1})).value();
    const float band = 2.5F;
    auto memory = good(solver::PhysicalMemory::create(*gpu, layout, table.table().capacity(), band));
    auto geometry_engine = solver::GeometryEngine::create(*gpu, layout);
    const solver::PhysicalPage list[] = {page};
    QVERIFY(geometry_engine.describe(*gpu, table, list));
    const auto drive = good(solver::DriveTextures::create(*gpu, source, tent, 1));
    auto passes = good(solver::RegionPasses::create(*gpu, geometry_engine, drive, model, 32));
    QVERIFY(passes.reserve(*gpu, 1));
    gpu::begin_exact_drawing();
    std::vector<float> values(kPageTexels, -band);
    const auto upload = [&] {
      SharedPages one(1, kPageTexels);
      std::copy(values.begin(), values.end(), one.store(0));
      memory.field().upload(one);
    };
    upload();
    QCOMPARE(int(good(passes.message(geometry_engine, memory, 0, band, 1e-3F)).at(0).code), 0);
    for (int lit = 0; lit < kPageTexels; ++lit) {
      for (const float value : {0.0F, band}) {
        std::fill(values.begin(), values.end(), -band);
        values[static_cast<std::size_t>(lit)] = value;
        upload();
        const solver::PageMessage message =
            good(passes.message(geometry_engine, memory, lit % 2, band, 1e-3F)).at(0);
        const int x = lit % 16;
        const int y = lit / 16;
        const bool expected[] = {x == 0, x == 15, y == 0, y == 15, true, true};
        for (int face = 0; face < 6; ++face) QCOMPARE(message.differs_across(face), expected[face]);
        QVERIFY(message.is_mixed());
        QVERIFY(!message.moved());
      }
    }
    std::fill(values.begin(), values.end(), band);
    upload();
    const solver::PageMessage inside = good(passes.message(geometry_engine, memory, 0, band, 1e-3F)).at(0);
    QVERIFY(inside.is_inside() && inside.differs_across_any());
  }

  void thirty_steps_are_the_hosts() {
    double worst = 0.0;
    for (const glm::dvec3 spacing : {glm::dvec3(1.0), glm::dvec3(1.0, 1.0, 3.0)}) {
      for (const solver::Scheme scheme : {solver::Scheme::split, solver::Scheme::paper}) {
        Scene scene({61, 47, 40}, spacing);
        scene.parameters.scheme = scheme;
        const auto host = scene.start(solver::ExecutorKind::host);
        const auto stream = scene.start(solver::ExecutorKind::stream);
        QCOMPARE(largest_difference(*host, *stream), 0.0);
        run(*host, 1);
        run(*stream, 1);
        QVERIFY2(largest_difference(*host, *stream) <= 2e-6, "one step");
        run(*host, 29);
        run(*stream, 29);
        worst = std::max(worst, largest_difference(*host, *stream));
        QCOMPARE(failure(stream->validate()), QString());
      }
    }
    qInfo("largest difference from the host after 30 steps: %.2g", worst);
    QVERIFY(worst <= 1e-4);
  }

  void partial_pages_are_computed_and_padding_is_not() {
    for (const Index3 size :
         {Index3(7, 61, 9), Index3(61, 7, 9), Index3(17, 33, 20), Index3(1, 20, 20), Index3(7, 7, 7)}) {
      Scene scene(size);
      solver::ExecutorOptions options;
      options.skip_quiet_pages = false;
      const auto host = scene.start(solver::ExecutorKind::host, options);
      const auto stream = scene.start(solver::ExecutorKind::stream, options);
      run(*host, 30);
      const solver::AdvanceReport report = run(*stream, 30);
      QVERIFY(report.voxel_updates > 0 && report.voxel_updates <= 30 * scene.geometry.voxel_count());
      QVERIFY(largest_difference(*host, *stream) <= 1e-4);
      QCOMPARE(failure(stream->validate()), QString());
    }
  }

  void sub_regions_change_no_bit() {
    const Scene scene({90, 90, 40});
    const auto start = [&](std::int64_t largest_region) {
      auto made = good(solver::StreamExecutor::create(scene.source, scene.parameters, {}, largest_region));
      if (!made->paint({centre_of(scene.geometry), 12.0}, solver::Brush::add)) qFatal("paint failed");
      return made;
    };
    const auto whole = start(1024);
    const auto parts = start(32);
    for (int chunk = 0; chunk < 4; ++chunk) {
      const solver::AdvanceReport a = run(*whole, 10);
      const solver::AdvanceReport b = run(*parts, 10);
      QVERIFY(whole->memory().resident_pages > 3 * 32);
      QVERIFY(same_bits(*whole, *parts));
      QCOMPARE(a.voxel_updates, b.voxel_updates);
      QCOMPARE(a.surface_speed, b.surface_speed);
    }
  }

  void churn_with_growth_loses_nothing() {
    const Scene scene({100, 100, 60});
    std::mt19937 random(3);
    const auto host = scene.start(solver::ExecutorKind::host);
    const auto stream = scene.start(solver::ExecutorKind::stream);
    std::int64_t most = 0;
    for (int round = 0; round < 12; ++round) {
      const glm::dvec3 voxel{random() % 100, random() % 100, random() % 60};
      const solver::Sphere sphere = solver::sphere_at_voxel(scene.geometry, voxel, 4.0 + random() % 24);
      const solver::Brush brush = round % 3 == 2 ? solver::Brush::erase : solver::Brush::add;
      for (solver::Executor* level_set : {host.get(), stream.get()}) {
        QCOMPARE(failure(level_set->paint(sphere, brush)), QString());
        run(*level_set, 5);
      }
      QCOMPARE(failure(stream->validate()), QString());
      QVERIFY(largest_difference(*host, *stream) <= 2e-3);
      most = std::max(most, stream->memory().resident_pages);
    }
    QVERIFY(most > 400);
    QVERIFY(stream->paint({centre_of(scene.geometry), 200.0}, solver::Brush::erase));
    run(*stream, 3);
    QCOMPARE(stream->memory().resident_pages, 0);
    QCOMPARE(failure(stream->validate()), QString());
  }

  void a_snapshot_resumes_to_the_same_bits() {
    const Scene scene({61, 47, 40});
    solver::ExecutorOptions options;
    options.skip_quiet_pages = false;
    const auto stream = scene.start(solver::ExecutorKind::stream, options);
    run(*stream, 20);
    const auto other = executor(solver::ExecutorKind::stream, scene.source, scene.parameters, options);
    QVERIFY(other->restore(good(stream->snapshot())));
    run(*stream, 20);
    run(*other, 20);
    QCOMPARE(largest_difference(*stream, *other), 0.0);
  }

  void the_driver_has_no_severe_message_for_it() {
    const Scene scene({61, 47, 40});
    solver::ExecutorOptions options;
    options.device = device();
    QVERIFY(options.device->debugging());
    const auto stream = scene.start(solver::ExecutorKind::stream, options);
    run(*stream, 64);
    QVERIFY(stream->paint({centre_of(scene.geometry), 9.0}, solver::Brush::erase));
    run(*stream, 5);
    QCOMPARE(failure(stream->validate()), QString());
    QCOMPARE(options.device->severe_messages(), 0);
  }

  void it_shares_a_context_of_a_later_version() {
    const Scene scene({61, 47, 40});
    solver::ExecutorOptions options;
    options.device = good(gpu::Device::create_headless({gpu::GlVersion::gl45, true}));
    const auto stream = scene.start(solver::ExecutorKind::stream, options);
    const auto other = scene.start(solver::ExecutorKind::stream);
    run(*stream, 20);
    run(*other, 20);
    QVERIFY(largest_difference(*stream, *other) <= 1e-4);
    QCOMPARE(options.device->severe_messages(), 0);
  }

  // Volumes in blocks have tables of their own, which say nothing of pages.
  void no_fragment_shader_looks_a_page_up() {
    const std::set<std::string> of_blocks{"source_table", "speed_table", "constraint_table"};
    const std::regex sampler(R"(uniform\s+(?:highp\s+)?(\w*[sS]ampler\w*|SOURCE_SAMPLER)\s+(\w+))");
    for (const char* name : {"derivatives", "speeds", "update", "neighbours", "page_message", "motion_blocks",
                             "motion_pages", "constant", "copy", "paint"}) {
      const auto source =
          good(gpu::assemble_shader(fmt::format("solver/stream/{}.frag", name), "330 core", {}));
      for (std::sregex_iterator i(source.text.begin(), source.text.end(), sampler), end; i != end; ++i) {
        const std::string type = (*i)[1];
        const std::string uniform = (*i)[2];
        if (of_blocks.contains(uniform) || uniform.ends_with("_blocks")) continue;
        QVERIFY2(type == "sampler2D" || uniform.ends_with("_volume") ||
                     (type == "sampler2DArray" && uniform.starts_with("phi_")),
                 uniform.c_str());
        QVERIFY2(uniform.find("table") == std::string::npos && uniform.find("record") == std::string::npos,
                 uniform.c_str());
      }
      QVERIFY2(source.text.find("page_origin") == std::string::npos, name);
    }
  }
};

TIDEMARK_TEST(StreamTest)

}  // namespace tidemark::test::stream_test

#include "stream_test.moc"
