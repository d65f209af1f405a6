// The uniforms of resources/shaders/render for a view. The program is in use.
#pragma once

#include "gpu/program.h"
#include "renderer/views.h"

namespace tidemark::renderer {

// The defines of render/transfer.glsl for this view.
gpu::Defines shading_defines(const VolumeView& view);
// render/transfer.glsl, lighting.glsl and shade.glsl.
void set_shading(const gpu::Program& program, const VolumeView& view, const Geometry& geometry);

}  // namespace tidemark::renderer
