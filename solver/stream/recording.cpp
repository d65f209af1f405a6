// The record of a page's next step: its passes run as in a step, and what they have written is put back.
#include <algorithm>
#include <map>

#include "solver/paging/page_neighbours.h"
#include "solver/stream/pass_record.h"
#include "solver/stream/stream_executor.h"

namespace tidemark::solver {

// The page, and those across its faces that the step computes: the message compares with them.
std::vector<PhysicalPage> StreamExecutor::recorded_pages(PhysicalPage page) const {
  std::vector<PhysicalPage> pages{page};
  const Index3 coordinates = pages_.layout().page_coordinates(pages_.virtual_page(page));
  for (const Index3& step : kFaceSteps) {
    const PhysicalPage other = pages_.physical(coordinates + step);
    if (other >= kFirstPage && !info(other).asleep) pages.push_back(other);
  }
  return pages;
}

// phi of the page and of all that touch it.
Status StreamExecutor::record_phi(PassRecord& record) const {
  const PageLayout& layout = pages_.layout();
  const Index3 first = layout.first_voxel(record.page);
  const Index3 last = layout.domain_size() - Index3(1);
  std::map<PhysicalPage, std::vector<float>> pages;
  for (std::int64_t z = -1; z <= 1; ++z) {
    for (std::int64_t y = -1; y <= PassRecord::kSide; ++y) {
      for (std::int64_t x = -1; x <= PassRecord::kSide; ++x) {
        const VirtualAddress at = layout.translate(glm::clamp(first + Index3(x, y, z), Index3(0), last));
        const PhysicalPage page = pages_.physical(at.page);
        auto [values, missing] = pages.try_emplace(page);
        if (missing) {
          auto read = memory_.read_page(page, current_);
          if (!read) return pass_on(read);
          values->second = std::move(*read);
        }
        record.phi.push_back(values->second[static_cast<std::size_t>(at.offset)]);
      }
    }
  }
  return {};
}

void StreamExecutor::record_address(PassRecord& record) const {
  const PageLayout& layout = pages_.layout();
  const gpu::TexelRect rect = layout_.rect(record.physical);
  const glm::ivec2 layer = memory_.size();
  record.address = {rect.x, rect.y + layout_.layer(record.physical) * layer.y};
  record.memory_size = {layer.x, layer.y * memory_.layers()};
  const std::int64_t in_slice = layout.pages().x * layout.pages().y;
  const auto begin = pages_.table().entries().begin() + layout.page_coordinates(record.page).z * in_slice;
  record.slice.assign(begin, begin + in_slice);
  for (PhysicalPage page = 0; page < pages_.table().capacity(); ++page)
    record.inverse.push_back(pages_.virtual_page(page));
  record.band = band();
  record.time_step = time_step();
  record.one_gradient = parameters().scheme == Scheme::paper;
}

Status StreamExecutor::record_passes(PassRecord& record, const std::vector<PhysicalPage>& pages) {
  TIDEMARK_TRY(special_geometry_.describe(*device_, pages_, pages));
  TIDEMARK_TRY(passes_.reserve(*device_, std::max(active_geometry_.size(), special_geometry_.size())));
  passes_.step(special_geometry_, memory_, drive_textures_, model_.constants<float>(), current_,
               next_step_is_measured());
  auto message =
      passes_.message(special_geometry_, memory_, 1 - current_, static_cast<float>(band()), kQuietChange);
  if (!message) return pass_on(message);
  record.message = message->front();
  record.decision = decide(record.physical, record.message);
  TIDEMARK_TRY(passes_.read_first_page(record));
  auto next = memory_.read_page(record.physical, 1 - current_);
  if (!next) return pass_on(next);
  record.next = std::move(*next);
  auto motion = memory_.read_motion(record.physical);
  if (!motion) return pass_on(motion);
  record.window_change = motion->change;
  return {};
}

Result<PassRecord> StreamExecutor::record_step(std::int64_t page) {
  if (page < 0 || page >= pages_.layout().page_count())
    return fail(ErrorKind::usage, "there is no page {}: the volume has {}", page,
                pages_.layout().page_count());
  TIDEMARK_TRY(make_current());
  PassRecord record;
  record.layout = pages_.layout();
  record.page = page;
  record.physical = pages_.physical(page);
  record_address(record);
  if (!record.is_resident()) return record;
  record.quiet = info(record.physical).asleep;
  if (active_list_is_stale_) {
    TIDEMARK_TRY(rebuild_active_list());
  }
  TIDEMARK_TRY(prepare_drive());
  TIDEMARK_TRY(record_phi(record));
  // The passes write phi and motion of these pages.
  const std::vector<PhysicalPage> pages = recorded_pages(record.physical);
  auto kept = memory_.keep(pages, 1 - current_);
  if (!kept) return pass_on(kept);
  const Status recorded = record_passes(record, pages);
  memory_.put_back(*kept, 1 - current_);
  TIDEMARK_TRY(device_->check("recording a step"));
  TIDEMARK_TRY(recorded);
  return record;
}

}  // namespace tidemark::solver
