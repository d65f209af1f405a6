#include "ui/views/label_stroke.h"

#include <glm/common.hpp>
#include <utility>

#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {

LabelStroke::LabelStroke(DragView view, const Pointer& pressed)
    : Drag(std::move(view)),
      what_(pressed.button == Qt::RightButton ? document::Labels::Stroke::erases
                                              : document::Labels::Stroke::adds),
      values_(display().label_brush().values) {}

LabelStroke::~LabelStroke() {
  display().set_drawn_label(nullptr);
}

std::uint8_t LabelStroke::label() const {
  const document::Label* chosen = proxy().chosen_label();
  return chosen ? chosen->id : std::uint8_t{0};
}

Region LabelStroke::region_of(const std::vector<std::int64_t>& voxels) const {
  const Geometry& grid = proxy().volume().geometry;
  VoxelRange box{grid.size, Index3(0)};
  for (const std::int64_t offset : voxels) {
    const Index3 voxel = grid.voxel_at(offset);
    box = {glm::min(box.low, voxel), glm::max(box.high, voxel + Index3(1))};
  }
  Region region(box);
  for (const std::int64_t offset : voxels) region.add(grid.voxel_at(offset));
  return region;
}

Region LabelStroke::with_values(const Region& region) const {
  if (!values_) return region;
  const Volume& source = *proxy().source();
  Region kept(region.bounds());
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    for (std::int64_t i = 0; i < length; ++i) {
      const Index3 at = voxel + Index3(i, 0, 0);
      if (values_->contains(source.value(at))) kept.add(at);
    }
  });
  return kept;
}

void LabelStroke::show(const Region& region) {
  region_ = with_values(region);
  show_preview();
}

// Only values of voxels that are not in it yet are read.
void LabelStroke::add(const Region& region) {
  region_ = united(region_, with_values(difference(region, region_)));
  show_preview();
}

void LabelStroke::show_preview() {
  auto drawn = std::make_shared<engine::LabelPreview>();
  drawn->from.geometry = proxy().volume().geometry;
  drawn->regions.push_back({label(), {}, region_});
  display().set_drawn_label(std::move(drawn));
}

void LabelStroke::release() {
  if (region_.empty()) return;
  const QString name = tr("Label %1").arg(proxy().state().labels.size() + 1);  // of a new one
  proxy().brush_label({label(), name.toStdString(), region_}, what_, display().label_brush().take);
}

QString LabelStroke::text() const {
  const auto count = static_cast<qint64>(region_.count());
  const QString said = what_ == document::Labels::Stroke::adds
                           ? tr("adds up to %1 voxels", nullptr, form_of(count))
                           : tr("takes up to %1 voxels away", nullptr, form_of(count));
  return said.arg(count_text(count));
}

}  // namespace tidemark::ui
