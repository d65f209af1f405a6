// The views of the golden pictures.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tests/renderer/scenes.h"

namespace tidemark::test {

// A phantom with the distance to its truth as the level set, and a painter of it.
struct Patient {
  Patient(const char* kind, renderer::RendererKind renderer, int threads = 0);

  Scene scene;
  solver::Parameters parameters;
  WindowLevel window;
  PagedBytes labels;
  std::unique_ptr<Painter> painter;
  // Of rays, in place of the views' own, to compare pictures whose samples are at other places.
  std::optional<double> step_voxels;
};

struct Golden {
  using Draw = std::function<Result<renderer::Picture>(Patient&)>;

  const char* patient;
  Draw draw;
  bool is_slice = false;  // and nothing in 3D
};

// By name.
using GoldenViews = std::map<std::string, Golden>;
const GoldenViews& golden_views();

}  // namespace tidemark::test
