#include "engine/label_finisher.h"

#include <array>
#include <utility>

#include "engine/case_proxy.h"

namespace tidemark::engine {
namespace {

using Preview = std::shared_ptr<const LabelPreview>;

Result<Preview> computed(LabelPreview preview, const Progress& progress) {
  const document::LabelVoxels& from = preview.from;
  auto regions = document::use_tool(preview.use, preview.labels, from, progress);
  if (!regions) return pass_on(regions);
  preview.regions = std::move(*regions);
  auto after = std::make_shared<document::Labels>(from.geometry);
  const PagedBytes before = from.all();
  TIDEMARK_TRY(after->assign(from.list, before));
  const auto accepted = after->finish(preview.regions, preview.take);
  if (!accepted) return pass_on(accepted);
  std::array<std::int64_t, 256> counts = before.counts();
  counts[0] = 0;  // a new label's
  std::int64_t changed = 0;
  for (const document::LabelRegion& region : preview.regions)
    changed += std::exchange(counts[region.label], 0);
  const double voxel_ml = from.geometry.voxel_volume_ml();
  preview.before_ml = static_cast<double>(changed) * voxel_ml;
  preview.after_ml = static_cast<double>(accepted->taken) * voxel_ml;
  preview.changes = after->voxels() != before;
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
  proxy_.finish_labels({preview_, &preview_->regions}, preview_->take, preview_->from);
  clear();
}

}  // namespace tidemark::engine
