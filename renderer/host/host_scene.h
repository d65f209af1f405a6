// All that pictures by the processor are drawn from.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/host/label_samples.h"
#include "renderer/host/map_samples.h"
#include "renderer/host/phi_pages.h"
#include "renderer/host/source_samples.h"
#include "renderer/page_opacity.h"
#include "renderer/view_setup.h"
#include "solver/model.h"
#include "solver/speed/constraints.h"

namespace tidemark::renderer {

struct HostScene {
  HostScene(std::shared_ptr<const Volume> volume, const PageLayout& layout);

  [[nodiscard]] const Geometry& geometry() const { return source.volume().geometry; }
  // The map that a view shows; null: none, or one that is computed from the source.
  [[nodiscard]] MapSamples* map(EvaluatedMap which);
  // The tent that drives the surface where no map does.
  [[nodiscard]] const solver::Tent& tent() const {
    return speed.tent() != nullptr ? *speed.tent() : parameter_tent;
  }

  SourceSamples source;
  PhiPages phi;
  LabelSamples labels;
  MapSamples speed;
  MapSamples doubt;
  MapSamples change;
  solver::StepConstants<float> constants;
  solver::Tent parameter_tent;
  std::optional<solver::Constraints> constraints;
  PageOpacity opacity;
};

}  // namespace tidemark::renderer
