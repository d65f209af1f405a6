#include "engine/label_finisher.h"

#include <algorithm>
#include <array>
#include <utility>

#include "engine/case_proxy.h"

namespace tidemark::engine {
namespace {

using Preview = std::shared_ptr<const LabelPreview>;

// How many voxels have one of the labels.
std::int64_t count(const SharedSlices& voxels, const std::array<bool, 256>& labels) {
  std::int64_t count = 0;
  for (std::int64_t k = 0; k < voxels.size().z; ++k) {
    const auto slice = voxels.slice(k);
    count += std::count_if(slice.begin(), slice.end(), [&](std::uint8_t id) { return labels[id]; });
  }
  return count;
}

// Null: no voxel has a label before.
bool changes(const SharedSlices* before, const SharedSlices& after) {
  const SharedSlices none(after.size());
  const SharedSlices& then = before ? *before : none;
  const auto differ = [&](std::int64_t k) {
    const auto a = then.slice(k);
    const auto b = after.slice(k);
    if (a.empty() || b.empty()) {
      const auto& there = a.empty() ? b : a;
      return std::any_of(there.begin(), there.end(), [](std::uint8_t id) { return id != 0; });
    }
    return !std::equal(a.begin(), a.end(), b.begin());
  };
  const auto slices = after.differing_slices(then);
  return std::any_of(slices.begin(), slices.end(), differ);
}

Result<Preview> computed(LabelPreview preview, const Progress& progress) {
  const document::LabelVoxels& from = preview.from;
  auto regions = document::use_tool(preview.use, preview.labels, from, progress);
  if (!regions) return pass_on(regions);
  preview.regions = std::move(*regions);
  auto after = std::make_shared<document::Labels>(from.geometry);
  TIDEMARK_TRY(after->assign(from.list, from.voxels ? *from.voxels : SharedSlices(from.geometry.size)));
  const auto accepted = after->finish(preview.regions, preview.take);
  if (!accepted) return pass_on(accepted);
  std::array<bool, 256> changed{};
  for (const document::LabelRegion& region : preview.regions) changed[region.label] = region.label != 0;
  const double voxel_ml = from.geometry.voxel_volume_ml();
  if (from.voxels) preview.before_ml = static_cast<double>(count(*from.voxels, changed)) * voxel_ml;
  preview.after_ml = static_cast<double>(accepted->taken) * voxel_ml;
  preview.changes = changes(preview.from.voxels.get(), after->voxels());
  preview.after = std::move(after);
  return std::make_shared<const LabelPreview>(std::move(preview));
}

}  // namespace

LabelFinisher::LabelFinisher(CaseProxy& proxy) : proxy_(proxy) {}

void LabelFinisher::begin(const document::LabelToolUse& use, const std::vector<std::uint8_t>& labels,
                          document::Take take) {
  const CaseState& state = proxy_.state();
  LabelPreview wanted;
  wanted.use = use;
  wanted.labels = labels;
  wanted.from = {proxy_.volume().geometry, state.labels, state.label_voxels, state.phi};
  wanted.take = take;
  asked_ = std::make_shared<const LabelPreview>(std::move(wanted));
  run([wanted = asked_](const Progress& progress) { return computed(*wanted, progress); },
      [this](Preview preview) {
        preview_ = std::move(preview);
        emit changed();
      });
}

bool LabelFinisher::is_of_now(const LabelPreview& preview) const {
  const CaseState& state = proxy_.state();
  return preview.from.voxels == state.label_voxels && preview.from.list == state.labels &&
         (!document::has_surface(preview.use) || preview.from.phi == state.phi);
}

void LabelFinisher::clear() {
  give_up();
  if (std::exchange(preview_, nullptr) != nullptr) emit changed();
}

void LabelFinisher::apply() {
  if (!is_current()) return;
  proxy_.finish_labels({preview_, &preview_->regions}, preview_->take);
  clear();
}

}  // namespace tidemark::engine
