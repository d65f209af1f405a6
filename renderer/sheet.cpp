#include "renderer/sheet.h"

#include <algorithm>
#include <glm/common.hpp>

#include "renderer/annotation.h"
#include "renderer/quality_control.h"
#include "solver/inside_region.h"

namespace tidemark::renderer {
namespace {

void copy_into(Picture& whole, const Picture& part, std::int64_t left, std::int64_t top) {
  for (std::int64_t y = 0; y < part.height; ++y) {
    std::copy_n(part.pixels.begin() + 4 * y * part.width, 4 * part.width,
                whole.pixels.begin() + 4 * ((top + y) * whole.width + left));
  }
}

constexpr std::int64_t kGap = 2;  // pixels between the parts

}  // namespace

Result<Picture> draw_annotated(Renderer& renderer, const SliceView& view, PictureSize size,
                               bool sides_are_known, const Progress& progress) {
  auto picture = renderer.draw(view, size, progress);
  if (!picture) return picture;
  const double half =
      slice_half_height_mm(renderer.source().geometry, view.orientation, view.zoom, size.aspect());
  annotate(*picture, view.orientation.right, view.orientation.up, sides_are_known,
           2.0 * half / static_cast<double>(size.height));
  return picture;
}

Result<Picture> draw_still(Renderer& renderer, const VolumeView& view, PictureSize size,
                           const Progress& progress) {
  // Many pixels need no rounds to look smooth.
  constexpr std::int64_t kManyPixels = 4'000'000;
  const int rounds = size.width * size.height > kManyPixels ? 1 : renderer.still_rounds();
  PictureMean mean;
  VolumeView one = view;
  for (int round = 0; round < rounds; ++round) {
    one.quality.round = round;
    TIDEMARK_TRY(renderer.add_round(one, size, mean, progress.part(round, rounds)));
  }
  return mean.mean();
}

Result<Picture> draw_annotated(Renderer& renderer, const VolumeView& view, PictureSize size,
                               bool sides_are_known, const Progress& progress) {
  auto picture = draw_still(renderer, view, size, progress);
  if (!picture) return picture;
  const double half = view.camera.half_height_mm(renderer.source().geometry, size.aspect());
  annotate(*picture, view.camera.right(), view.camera.up(), sides_are_known,
           2.0 * half / static_cast<double>(size.height));
  return picture;
}

Result<Picture> draw_sheet(Renderer& renderer, const SheetView& view, PictureSize size,
                           const Progress& progress) {
  const PictureSize part{(size.width - 2 * kGap) / 3, (size.height - kGap) / 2};
  Picture whole;
  whole.width = 3 * part.width + 2 * kGap;
  whole.height = 2 * part.height + kGap;
  whole.pixels.resize(static_cast<std::size_t>(4 * whole.width * whole.height));
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) whole.pixels[i] = i % 4 == 3 ? 255 : 60;

  SliceView slice;
  slice.position_mm = view.position_mm;
  slice.window = view.window;
  slice.nearest = view.nearest;
  slice.contours = view.contours;
  constexpr int kPictures = 5;
  int pictures = 0;
  std::int64_t column = 0;
  const auto left = [&](std::int64_t at) { return at * (part.width + kGap); };
  const auto draw = [&](const auto& one, PictureSize its_size) {
    return draw_annotated(renderer, one, its_size, view.sides_are_known,
                          progress.part(pictures++, kPictures));
  };
  for (const SliceOrientation& orientation : {kAxial, kCoronal, kSagittal}) {
    slice.orientation = orientation;
    const auto picture = draw(slice, part);
    if (!picture) return picture;
    copy_into(whole, *picture, left(column++), 0);
  }
  std::int64_t columns_left = 3;
  if (view.speed) {
    slice.orientation = kAxial;
    slice.content = SliceContent::speed;
    slice.term = view.term;
    const auto picture = draw(slice, part);
    if (!picture) return picture;
    copy_into(whole, *picture, 0, part.height + kGap);
    columns_left = 2;
  }
  const PictureSize wide{columns_left * part.width + (columns_left - 1) * kGap, part.height};
  const auto picture = draw(view.volume, wide);
  if (!picture) return picture;
  copy_into(whole, *picture, left(3 - columns_left), part.height + kGap);
  return whole;
}

glm::dvec3 middle_of(const solver::Field& phi) {
  glm::dvec3 sum(0.0);
  std::int64_t found = 0;
  solver::inside_region(phi).for_each_run([&](Index3 voxel, std::int64_t length) {
    const auto voxels = static_cast<double>(length);
    sum += voxels * (glm::dvec3(voxel) + glm::dvec3(0.5 * (voxels - 1.0), 0.0, 0.0));
    found += length;
  });
  // A slice that was taken, not a mixture of two.
  const glm::dvec3 middle =
      found == 0 ? 0.5 * glm::dvec3(phi.geometry.size - Index3(1)) : sum / static_cast<double>(found);
  return phi.geometry.to_patient(glm::floor(middle + 0.5));
}

Box box_around(const solver::Field& phi) {
  const VoxelRange inside = solver::inside_bounds(phi);
  const VoxelRange shown = inside.empty() ? VoxelRange{Index3(0), phi.geometry.size}
                                          : VoxelRange{inside.low - Index3(1), inside.high + Index3(1)};
  return box_around(glm::dvec3(shown.low), glm::dvec3(shown.high - Index3(1)), phi.geometry);
}

Box box_around(glm::dvec3 low, glm::dvec3 high, const Geometry& geometry) {
  Box box{glm::dvec3(1e300), glm::dvec3(-1e300)};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p = geometry.to_patient(
        {corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  }
  return box;
}

WindowLevel window_of(const Volume& source) {
  if (source.window) return *source.window;
  const auto [low, high] = source.common_range();
  return {0.5 * (static_cast<double>(low) + static_cast<double>(high)),
          high > low ? static_cast<double>(high) - static_cast<double>(low) : 1.0};
}

}  // namespace tidemark::renderer
