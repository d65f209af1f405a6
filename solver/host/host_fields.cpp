#include "solver/host/host_fields.h"

namespace tidemark::solver {

HostFields::HostFields(PagedMemory<3>& memory)
    : memory_(&memory),
      values_(memory.attach<float, kPageVoxels, 3>()),
      masks_{memory.attach<RowMasks, 1>(), memory.attach<RowMasks, 1>()},
      infos_(memory.attach<PageInfo, 1>()) {}

void HostFields::keep_advection(bool wanted) {
  if (wanted == keeps_advection()) return;
  if (wanted) {
    advection_ = memory_->attach<float, kPageVoxels, 3>();
  } else {
    memory_->detach(advection_);
  }
}

std::int64_t HostFields::drive_bytes() const {
  return kPageVoxels * static_cast<std::int64_t>(sizeof(float)) + advection_.page_bytes();
}

}  // namespace tidemark::solver
