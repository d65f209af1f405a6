// What goes up to the GPU when the level set changes, and in what pieces pictures are drawn.
#include <QTest>

#include "solver/executor.h"
#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::phi_picture_test {

namespace {

solver::Field ball(const Geometry& geometry, double radius, glm::dvec3 middle, Index3 page_shape) {
  const double band = solver::default_band(geometry);
  return solver::Field::from_dense(
      geometry,
      sample(geometry,
             [&](glm::dvec3 p) { return std::clamp(radius - glm::length(p - middle), -band, band); }),
      band, page_shape);
}

// phi as the shaders find it, read back from physical memory through the page table.
std::vector<float> read_back(const renderer::PhiPicture& picture) {
  const PageLayout& layout = picture.pages().layout();
  const std::vector<float> pages = *picture.field().download(0);
  std::vector<float> values;
  for (std::int64_t z = 0; z < layout.domain_size().z; ++z) {
    for (std::int64_t y = 0; y < layout.domain_size().y; ++y) {
      for (std::int64_t x = 0; x < layout.domain_size().x; ++x) {
        const VirtualAddress at = layout.translate({x, y, z});
        const solver::PhysicalPage physical = picture.pages().physical(at.page);
        values.push_back(pages[static_cast<std::size_t>(physical * layout.voxels_per_page() + at.offset)]);
      }
    }
  }
  return values;
}

}  // namespace

class PhiPictureTest : public QObject {
  Q_OBJECT

 private slots:
  void what_was_sent_is_what_is_there_data() {
    QTest::addColumn<int>("x");
    QTest::addColumn<int>("y");
    QTest::addColumn<int>("z");
    QTest::newRow("8 8 8") << 8 << 8 << 8;
    QTest::newRow("16 16 1") << 16 << 16 << 1;
    QTest::newRow("4 4 4") << 4 << 4 << 4;
  }
  void what_was_sent_is_what_is_there() {
    QFETCH(int, x);
    QFETCH(int, y);
    QFETCH(int, z);
    const Geometry geometry = grid({43, 37, 29});
    const Index3 shape(x, y, z);
    auto device = gpu::Device::create_headless({gpu::GlVersion::gl33, true});
    QCOMPARE(failure(device), QString());
    auto picture = renderer::PhiPicture::create(**device, PageLayout(geometry.size, shape),
                                                solver::default_band(geometry));
    QCOMPARE(failure(picture), QString());
    // A ball that grows, shrinks to nothing, comes back elsewhere, fills everything.
    const glm::dvec3 middle(20.0, 18.0, 14.0);
    std::vector<solver::Field> fields;
    for (const double radius : {4.0, 9.0, 12.0, 5.0, -50.0})
      fields.push_back(ball(geometry, radius, middle, shape));
    fields.push_back(ball(geometry, 6.0, {30.0, 10.0, 20.0}, shape));
    fields.push_back(ball(geometry, 500.0, middle, shape));
    fields.push_back(ball(geometry, 10.0, middle, shape));
    for (const solver::Field& phi : fields) {
      QCOMPARE(failure(picture->update(**device, phi, {})), QString());
      QVERIFY(read_back(*picture) == phi.dense());
      QCOMPARE(failure(picture->pages().table().validate()), QString());
      QCOMPARE(picture->pages().table().resident(), phi.pages.stored());
    }
    QCOMPARE((*device)->severe_messages(), 0);
  }

  void only_what_changed_goes_up() {
    const Geometry geometry = grid({64, 64, 64});
    const Scene scene = ball_scene(geometry, 20.0);
    Painter draw(scene);
    QCOMPARE(draw.gl().pages_uploaded(), scene.phi.pages.stored());
    QCOMPARE(failure(draw.renderer().set_phi(scene.phi)), QString());
    QCOMPARE(draw.gl().pages_uploaded(), 0);
    solver::Field touched = scene.phi;
    touched.pages.change(touched.pages.stored_pages().front())[5] += 0.25F;
    QCOMPARE(failure(draw.renderer().set_phi(touched)), QString());
    QCOMPARE(draw.gl().pages_uploaded(), 1);
  }

