#include "renderer/gl/uniforms.h"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/view_setup.h"

namespace tidemark::renderer {
namespace {

// Of one axis, for all primitives.
template <class Primitive>
void set_shapes(const gpu::Program& program, const char* array, const std::vector<Primitive>& primitives,
                TransferFactor Primitive::*axis) {
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const TransferFactor& factor = primitives[i].*axis;
    program.set(fmt::format("{}[{}]", array, i).c_str(), glm::vec2(factor.start, factor.end));
  }
}

template <class Primitive>
void set_materials(const gpu::Program& program, const char* array, const std::vector<Primitive>& primitives) {
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    program.set(fmt::format("{}[{}]", array, i).c_str(),
                glm::vec4(primitives[i].colour, primitives[i].opacity));
  }
}

void set_transfer_function(const gpu::Program& program, const TransferFunction& function) {
  set_shapes(program, "value_shape", function.source, &SourcePrimitive::value);
  set_shapes(program, "gradient_shape", function.source, &SourcePrimitive::gradient);
  set_shapes(program, "phi_shape", function.source, &SourcePrimitive::phi);
  set_materials(program, "source_material", function.source);
  set_shapes(program, "intensity_shape", function.surface, &SurfacePrimitive::intensity);
  set_shapes(program, "distance_shape", function.surface, &SurfacePrimitive::distance);
  set_materials(program, "surface_material", function.surface);
}

template <class Primitive>
std::string kinds(const std::vector<Primitive>& primitives, TransferFactor Primitive::*axis) {
  std::string list;
  for (const Primitive& primitive : primitives) {
    list += fmt::format("{}{}", list.empty() ? "" : ", ", static_cast<int>((primitive.*axis).kind));
  }
  return list;
}

}  // namespace

gpu::Defines shading_defines(const VolumeView& view) {
  const TransferFunction function = view.source.value_or(TransferFunction());
  gpu::Defines defines{{"SOURCE_PRIMITIVES", fmt::to_string(function.source.size())},
                       {"SURFACE_PRIMITIVES", fmt::to_string(function.surface.size())}};
  if (!function.source.empty()) {
    defines.emplace_back("VALUE_KINDS", kinds(function.source, &SourcePrimitive::value));
    defines.emplace_back("GRADIENT_KINDS", kinds(function.source, &SourcePrimitive::gradient));
    defines.emplace_back("PHI_KINDS", kinds(function.source, &SourcePrimitive::phi));
  }
  if (!function.surface.empty()) {
    defines.emplace_back("INTENSITY_KINDS", kinds(function.surface, &SurfacePrimitive::intensity));
    defines.emplace_back("DISTANCE_KINDS", kinds(function.surface, &SurfacePrimitive::distance));
  }
  return defines;
}

void set_shading(const gpu::Program& program, const VolumeView& view, const Geometry& geometry) {
  program.set("spacing", glm::vec3(geometry.spacing_mm));
  program.set("surface_colour", view.surface_colour);
  program.set("region", static_cast<int>(view.region));
  program.set("window", glm::vec2(view.window.centre, view.window.width));
  set_transfer_function(program, view.source.value_or(TransferFunction()));
  program.set("clip", view.clip ? 1 : 0);
  if (view.clip) {
    const VoxelPlane plane = clip_plane_in_voxels(*view.clip, geometry);
    program.set("clip_plane", glm::vec4(plane.normal, plane.offset));
    program.set("clip_mm", static_cast<float>(plane.mm));
  }
  const Lighting& light = view.lighting;
  program.set("light_shares", glm::vec4(light.ambient, light.diffuse, light.specular, light.shininess));
  const glm::dvec3 from = light.from ? glm::transpose(geometry.direction) * *light.from : glm::dvec3(0.0);
  program.set("light_fixed", glm::vec3(from));
}

}  // namespace tidemark::renderer
