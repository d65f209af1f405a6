// The uniforms of resources/shaders/render for a view. The program is in use.
#pragma once

#include "gpu/program.h"
#include "renderer/views.h"

namespace tidemark::renderer {

// The needs of a view: whether the source shows between surface and clip plane, and whether phi and values
// of the source are needed.
bool shows_source(const VolumeView& view);
bool needs_phi(const VolumeView& view);
bool needs_source(const VolumeView& view);

// A clip plane in voxel coordinates: what lies where dot(normal, p) > offset is hidden.
struct VoxelPlane {
  glm::dvec3 normal{0.0};  // length 1
  double offset = 0.0;
  double mm = 1.0;  // a unit of dot(normal, p), in mm
};
VoxelPlane clip_plane_in_voxels(const ClipPlane& plane, const Geometry& geometry);

// The defines of render/transfer.glsl for this view.
gpu::Defines shading_defines(const VolumeView& view);
// render/transfer.glsl, lighting.glsl and shade.glsl.
void set_shading(const gpu::Program& program, const VolumeView& view, const Geometry& geometry);

}  // namespace tidemark::renderer
