#include <algorithm>

#include "renderer/gl/canvas_mean.h"
#include "renderer/gl/gl_renderer.h"
#include "tests/renderer/scenes.h"
#include "tests/shaders/variants.h"
#include "tests/solver/formula_speed.h"

namespace tidemark::test {
namespace {

using renderer::SliceView;
using renderer::VolumeView;

// Calls visit(choices), one of `counts[i]` at each place i, for those that differ from all-first in at most
// two places, or from all-last in at most one.
void for_pairs(const std::vector<int>& counts, const std::function<void(const std::vector<int>&)>& visit) {
  for (const bool last : {false, true}) {
    std::vector<int> choices;
    for (const int count : counts) choices.push_back(last ? count - 1 : 0);
    for (std::size_t a = 0; a < counts.size(); ++a) {
      for (std::size_t b = a; b < (last ? a + 1 : counts.size()); ++b) {
        std::vector<int> changed = choices;
        for (changed[a] = 0; changed[a] < counts[a]; ++changed[a]) {
          for (changed[b] = a == b ? changed[a] : 0; changed[b] < counts[b]; ++changed[b]) {
            visit(changed);
            if (a == b) break;
          }
        }
      }
    }
  }
}

// No source, and sources that need more and more.
std::optional<renderer::TransferFunction> transfer_of(int choice) {
  static const char* const kPresets[] = {
      R"({"source": [{"value": {"ramp": [100, 1000]}, "colour": [1, 1, 1], "opacity": 0.2}]})",
      R"({"source": [{"value": {"ramp": [100, 1000]}, "phi": {"gaussian": [0, 2]}, "colour": [1, 1, 1], "opacity": 0.2}]})",
      R"({"surface": [{"intensity": {"ramp": [0, 100]}, "colour": [1, 1, 1], "opacity": 0.5}]})",
      R"({"source": [{"gradient": {"ramp": [0, 50]}, "phi": {"ramp": [0, 2]}, "colour": [1, 1, 1], "opacity": 0.2},
                     {"value": {"gaussian": [100, 50]}, "colour": [1, 1, 1], "opacity": 0.1}],
          "surface": [{"distance": {"gaussian": [0, 5]}, "colour": [1, 1, 1], "opacity": 0.5}, {"colour": [1, 1, 1], "opacity": 0.1}]})"};
  if (choice == 0) return std::nullopt;
  return transfer_function(kPresets[choice - 1]);
}

constexpr renderer::Camera kAlongAxes[] = {{0.0, 0.0}, {90.0, 0.0}, {0.0, 90.0}};

const std::vector<int> kVolumeChoices = {2, 2, 5, 4, 2, 8, 2, 2, 2, 3};

VolumeView volume_view(const std::vector<int>& choices) {
  VolumeView view;
  auto choice = choices.begin();
  view.surface = *choice++ != 0;
  view.label_opacity = *choice++;
  view.source = transfer_of(*choice++);
  view.region = static_cast<renderer::Region>(*choice++);
  if (*choice++ != 0) view.clip = renderer::ClipPlane{};
  view.colouring = static_cast<renderer::SurfaceColouring>(*choice++);
  view.lighting.occlusion = *choice++;
  view.quality.fast_gradient = *choice++ != 0;
  view.quality.skip_empty = *choice++ == 0;
  view.camera = kAlongAxes[*choice];
  return view;
}

const std::vector<int> kSliceChoices = {3, 5, 2, 2};

SliceView slice_view(const std::vector<int>& choices, glm::dvec3 middle) {
  SliceView view;
  view.position_mm = middle;
  view.content = static_cast<renderer::SliceContent>(choices[0]);
  view.term = static_cast<renderer::SpeedTerm>(choices[1]);
  view.change = choices[2] != 0;
  if (choices[3] != 0) {
    auto images = std::make_shared<renderer::ImagesOver>();
    images->width = images->height = 1;
    images->rgba = {0, 0, 0, 0};
    view.images = images;
  }
  return view;
}

