#include "engine/label_finisher.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/case_proxy.h"

namespace tidemark::engine {
namespace {

using Preview = std::shared_ptr<const LabelPreview>;

Result<Preview> computed(LabelPreview preview, const Progress& progress) {
  auto regions = document::use_tool(preview.use, preview.labels, preview.from, progress);
  if (!regions) return pass_on(regions);
  preview.regions = std::move(*regions);
  const double voxel_ml = preview.from.geometry.voxel_volume_ml();
  std::array<bool, 256> chosen{};
  for (const document::LabelRegion& region : preview.regions) chosen[region.label] = region.label != 0;
  if (const auto& voxels = preview.from.voxels) {
    const auto count =
        std::count_if(voxels->begin(), voxels->end(), [&](std::uint8_t id) { return chosen[id]; });
    preview.before_ml = static_cast<double>(count) * voxel_ml;
  }
  for (const document::LabelRegion& region : preview.regions)
    preview.after_ml += static_cast<double>(region.region.count()) * voxel_ml;
  return std::make_shared<const LabelPreview>(std::move(preview));
}

}  // namespace

LabelFinisher::LabelFinisher(CaseProxy& proxy) : proxy_(proxy) {}

void LabelFinisher::begin(const document::LabelToolUse& use, const std::vector<std::uint8_t>& labels) {
  const CaseState& state = proxy_.state();
  LabelPreview wanted{use, labels, {proxy_.volume().geometry, state.labels, state.label_voxels, state.phi},
                      {},  0.0,    0.0};
  run([wanted = std::move(wanted)](const Progress& progress) { return computed(wanted, progress); },
      [this](Preview preview) {
        preview_ = std::move(preview);
        emit changed();
      });
}

bool LabelFinisher::is_current() const {
  return preview_ != nullptr && preview_->from.voxels == proxy_.state().label_voxels;
}

void LabelFinisher::clear() {
  give_up();
  if (std::exchange(preview_, nullptr) != nullptr) emit changed();
}

void LabelFinisher::apply(document::Take take) {
  if (!is_current()) return;
  proxy_.finish_labels({preview_, &preview_->regions}, take);
  clear();
}

}  // namespace tidemark::engine
