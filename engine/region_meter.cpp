#include "engine/region_meter.h"

#include <utility>
#include <vector>

#include "document/label_tool.h"
#include "engine/case_proxy.h"

namespace tidemark::engine {
namespace {

// What is measured, as values.
struct Wanted {
  document::LabelVoxels from;
  std::uint8_t label = document::kTheSurface;
  document::MeasuredImage study;
  std::vector<std::shared_ptr<const document::CaseImage>> images;
};

using Answer = std::shared_ptr<const document::Measures>;

Result<Answer> computed(const Wanted& wanted, const Progress& progress) {
  const Geometry& grid = wanted.from.geometry;
  const auto images = document::images_on(grid, wanted.study, wanted.images, progress);
  if (!images) return pass_on(images);
  const solver::Field* const phi = wanted.label == document::kTheSurface ? wanted.from.phi.get() : nullptr;
  auto measures = document::measure(wanted.from.region(wanted.label), grid, *images, phi, progress);
  if (!measures) return pass_on(measures);
  return std::make_shared<const document::Measures>(std::move(*measures));
}

}  // namespace

RegionMeter::RegionMeter(QObject* parent) : JobRunner(parent) {}

void RegionMeter::begin(CaseProxy& proxy, std::uint8_t label) {
  const CaseState& state = proxy.state();
  Wanted wanted{{proxy.volume().geometry, state.labels, state.label_voxels, state.phi},
                label,
                {proxy.name().toStdString(), proxy.study().volume},
                {}};
  for (const ShownImage& shown : proxy.display().settings().images) wanted.images.push_back(shown.image);
  run([wanted = std::move(wanted)](const Progress& progress) { return computed(wanted, progress); },
      [this](const Answer& measures) { emit measured(measures); });
}

}  // namespace tidemark::engine
