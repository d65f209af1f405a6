// The preparation of a view: what renderers work out of it before they draw.
#pragma once

#include <glm/mat4x4.hpp>

#include "renderer/picture.h"
#include "renderer/views.h"

namespace tidemark::renderer {

// The needs of a view: whether the source shows between surface and clip plane, and whether phi and values
// of the source are needed.
bool shows_source(const VolumeView& view);
bool needs_phi(const VolumeView& view);
bool needs_source(const VolumeView& view);

// The maps that are evaluated where pictures show them: D, its doubt, and how far the surface has moved.
enum class EvaluatedMap { none, speed, doubt, change };
EvaluatedMap map_of(const VolumeView& view);
EvaluatedMap map_of(const SliceView& view);

// The view in the source's own units, whose common range is given, with the colours that it really has.
VolumeView resolved(const VolumeView& asked, std::pair<float, float> common_range, bool has_change);

// A clip plane in voxel coordinates: what lies where dot(normal, p) > offset is hidden.
struct VoxelPlane {
  glm::dvec3 normal{0.0};  // length 1
  double offset = 0.0;
  double mm = 1.0;  // a unit of dot(normal, p), in mm
};
VoxelPlane clip_plane_in_voxels(const ClipPlane& plane, const Geometry& geometry);

// Where in a pixel the rays of a round are, in pixels from its middle. Nine rounds are a lattice with one
// place in each ninth of the pixel's width and height. The first of them is the middle, and the first three
// are a lattice, too.
glm::dvec2 offset_of_round(int round);
// Moves a view by so many pixels of a picture.
glm::dmat4 moved_by(glm::dvec2 pixels, PictureSize size);
// Of the round's picture of that size, to voxel coordinates.
glm::dmat4 voxel_from_view(const VolumeView& view, const Geometry& geometry, PictureSize size);

}  // namespace tidemark::renderer
