// How long pictures of a CT take: by the processor, by OpenGL, and by VTK's ray caster, which take turns.
#include <fmt/format.h>
#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <vector>

#include "bench/picture_bench/ct_phantom.h"
#include "bench/picture_bench/vtk_peer.h"
#include "core/stopwatch.h"
#include "gpu/device.h"
#include "imaging/files/png_file.h"
#include "imaging/load_study.h"
#include "imaging/phantom/phantom.h"
#include "renderer/quality_control.h"
#include "renderer/renderer.h"
#include "renderer/sheet.h"

using namespace tidemark;

namespace {

template <class T>
T expect(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().message);
  return std::move(*result);
}

struct Options {
  std::string study;  // none: the phantom
  std::vector<std::string> presets{"ct-bone", "ct-soft-tissue", "ct-lung", "ct-angio"};
  std::vector<std::int64_t> sides{512};
  std::vector<std::int64_t> size{512, 512, 275};
  int rounds = 3;
  bool gl = false;
  bool vtk = true;
  std::string pictures;  // folder
  std::string python = "python3";
};

std::shared_ptr<const Volume> study_of(const Options& options) {
  if (!options.study.empty())
    return std::make_shared<const Volume>(expect(imaging::load_volume(options.study)));
  return std::make_shared<const Volume>(
      bench::ct_phantom({options.size[0], options.size[1], options.size[2]}));
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + std::ssize(values) / 2, values.end());
  return values[values.size() / 2];
}

std::int64_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{1024} * usage.ru_maxrss;
}

// Of all threads: on a busy machine it says more than the clock.
double processor_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

class Bench {
 public:
  explicit Bench(const Options& options) : options_(options), source_(study_of(options)) {
    const PageLayout layout(source_->geometry.size, kDefaultPageShape);
    const std::int64_t before = peak_bytes();
    const Stopwatch watch;
    host_ = expect(renderer::make_renderer(renderer::RendererKind::host, nullptr, source_, layout));
    fmt::print("{} x {} x {} voxels, {} MB; host renderer made in {:.0f} ms\n", source_->geometry.size.x,
               source_->geometry.size.y, source_->geometry.size.z,
               2 * source_->geometry.voxel_count() / 1'000'000, 1e3 * watch.seconds());
    before_ = before;
    if (options.gl) {
      device_ = expect(gpu::Device::create_headless({gpu::GlVersion::gl33, false}));
      gl_ = expect(renderer::make_renderer(renderer::RendererKind::gl, device_, source_, layout));
    }
    if (options.vtk) peer_ = start(bench::VtkPeer::Mapper::processor);
    if (options.vtk && options.gl) gl_peer_ = start(bench::VtkPeer::Mapper::opengl);
  }

  void run() {
    fmt::print("\n{:18} {:>6} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10} {:>8} {:>10}\n", "preset",
               "side", "first ms", "ray ms", "cpu ms", "still ms", "gl ray ms", "vtk ms", "vtk first",
               "ray/vtk", "vtk gl ms");
    for (const std::string& preset : options_.presets) {
      for (const std::int64_t side : options_.sides) compare(preset, side);
    }
    fmt::print("\n{:18} {:>12} {:>12}\n", "turning", "pixels", "pictures/s");
    for (const std::string& preset : options_.presets) turn(preset, options_.sides.front());
    fmt::print("\nmemory beside the source and before pictures: {} MB\n",
               (peak_bytes() - before_) / 1'000'000);
  }

 private:
  [[nodiscard]] std::unique_ptr<bench::VtkPeer> start(bench::VtkPeer::Mapper mapper) const {
    auto peer =
        bench::VtkPeer::start(mapper, *source_, std::filesystem::temp_directory_path(), options_.python);
    fmt::print("{}\n", peer ? "VTK " + (*peer)->version() : peer.error().message);
    return peer ? std::move(*peer) : nullptr;
  }

  [[nodiscard]] renderer::VolumeView view_of(const std::string& preset) const {
    renderer::VolumeView view;
    view.source = expect(renderer::preset(preset));
    view.surface = false;
    view.camera.azimuth = 30.0;
    view.camera.elevation = 20.0;
    return view;
  }

