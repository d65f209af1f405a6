// The terms of the speed for pictures: the processor's side of resources/shaders/render/speed_terms.glsl.
#pragma once

#include <glm/vec3.hpp>

#include "renderer/host/map_samples.h"
#include "renderer/host/phi_pages.h"
#include "renderer/host/source_samples.h"
#include "renderer/views.h"
#include "solver/model.h"

namespace tidemark::renderer {

// What a picture's terms are computed from; all of it outlives them.
struct SpeedTerms {
  const PhiPages& phi;
  const SourceSamples& source;
  const MapSamples* map;  // D where a function evaluates it; null: the tent on the source
  solver::Tent tent;
  solver::StepConstants<float> constants;

  // D, unweighted: the tent of a value of the source.
  [[nodiscard]] float data_of(float value) const;

  // A weighted term, in units of the data term's: 1 is a front that moves at full speed outward. And kappa,
  // the sum of the principal curvatures, per smallest spacing.
  struct Values {
    float speed = 0.0F;
    float curvature = 0.0F;
  };
  [[nodiscard]] Values at(SpeedTerm term, glm::ivec3 voxel) const;
  // Trilinear between voxels.
  [[nodiscard]] Values between(SpeedTerm term, glm::vec3 position) const;
};

}  // namespace tidemark::renderer
