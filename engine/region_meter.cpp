#include "engine/region_meter.h"

#include <utility>
#include <vector>

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

RegionMeter::RegionMeter(CaseProxy& proxy) : proxy_(proxy) {
  connect(&proxy, &CaseProxy::state_changed, this, &RegionMeter::follow_case);
  connect(&proxy.display(), &Display::changed, this, &RegionMeter::follow_case);
}

RegionMeter::Images RegionMeter::images_now() const {
  Images images;
  for (const ShownImage& shown : proxy_.display().settings().images) images.push_back(shown.image);
  return images;
}

void RegionMeter::begin(std::uint8_t label) {
  clear();
  const CaseState& state = proxy_.state();
  label_ = label;
  step_ = state.step;
  edits_ = state.edits;
  images_ = images_now();
  compute();
}

void RegionMeter::compute() {
  const CaseState& state = proxy_.state();
  phi_ = state.phi;
  Wanted wanted{{proxy_.volume().geometry, state.labels, state.label_voxels, state.phi},
                label_,
                {proxy_.name().toStdString(), proxy_.study().volume},
                images_};
  run([wanted = std::move(wanted)](const Progress& progress) { return computed(wanted, progress); },
      [this](Answer measures) {
        measures_ = std::move(measures);
        emit changed();
      });
}

void RegionMeter::clear() {
  give_up();
  images_.clear();
  phi_ = nullptr;
  if (std::exchange(measures_, nullptr) != nullptr) emit changed();
}

void RegionMeter::follow_case() {
  const bool is_same = proxy_.state().step == step_ && proxy_.state().edits == edits_;
  if (!is_same || images_now() != images_) return clear();
  if (label_ != document::kTheSurface || (!busy() && !measures_) || proxy_.state().phi == phi_) return;
  // An edit is heard of before the phi that it has made.
  if (std::exchange(measures_, nullptr) != nullptr) emit changed();
  compute();
}

}  // namespace tidemark::engine