  void compare(const std::string& preset, std::int64_t side) {
    renderer::VolumeView view = view_of(preset);
    const renderer::PictureSize size{side, side};
    const auto timed = [](const auto& work) {
      const Stopwatch watch;
      work();
      return watch.seconds();
    };
    // From somewhere else each time: a renderer keeps what it drew from there last.
    const auto elsewhere = [&] { view.camera.azimuth += 0.01; };
    const auto one = [&](renderer::Renderer& by) {
      elsewhere();
      (void)expect(by.draw(view, size));
    };
    const double first = timed([&] { one(*host_); });
    if (gl_) one(*gl_);
    std::vector<double> rays, processor, stills, gl, vtk, vtk_gl;
    double vtk_first = 0.0;
    const auto [low, high] = source_->common_range();
    const renderer::TransferFunction function = view.source->for_range(low, high);
    // VTK samples in mm; a step of a voxel is that of the smallest spacing.
    const glm::dvec3 spacing = source_->geometry.spacing_mm;
    const double step = std::min({spacing.x, spacing.y, spacing.z});
    for (int round = 0; round < options_.rounds; ++round) {
      const double begin = processor_seconds();
      rays.push_back(timed([&] { one(*host_); }));
      processor.push_back(processor_seconds() - begin);
      elsewhere();
      stills.push_back(timed([&] { (void)expect(renderer::draw_still(*host_, view, size)); }));
      if (gl_) gl.push_back(timed([&] { one(*gl_); }));
      const auto peer_draws = [&](bench::VtkPeer& peer, const char* name) {
        return expect(peer.draw(function, side, step, view.camera.half_height_mm(source_->geometry, 1.0),
                                view.camera, picture_file(name, preset, side)));
      };
      if (gl_peer_) vtk_gl.push_back(peer_draws(*gl_peer_, "vtk-gl").seconds);
      if (peer_) {
        const auto drawing = peer_draws(*peer_, "vtk");
        vtk.push_back(drawing.seconds);
        if (round == 0) vtk_first = drawing.first_seconds;
      }
    }
    const auto ms = [](const std::vector<double>& values) {
      return values.empty() ? std::string("-") : fmt::format("{:.0f}", 1e3 * median(values));
    };
    fmt::print("{:18} {:>6} {:>10.0f} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10.0f} {:>8} {:>10}\n", preset,
               side, 1e3 * first, ms(rays), ms(processor), ms(stills), ms(gl), ms(vtk), 1e3 * vtk_first,
               vtk.empty() ? "-" : fmt::format("{:.2f}", median(rays) / median(vtk)), ms(vtk_gl));
    keep(expect(renderer::draw_still(*host_, view, size)), "host", preset, side);
    if (gl_) keep(expect(renderer::draw_still(*gl_, view, size)), "gl", preset, side);
  }

  // The camera turns, and the budget of an interactive picture says how coarse it is.
  void turn(const std::string& preset, std::int64_t side) {
    constexpr int kPictures = 40;
    renderer::VolumeView view = view_of(preset);
    renderer::QualityControl control;
    renderer::PictureSize size;
    double seconds = 0.0;
    for (int i = -10; i < kPictures; ++i) {  // the first ones measure what a pixel costs
      control.moved();
      const renderer::Pass pass = *control.next({side, side});
      view.camera.azimuth = 3.0 * i;
      view.quality = pass.quality;
      const Stopwatch watch;
      (void)expect(host_->draw(view, pass.size));
      control.drawn(pass, watch.seconds());
      if (i >= 0) seconds += watch.seconds();
      size = pass.size;
    }
    fmt::print("{:18} {:>12} {:>12.1f}\n", preset, fmt::format("{}x{}", size.width, size.height),
               kPictures / seconds);
  }

  [[nodiscard]] std::filesystem::path picture_file(const std::string& by, const std::string& preset,
                                                   std::int64_t side) const {
    if (options_.pictures.empty()) return {};
    return std::filesystem::path(options_.pictures) / fmt::format("{}-{}-{}.png", preset, side, by);
  }
  void keep(const renderer::Picture& picture, const std::string& by, const std::string& preset,
            std::int64_t side) const {
    const auto file = picture_file(by, preset, side);
    if (file.empty()) return;
    const Status written = imaging::write_png_file(picture.width, picture.height, picture.pixels, file);
    if (!written) throw std::runtime_error(written.error().message);
  }

  Options options_;
  std::shared_ptr<const Volume> source_;
  std::shared_ptr<gpu::Device> device_;
  std::unique_ptr<renderer::Renderer> host_;
  std::unique_ptr<renderer::Renderer> gl_;
  std::unique_ptr<bench::VtkPeer> peer_;
  std::unique_ptr<bench::VtkPeer> gl_peer_;
  std::int64_t before_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Times pictures of a CT by the processor, by OpenGL and by VTK"};
  Options options;
  app.add_option("--study", options.study, "A study instead of the phantom of a chest");
  app.add_option("--preset", options.presets, "Transfer functions");
  app.add_option("--side", options.sides, "Pixels a side")->check(CLI::Range(64, 4096));
  app.add_option("--size", options.size, "Voxels of the phantom")->expected(3);
  app.add_option("--rounds", options.rounds)->check(CLI::Range(1, 100));
  app.add_flag("--gl", options.gl, "OpenGL takes part, ours and VTK's, which takes minutes without a GPU");
  app.add_flag("!--no-vtk", options.vtk, "VTK does not take part");
  app.add_option("--python", options.python, "The Python that has VTK");
  app.add_option("--pictures", options.pictures, "Keeps the pictures in this folder");
  CLI11_PARSE(app, argc, argv);
  try {
    Bench(options).run();
  } catch (const std::exception& error) {
    fmt::print(stderr, "picture_bench: {}\n", error.what());
    return 1;
  }
  return 0;
}
