#include "renderer/view_setup.h"

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

namespace tidemark::renderer {

bool shows_source(const VolumeView& view) {
  return view.source && !view.source->source.empty();
}

bool needs_phi(const VolumeView& view) {
  return view.surface ||
         (shows_source(view) && (view.region != Region::everywhere || view.source->source_needs_phi()));
}

bool needs_source(const VolumeView& view) {
  const bool speed_colours =
      view.colouring == SurfaceColouring::data || view.colouring == SurfaceColouring::total_speed;
  return shows_source(view) || (view.clip && view.clip->picture) ||
         (view.surface && (speed_colours || (view.source && !view.source->surface.empty())));
}

EvaluatedMap map_of(const VolumeView& view) {
  switch (view.colouring) {
    case SurfaceColouring::change:
      return EvaluatedMap::change;
    case SurfaceColouring::total_speed:
    case SurfaceColouring::data:
      return EvaluatedMap::speed;
    default:
      return EvaluatedMap::none;
  }
}

EvaluatedMap map_of(const SliceView& view) {
  switch (view.content) {
    case SliceContent::source:
      return view.change ? EvaluatedMap::change : EvaluatedMap::none;
    case SliceContent::speed:
      return view.term == SpeedTerm::doubt ? EvaluatedMap::doubt : EvaluatedMap::speed;
    case SliceContent::pages:
      break;
  }
  return EvaluatedMap::none;
}

VolumeView resolved(const VolumeView& asked, std::pair<float, float> common_range, bool has_change) {
  VolumeView view = asked;
  if (view.source) view.source = view.source->for_range(common_range.first, common_range.second);
  if (view.change && view.colouring == SurfaceColouring::plain && has_change) {
    view.colouring = SurfaceColouring::change;
  }
  // White would hide the colours.
  if (view.colouring != SurfaceColouring::plain) view.lighting.specular = 0.0;
  return view;
}

VoxelPlane clip_plane_in_voxels(const ClipPlane& plane, const Geometry& geometry) {
  // dot(normal, p) - offset in mm is linear in the voxel coordinates.
  const glm::dvec3 zero = geometry.to_patient(glm::dvec3(0.0));
  glm::dvec3 slope(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    slope[axis] = glm::dot(plane.normal, geometry.direction[axis]) * geometry.spacing_mm[axis];
  }
  const double mm = glm::length(slope);
  return {slope / mm, (plane.offset_mm - glm::dot(plane.normal, zero)) / mm, mm};
}

glm::dvec2 offset_of_round(int round) {
  constexpr int kRows = 9;
  constexpr int kSlope = 2;
  const int place = round % 3 * 3 + round / 3 % 3;
  const auto from_middle = [](int row) { return (row % kRows + kRows / 2) % kRows - kRows / 2; };
  return glm::dvec2(from_middle(place), from_middle(kSlope * place)) / static_cast<double>(kRows);
}

glm::dmat4 moved_by(glm::dvec2 pixels, PictureSize size) {
  return glm::translate(glm::dmat4(1.0), glm::dvec3(2.0 * pixels / glm::dvec2(size.width, size.height), 0.0));
}

glm::dmat4 voxel_from_view(const VolumeView& view, const Geometry& geometry, PictureSize size) {
  return view.camera.voxel_from_view(geometry, size.aspect()) *
         moved_by(offset_of_round(view.quality.round), size);
}

}  // namespace tidemark::renderer
