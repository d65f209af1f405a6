// Pictures of a study and its level set, drawn by OpenGL or by the processor (paper sections 5 and 6.2).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/paged_bytes.h"
#include "core/progress.h"
#include "renderer/picture.h"
#include "renderer/quality_control.h"
#include "renderer/views.h"
#include "solver/executor.h"

namespace tidemark::gpu {
class Device;
}

namespace tidemark::renderer {

// The first thing that a ray meets.
struct Hit {
  enum class Kind { clip_plane = 1, surface, source };  // as in render/volume.frag
  Kind kind = Kind::surface;
  glm::dvec3 voxel{0.0};       // voxel coordinates, integers at centres
  glm::dvec3 patient_mm{0.0};  // LPS
};

// Red, green, blue and opacity (0: hidden) of a label.
using LabelColour = std::array<std::uint8_t, 4>;
inline constexpr std::size_t kLabels = 256;  // and none of them, 0

class Renderer {
 public:
  virtual ~Renderer() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;  // "gl" or "host"
  [[nodiscard]] virtual const Volume& source() const = 0;

  // Shows phi from now on. `quiet`: virtual pages that are not computed at present. Fails (ErrorKind::usage)
  // unless phi has the grid of the source and the pages that the renderer was made for.
  virtual Status set_phi(std::shared_ptr<const solver::Field> phi, std::span<const std::int64_t> quiet) = 0;
  Status set_phi(solver::Field phi, std::span<const std::int64_t> quiet = {}) {
    return set_phi(std::make_shared<const solver::Field>(std::move(phi)), quiet);
  }
  // Draws from now on from the memory in which an executor keeps phi. To be called again after each run of
  // steps, and before any picture after another call to the executor. With `quiet` (Executor::quiet_pages())
  // the page views are right, too. Returns false where that memory cannot be drawn from: set_phi() is needed
  // then. Fails (ErrorKind::usage) unless the pages are those that the renderer was made for.
  virtual Result<bool> look_at(solver::Executor& executor,
                               const std::optional<std::vector<std::int64_t>>& quiet) = 0;

  // The parameters of the speed map.
  virtual void set_parameters(const solver::Parameters& parameters) = 0;
  // What drives the surface, for the speed map and its colours; null: the tent of the parameters. D is
  // evaluated where pictures show it.
  virtual void set_speed(std::shared_ptr<const solver::SpeedFunction> speed) = 0;
  // How far the surface has moved since it began, from -1 to 1 (solver::MotionLimit::change()); null: nobody
  // knows.
  virtual void set_change(std::shared_ptr<const solver::SpeedFunction> change) = 0;
  // Walls and anchors, which slices show; null: none. Fails (ErrorKind::usage) when they are on another grid,
  // (ErrorKind::capability) when memory is short.
  virtual Status set_constraints(const solver::Constraints* constraints) = 0;
  // A label for each voxel, 0 for none. Takes time by the slices that lie elsewhere than before. Fails
  // (ErrorKind::usage) when they are on another grid, (ErrorKind::capability) when memory is short.
  virtual Status set_labels(const PagedBytes& labels) = 0;
  // Of the labels from 0 on; at first all are seen, with label_colour(). Fails (ErrorKind::usage) on more
  // than kLabels.
  virtual Status set_label_colours(std::span<const LabelColour> colours) = 0;

  // Fails (ErrorKind::cancelled) on a request to stop, (ErrorKind::capability) when a graphics driver has
  // lost its context.
  virtual Result<Picture> draw(const VolumeView& view, PictureSize size, const Progress& progress) = 0;
  virtual Result<Picture> draw(const SliceView& view, PictureSize size, const Progress& progress) = 0;
  template <class View>
  Result<Picture> draw(const View& view, PictureSize size) {
    return draw(view, size, Progress{});
  }

  // How many pictures of a still view make up the finished one.
  [[nodiscard]] virtual int still_rounds() const = 0;
  // Draws the round of view.quality and adds it to the mean of the rounds of this view before it. Fails as
  // draw() does, and leaves the mean as it was.
  virtual Status add_round(const VolumeView& view, PictureSize size, PictureMean& mean,
                           const Progress& progress) {
    const auto picture = draw(view, size, progress);
    if (!picture) return pass_on(picture);
    mean.add(*picture);
    return {};
  }

  // The first thing at a pixel (from the picture's top left); none when nothing is seen.
  virtual Result<std::optional<Hit>> pick(const VolumeView& view, PictureSize size, glm::dvec2 pixel) = 0;
};

// automatic: gl on a GPU; host where OpenGL is the processor's work or absent.
enum class RendererKind { automatic, host, gl };
// "auto", or what Renderer::name() says; unset for anything else.
std::optional<RendererKind> renderer_named(std::string_view name);
// The kind that is meant on a device, which may be null: host or gl.
RendererKind chosen_kind(RendererKind asked, const gpu::Device* device);

// Pictures of level sets on `source` in pages of this layout. Only gl uses the device, only host the threads
// (0: all processors of this process). Fails (ErrorKind::usage) when the layout is not of the source,
// (ErrorKind::capability) when the driver lacks what is needed.
Result<std::unique_ptr<Renderer>> make_renderer(RendererKind kind, std::shared_ptr<gpu::Device> device,
                                                std::shared_ptr<const Volume> source,
                                                const PageLayout& layout, int threads = 0);

// Shows a copy of what an executor has now: phi, its parameters, and what drives and holds the surface. Fails
// as snapshot(), set_phi() and set_constraints() do.
Status show(Renderer& renderer, const solver::Executor& executor);

}  // namespace tidemark::renderer