class InDoubt final : public FormulaSpeed {
 public:
  using FormulaSpeed::FormulaSpeed;
  [[nodiscard]] bool has_doubt() const override { return true; }
  void evaluate_doubt(const solver::VoxelBox& box, double* doubt) const override {
    std::fill_n(doubt, box.voxels(), 0.5);
  }
};

constexpr char kKnown[] = "the variant is known now";
constexpr renderer::PictureSize kSize{16, 12};

// A renderer of whose many programs none is compiled once its views are known to be drawn.
class Listener {
 public:
  Listener(bool as_gpu, std::int64_t largest_volume, std::vector<gpu::ProgramSource>& found)
      : scene_(ball_scene(grid({24, 20, 18}), 6.0)), device_(reporting_device(as_gpu, largest_volume)) {
    device_->on_program([this, &found](const gpu::ProgramSource& program) -> Status {
      found.push_back(program);
      if (compiles_) return {};
      return fail(ErrorKind::internal, kKnown);
    });
    auto made = renderer::GlRenderer::create(device_, scene_.source, scene_.phi.layout);
    must(made);
    renderer_ = std::move(*made);
    must(renderer_->set_phi(scene_.phi));
    PagedBytes labels(scene_.source->geometry.size);
    labels.fill(Index3(0), Index3(1), 1);
    must(renderer_->set_labels(labels));
    renderer_->set_change(std::make_shared<FormulaSpeed>([](glm::dvec3) { return 0.1; }));
  }

  // What views need beside the program of their own: slices of each axis, and what lies over the background.
  void draw_in_full() {
    compiles_ = true;
    for (const renderer::Camera& camera : kAlongAxes) {
      VolumeView view;
      view.mode = renderer::Mode::slices;
      view.camera = camera;
      must(renderer_->draw(view, kSize));
    }
    must(renderer::CanvasMean::create(*device_));
    compiles_ = false;
  }
  void ask_for_all() {
    for_pairs(kVolumeChoices, [&](const std::vector<int>& choices) {
      VolumeView view = volume_view(choices);
      ask(renderer_->draw(view, kSize));
      ask(renderer_->pick(view, kSize, {8, 6}));
      view.mode = renderer::Mode::slices;
      ask(renderer_->draw(view, kSize));
    });
    for_pairs(kSliceChoices, [&](const std::vector<int>& choices) {
      ask(renderer_->draw(slice_view(choices, scene_.middle), kSize));
    });
  }
  void wall() {
    solver::Constraints walls(scene_.source->geometry.size);
    walls.set({{3, 4, 5}}, solver::Constraint::wall);
    must(renderer_->set_constraints(&walls));
  }
  void set_speed(std::shared_ptr<const solver::SpeedFunction> speed) {
    renderer_->set_speed(std::move(speed));
  }

 private:
  template <class T>
  static void must(const Result<T>& result) {
    if (!result) qFatal("%s", result.error().message.c_str());
  }
  template <class T>
  static void ask(const Result<T>& result) {
    // A view may be drawn where its program was compiled before.
    if (!result && result.error().message != kKnown) qFatal("%s", result.error().message.c_str());
  }

  Scene scene_;
  std::shared_ptr<gpu::Device> device_;
  bool compiles_ = true;
  std::unique_ptr<renderer::GlRenderer> renderer_;
};

}  // namespace

std::vector<gpu::ProgramSource> renderer_variants() {
  const auto speed = [](glm::dvec3) { return 0.5; };
  const auto flow = [](glm::dvec3) { return glm::vec3(0.1F); };
  std::vector<gpu::ProgramSource> programs;
  Listener processor(false, 0, programs);
  processor.draw_in_full();
  processor.ask_for_all();
  processor.set_speed(std::make_shared<InDoubt>(speed));
  processor.ask_for_all();
  // Neither the driver nor the source's texture matters to what drives the surface.
  Listener gpu(true, 0, programs);
  gpu.set_speed(std::make_shared<FormulaSpeed>(speed, flow, 0.2));
  gpu.wall();
  gpu.draw_in_full();
  gpu.ask_for_all();
  Listener without_volume(true, 16, programs);
  without_volume.draw_in_full();
  without_volume.ask_for_all();
  return programs;
}

}  // namespace tidemark::test