  // An executor's memory on the GPU is drawn like a copy of it, also after the memory has grown.
  void an_executors_own_memory_gives_the_same_picture_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<int>("largest_texture");
    QTest::newRow("compute") << static_cast<int>(solver::ExecutorKind::compute) << 0;
    QTest::newRow("compute, in layers") << static_cast<int>(solver::ExecutorKind::compute) << 256;
    QTest::newRow("stream") << static_cast<int>(solver::ExecutorKind::stream) << 0;
    QTest::newRow("stream, in layers") << static_cast<int>(solver::ExecutorKind::stream) << 512;
  }
  void an_executors_own_memory_gives_the_same_picture() {
    QFETCH(int, kind);
    QFETCH(int, largest_texture);
    // Pages of 16 x 16 x 1, of which a layer has 16 x 16 or 32 x 32, and a ball that needs more.
    const bool is_layered = largest_texture > 0;
    const Index3 page_shape = is_layered ? Index3(16, 16, 1) : kDefaultPageShape;
    const double radius_mm = is_layered ? 0.09 * largest_texture : 22.0;
    const Geometry geometry = grid(is_layered ? Index3(2.0 * radius_mm + 20.0) : Index3(64, 64, 48));
    const Scene scene = ball_scene(geometry, radius_mm);
    gpu::DeviceOptions wanted;
    wanted.debug = true;
    wanted.largest_texture = largest_texture;
    auto device = gpu::Device::create_headless(wanted);
    QCOMPARE(failure(device), QString());
    solver::Parameters parameters;
    parameters.target = 100.0;
    parameters.range = 50.0;
    solver::ExecutorOptions options;
    options.device = *device;
    options.page_shape = page_shape;
    auto executor =
        solver::make_executor(static_cast<solver::ExecutorKind>(kind), scene.source, parameters, options);
    QCOMPARE(failure(executor), QString());
    const double seed_mm = is_layered ? radius_mm - 2.0 : 5.0;
    QCOMPARE(failure((*executor)->paint({scene.middle, seed_mm}, solver::Brush::add)), QString());
    const PageLayout layout = (*executor)->snapshot()->layout;
    auto of_copy = renderer::GlRenderer::create(*device, scene.source, layout);
    auto of_memory = renderer::GlRenderer::create(*device, scene.source, layout);
    QCOMPARE(failure(of_copy), QString());
    QCOMPARE(failure(of_memory), QString());
    renderer::SliceView pages;
    pages.content = renderer::SliceContent::pages;
    pages.position_mm = scene.middle;
    for (int run = 0; run < 4; ++run) {
      QCOMPARE(failure((*executor)->advance({is_layered ? 5 : 20})), QString());
      const auto quiet = (*executor)->quiet_pages();
      const auto looks = (*of_memory)->look_at(**executor, *quiet);
      QCOMPARE(failure(looks), QString());
      QVERIFY(*looks);
      const auto phi = (*executor)->snapshot();
      QCOMPARE(failure((*of_copy)->set_phi(*phi, *quiet)), QString());
      QVERIFY((*of_memory)->draw(renderer::VolumeView(), {96, 96})->pixels ==
              (*of_copy)->draw(renderer::VolumeView(), {96, 96})->pixels);
      QVERIFY((*of_memory)->draw(pages, {96, 96})->pixels == (*of_copy)->draw(pages, {96, 96})->pixels);
    }
    solver::PackedView view;
    QVERIFY((*executor)->packed_view(view));
    QCOMPARE(view.phi->layers() > 1, is_layered);
    const solver::PackedLayout packed(layout, (*device)->capabilities());
    QCOMPARE(packed.texture_size((*executor)->memory().resident_pages).z > 1,
             is_layered);  // of the copy, too
    QCOMPARE((*device)->severe_messages(), 0);
  }

  void phi_of_another_grid_is_refused() {
    Painter draw(ball_scene(grid({32, 32, 32}), 8.0));
    const solver::Field other = solver::Field::empty(grid({32, 32, 31}), 2.5);
    QCOMPARE(draw.renderer().set_phi(other).error().kind, ErrorKind::usage);
    const solver::Field pages = solver::Field::empty(grid({32, 32, 32}), 2.5, {16, 16, 1});
    QCOMPARE(draw.renderer().set_phi(pages).error().kind, ErrorKind::usage);
  }

  void pictures_are_drawn_in_pieces_where_the_processor_is_the_gpu() {
    Painter draw(ball_scene(grid({64, 64, 64}), 20.0));
    draw(renderer::VolumeView(), 512, 512);
    const bool software = draw.device().capabilities().software;
    QVERIFY(software ? draw.gl().last_draw().pieces > 8 : draw.gl().last_draw().pieces == 1);
    // Between two of them it can be stopped.
    std::stop_source stop;
    stop.request_stop();
    Progress progress;
    progress.stop = stop.get_token();
    const auto picture = draw.renderer().draw(renderer::VolumeView(), {512, 512}, progress);
    if (software) QVERIFY(!picture && picture.error().kind == ErrorKind::cancelled);
  }

  // A GPU gets other variants of the shaders, and pictures in one piece.
  void a_gpu_draws_the_same_picture() {
    const Scene scene = ball_scene(grid({44, 40, 37}, {1.0, 1.0, 1.6}), 15.0);
    Painter software(scene);
    Painter hardware(scene, reporting_device(true));
    renderer::VolumeView volume;
    volume.camera.azimuth = 20.0;
    volume.source = transfer_function(
        R"({"source": [{"value": {"ramp": [0, 100]}, "opacity": 0.03, "colour": [1, 0.8, 0.5]}]})");
    volume.surface_colour.a = 0.5F;
    volume.clip = renderer::ClipPlane{{0.0, 0.0, 1.0}, 35.0};
    renderer::VolumeView slices = volume;
    slices.mode = renderer::Mode::slices;
    renderer::SliceView speed;
    speed.content = renderer::SliceContent::speed;
    speed.term = renderer::SpeedTerm::total;
    const auto compare = [&](const auto& view) {
      const renderer::Picture expected = software(view, 160, 120);
      const renderer::Picture found = hardware(view, 160, 120);
      int most = 0;
      for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
        most = std::max(most, std::abs(int(expected.pixels[i]) - int(found.pixels[i])));
      }
      QVERIFY2(most <= 1, qPrintable(QString::number(most)));
    };
    compare(volume);
    compare(slices);
    compare(speed);
    QVERIFY(hardware.gl().last_draw().pieces == 1);
  }

  void a_lost_context_is_reported() {
    Painter draw(ball_scene(grid({32, 32, 32}), 8.0));
    draw.device().lose_at_check(1);
    const auto picture = draw.renderer().draw(renderer::VolumeView(), {64, 64});
    QVERIFY(!picture && picture.error().kind == ErrorKind::capability);
  }
};

TIDEMARK_TEST(PhiPictureTest)

}  // namespace tidemark::test::phi_picture_test

#include "phi_picture_test.moc"
