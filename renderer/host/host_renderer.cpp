#include "renderer/host/host_renderer.h"

#include <algorithm>
#include <bit>

#include "renderer/host/slice_painter.h"
#include "renderer/host/volume_painter.h"
#include "solver/host/page_view.h"
#include "solver/speed/doubt_map.h"
#include "solver/speed/tent_speed.h"

namespace tidemark::renderer {

HostRenderer::HostRenderer(std::shared_ptr<const Volume> source, const PageLayout& layout, int threads)
    : volume_(std::move(source)), scene_(volume_, layout), threads_(threads) {
  set_parameters(solver::Parameters());
}

Result<std::unique_ptr<HostRenderer>> HostRenderer::create(std::shared_ptr<const Volume> source,
                                                           const PageLayout& layout, int threads) {
  if (layout.domain_size() != source->geometry.size) {
    return fail(ErrorKind::usage, "the pages are not those of the volume");
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::has_single_bit(static_cast<std::uint64_t>(layout.page_shape()[axis]))) {
      return fail(ErrorKind::usage, "pictures need pages whose sides are powers of two");
    }
  }
  return std::unique_ptr<HostRenderer>(new HostRenderer(std::move(source), layout, threads));
}

Status HostRenderer::set_phi(std::shared_ptr<const solver::Field> phi, std::span<const std::int64_t> quiet) {
  if (phi->geometry.size != volume_->geometry.size || phi->layout != scene_.phi.layout()) {
    return fail(ErrorKind::usage, "phi and the volume differ in size or in pages");
  }
  scene_.phi.show(std::move(phi), quiet);
  return {};
}

Result<bool> HostRenderer::look_at(solver::Executor& executor,
                                   const std::optional<std::vector<std::int64_t>>& quiet) {
  solver::PageView view;
  if (!executor.page_view(view)) return false;
  if (view.memory->layout() != scene_.phi.layout()) {
    return fail(ErrorKind::usage, "pictures and executor differ in pages");
  }
  scene_.phi.show(view, quiet);
  return true;
}

void HostRenderer::set_parameters(const solver::Parameters& parameters) {
  const solver::TentSpeed tent(volume_, parameters);
  scene_.constants = solver::Model(volume_->geometry, parameters, tent).constants<float>();
  scene_.parameter_tent = solver::tent_of(parameters);
}

void HostRenderer::set_speed(std::shared_ptr<const solver::SpeedFunction> speed) {
  scene_.doubt.set_function(solver::doubt_map(speed));
  scene_.speed.set_function(std::move(speed));
}

void HostRenderer::set_change(std::shared_ptr<const solver::SpeedFunction> change) {
  scene_.change.set_function(std::move(change));
}

Status HostRenderer::set_constraints(const solver::Constraints* constraints) {
  if (constraints == nullptr || constraints->empty()) {
    scene_.constraints.reset();
    return {};
  }
  if (constraints->layout().domain_size() != volume_->geometry.size) {
    return fail(ErrorKind::usage, "walls and anchors are on another grid than the volume");
  }
  scene_.constraints = *constraints;
  return {};
}

Status HostRenderer::set_labels(const PagedBytes& labels) {
  if (labels.size() != volume_->geometry.size)
    return fail(ErrorKind::usage, "labels are on another grid than the volume");
  scene_.labels.set_voxels(labels);
  return {};
}

Status HostRenderer::set_label_colours(std::span<const LabelColour> colours) {
  if (colours.size() > kLabels) return fail(ErrorKind::usage, "there are more than {} labels", kLabels);
  scene_.labels.set_colours(colours);
  return {};
}

VolumeView HostRenderer::resolved(const VolumeView& asked) {
  if (asked.source && !common_range_) common_range_ = volume_->common_range();
  return renderer::resolved(asked, common_range_.value_or(std::pair(0.0F, 1.0F)),
                            scene_.change.is_evaluated());
}

Result<Picture> HostRenderer::draw(const VolumeView& view, PictureSize size, const Progress& progress) {
  LastPictures::Drawn drawn{resolved(view), size, scene_.phi.revision(), {}};
  const bool can_keep = LastPictures::can_keep(scene_, drawn.view, size);
  const LastPictures::Drawn* const last = can_keep ? last_pictures_.of(drawn.view, size) : nullptr;
  std::vector<std::uint8_t> changed;  // empty: all pixels
  if (last != nullptr) {
    drawn.picture = last->picture;
    changed = changed_pixels(scene_, *last);
    const auto count = std::count(changed.begin(), changed.end(), std::uint8_t{1});
    drawn.picture.painted = static_cast<double>(count) / static_cast<double>(changed.size());
  } else {
    drawn.picture = {size.width, size.height,
                     std::vector<std::uint8_t>(static_cast<std::size_t>(4 * size.width * size.height))};
  }
  TIDEMARK_TRY(paint_volume(scene_, drawn.view, drawn.picture, changed, threads_, progress));
  Picture picture = drawn.picture;
  if (can_keep) last_pictures_.keep(std::move(drawn));
  return picture;
}

Status HostRenderer::add_round(const VolumeView& view, PictureSize size, PictureMean& mean,
                               const Progress& progress) {
  if (mean.count() == 0 || mean.size() != size) return Renderer::add_round(view, size, mean, progress);
  Picture picture = mean.mean();
  TIDEMARK_TRY(paint_volume(scene_, resolved(view), picture, uneven_pixels(picture), threads_, progress));
  mean.add(picture);
  return {};
}

Result<Picture> HostRenderer::draw(const SliceView& view, PictureSize size, const Progress& progress) {
  return paint_slice(scene_, view, size, threads_, progress);
}

Result<std::optional<Hit>> HostRenderer::pick(const VolumeView& view, PictureSize size, glm::dvec2 pixel) {
  VolumeView finely = resolved(view);
  finely.quality = {};
  return pick_volume(scene_, finely, size, pixel, threads_);
}

}  // namespace tidemark::renderer
