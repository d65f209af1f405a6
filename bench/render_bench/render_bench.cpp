// How long pictures take: still and moving, with and without the skipping of what is empty, and of a level
// set that evolves. See docs/performance.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <variant>
#include <vector>

#include "core/stopwatch.h"
#include "gpu/device.h"
#include "imaging/phantom/phantom.h"
#include "renderer/gl/gl_renderer.h"
#include "renderer/quality_control.h"
#include "renderer/sheet.h"
#include "solver/executor.h"

using namespace tidemark;

namespace {

template <class T>
T expect(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

void expect_done(const Status& status) {
  if (!status) throw std::runtime_error(status.error().message);
}

struct Options {
  std::string kind = "tumour";
  std::string executor = "host";
  std::int64_t side = 512;
  int rounds = 5;
};

// A level set on a phantom, steered to where the phantom's own parameters lead.
struct Study {
  explicit Study(const Options& options) {
    const bool compute = options.executor == "compute";
    device =
        expect(gpu::Device::create_headless({compute ? gpu::GlVersion::gl45 : gpu::GlVersion::gl33, false}));
    imaging::Phantom phantom = expect(imaging::make_phantom(options.kind));
    parameters.target = phantom.target;
    parameters.range = phantom.range;
    parameters.alpha = phantom.alpha;
    source = std::make_shared<const Volume>(std::move(phantom.volume));
    solver::ExecutorOptions executor_options;
    executor_options.device = device;
    const solver::ExecutorKind kind =
        solver::executor_named(options.executor).value_or(solver::ExecutorKind::host);
    executor = expect(solver::make_executor(kind, source, parameters, executor_options));
    if (phantom.seed) {
      const auto& s = *phantom.seed;
      expect_done(
          executor->paint({source->geometry.to_patient({s[0], s[1], s[2]}), s[3]}, solver::Brush::add));
    }
  }

  std::shared_ptr<gpu::Device> device;
  solver::Parameters parameters;
  std::shared_ptr<const Volume> source;
  std::unique_ptr<solver::Executor> executor;
};

class Bench {
 public:
  Bench(const Options& options, Study& study) : options_(options), study_(study) {
    device_ = study.device;
    renderer_ =
        expect(renderer::GlRenderer::create(device_, study.source, study.executor->snapshot()->layout));
    renderer_->set_parameters(study.parameters);
  }

  // Medians over rounds in which the contestants take turns.
  void stills() {
    const solver::Field phi = expect(study_.executor->snapshot());
    expect_done(renderer_->set_phi(phi));
    struct Contestant {
      std::string name;
      std::variant<renderer::SliceView, renderer::VolumeView> view;
      std::int64_t side;
      std::vector<double> seconds;
      double preparing = 0.0;
      double longest_piece = 0.0;
    };
    std::vector<Contestant> contestants;
    const auto enter = [&](const std::string& name, renderer::VolumeView view) {
      view.camera.azimuth = 30.0;
      view.camera.elevation = 20.0;
      view.window = renderer::window_of(*study_.source);
      contestants.push_back({name + ", still", view, options_.side, {}});
      const bool skip_empty = view.quality.skip_empty;
      view.quality = renderer::kMovingQuality;
      view.quality.skip_empty = skip_empty;
      contestants.push_back({name + ", moving", view, options_.side / 2, {}});
    };
    renderer::VolumeView surface;
    enter("surface", surface);
    renderer::VolumeView by_slices = surface;
    by_slices.mode = renderer::Mode::slices;
    enter("surface, slices", by_slices);
    renderer::VolumeView near = surface;
    near.camera = surface.camera.on(renderer::box_around(phi), study_.source->geometry, 1.0);
    enter("surface, fills the picture", near);
    renderer::VolumeView whole = surface;
    whole.quality.skip_empty = false;
    enter("surface, nothing skipped", whole);
    renderer::VolumeView volume = surface;
    volume.source = volume_function();
    enter("surface and source", volume);
    by_slices = volume;
    by_slices.mode = renderer::Mode::slices;
    enter("surface and source, slices", by_slices);
    volume.region = renderer::Region::inside;
    volume.surface = false;
    enter("source inside the surface", volume);
    volume.region = renderer::Region::everywhere;
    volume.clip = renderer::ClipPlane{{0.0, -1.0, 0.0}, -renderer::middle_of(study_.source->geometry).y};
    enter("source with clip plane", volume);
    renderer::SliceView slice;
    slice.window = renderer::window_of(*study_.source);
    slice.position_mm = renderer::middle_of(study_.source->geometry);
    const auto enter_slice = [&](const std::string& name, renderer::SliceContent content,
                                 renderer::SpeedTerm term) {
      slice.content = content;
      slice.term = term;
      contestants.push_back({name, slice, options_.side, {}});
    };
    enter_slice("slice", renderer::SliceContent::source, renderer::SpeedTerm::total);
    enter_slice("slice, speed", renderer::SliceContent::speed, renderer::SpeedTerm::total);
    enter_slice("slice, data term", renderer::SliceContent::speed, renderer::SpeedTerm::data);
    enter_slice("slice, pages", renderer::SliceContent::pages, renderer::SpeedTerm::total);

    for (int round = -1; round < options_.rounds; ++round) {  // the first one compiles
      for (Contestant& c : contestants) {
        const Stopwatch watch;
        expect(std::visit([&](const auto& view) { return renderer_->draw(view, {c.side, c.side}); }, c.view));
        if (round >= 0) c.seconds.push_back(watch.seconds());
        c.preparing = std::max(c.preparing, renderer_->last_draw().prepare_seconds);
        c.longest_piece = std::max(c.longest_piece, renderer_->last_draw().longest_piece_seconds);
      }
    }
    fmt::print("{:42} {:>10} {:>10} {:>12} {:>14} {:>14}\n", "picture", "pixels", "ms", "pictures/s",
               "longest piece", "preparing");
    for (Contestant& c : contestants) {
      std::nth_element(c.seconds.begin(), c.seconds.begin() + c.seconds.size() / 2, c.seconds.end());
      const double median = c.seconds[c.seconds.size() / 2];
      fmt::print("{:42} {:>10} {:>10.1f} {:>12.1f} {:>11.1f} ms {:>11.1f} ms\n", c.name,
                 fmt::format("{}x{}", c.side, c.side), 1e3 * median, 1.0 / median, 1e3 * c.longest_piece,
                 1e3 * c.preparing);
    }
  }

  // The camera turns, and the budget of an interactive picture says how coarse it is.
  void turning() {
    constexpr int kPictures = 60;
    fmt::print("\n{:42} {:>10} {:>12}\n", "turning, within the budget", "pixels", "pictures/s");
    renderer::VolumeView volume;
    volume.source = volume_function();
    renderer::VolumeView inside = volume;
    inside.surface = false;
    inside.region = renderer::Region::inside;
    for (auto [name, view] : {std::pair{"surface", renderer::VolumeView()},
                              {"surface and source", volume},
                              {"source inside the surface", inside}}) {
      renderer::QualityControl control;
      renderer::PictureSize size;
      double seconds = 0.0;
      for (int i = -10; i < kPictures; ++i) {  // the first ones compile, and measure a pixel's cost
        control.moved();
        const renderer::Pass pass = *control.next({options_.side, options_.side});
        view.camera.azimuth = 3.0 * i;
        view.quality = pass.quality;
        const Stopwatch watch;
        expect(renderer_->draw(view, pass.size));
        control.drawn(pass, watch.seconds());
        if (i >= 0) seconds += watch.seconds();
        size = pass.size;
      }
      fmt::print("{:42} {:>10} {:>12.1f}\n", name, fmt::format("{}x{}", size.width, size.height),
                 kPictures / seconds);
    }
  }

  // The level set runs; each picture follows it.
  void evolving() {
    constexpr int kPictures = 40;
    constexpr std::int64_t kStepsPerPicture = 5;
    renderer::VolumeView view;
    view.quality = renderer::kMovingQuality;
    double solving = 0.0;
    double sending = 0.0;
    double drawing = 0.0;
    std::int64_t uploaded = 0;
    std::int64_t resident = 0;
    for (int i = 0; i < kPictures; ++i) {
      Stopwatch watch;
      expect(study_.executor->advance({kStepsPerPicture}));
      solving += watch.seconds();
      watch.restart();
      if (!expect(renderer_->look_at(*study_.executor, std::nullopt))) {
        expect_done(renderer_->set_phi(expect(study_.executor->snapshot())));
      }
      sending += watch.seconds();
      uploaded += renderer_->pages_uploaded();
      resident += study_.executor->memory().resident_pages;
      watch.restart();
      expect(renderer_->draw(view, {options_.side / 2, options_.side / 2}));
      drawing += watch.seconds();
    }
    fmt::print(
        "\nevolving ({}): {} steps a picture, {:.1f} pictures/s; a picture: {:.1f} ms solving, {:.1f} ms "
        "sending {} of {} "
        "pages, {:.1f} ms drawing\n",
        study_.executor->name(), kStepsPerPicture, kPictures / (solving + sending + drawing),
        1e3 * solving / kPictures, 1e3 * sending / kPictures, uploaded / kPictures, resident / kPictures,
        1e3 * drawing / kPictures);
  }

  [[nodiscard]] const gpu::Capabilities& capabilities() const { return device_->capabilities(); }

 private:
  // Brighter than half of what there is.
  [[nodiscard]] renderer::TransferFunction volume_function() const {
    const auto [low, high] = study_.source->range();
    renderer::TransferFunction function;
    renderer::SourcePrimitive bright;
    bright.value = {renderer::TransferFactor::Kind::ramp, 0.5 * (low + high), static_cast<double>(high)};
    bright.opacity = 0.2;
    function.source.push_back(bright);
    return function;
  }

  Options options_;
  Study& study_;
  std::shared_ptr<gpu::Device> device_;
  std::unique_ptr<renderer::GlRenderer> renderer_;
};

void run(const Options& options) {
  Study study(options);
  Bench bench(options, study);
  fmt::print("{}, {}, {} voxels, medians of {} rounds\n\n", bench.capabilities().renderer, options.kind,
             fmt::format("{}x{}x{}", study.source->geometry.size.x, study.source->geometry.size.y,
                         study.source->geometry.size.z),
             options.rounds);
  bench.evolving();
  expect(study.executor->advance({2000, true}));
  bench.stills();
  bench.turning();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Times pictures of a phantom and its level set"};
  Options options;
  app.add_option("--case", options.kind, "A phantom with a seed: tumour, organ, head, ...");
  app.add_option("--executor", options.executor, "host, compute or stream")
      ->check(CLI::IsMember({"host", "compute", "stream"}));
  app.add_option("--side", options.side, "Pixels of the still picture")->check(CLI::Range(64, 4096));
  app.add_option("--rounds", options.rounds)->check(CLI::Range(1, 1000));
  CLI11_PARSE(app, argc, argv);
  try {
    run(options);
  } catch (const std::exception& error) {
    fmt::print(stderr, "render_bench: {}\n", error.what());
    return 1;
  }
  return 0;
}
