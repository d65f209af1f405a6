#include "document/field_delta.h"

#include <cstring>
#include <optional>

namespace tidemark::document {
namespace {

const float* page_values(const solver::Field& field, std::int64_t page) {
  const std::int32_t entry = field.table[static_cast<std::size_t>(page)];
  return entry < 0 ? nullptr : field.pages.data() + entry * field.layout.voxels_per_page();
}

bool same_page(const solver::Field& a, const solver::Field& b, std::int64_t page) {
  const float* one = page_values(a, page);
  const float* other = page_values(b, page);
  if (one == nullptr || other == nullptr) {
    return one == other && a.table[static_cast<std::size_t>(page)] == b.table[static_cast<std::size_t>(page)];
  }
  // By their bits: undo must lead to the same field, to the last bit.
  return std::memcmp(one, other, static_cast<std::size_t>(a.layout.voxels_per_page()) * sizeof(float)) == 0;
}

// The field with pages of another shape, where it has not got it already.
const solver::Field& with_pages(const solver::Field& field, const solver::PageLayout& layout,
                                std::optional<solver::Field>& made) {
  if (field.layout == layout) return field;
  made = field.repaged(field.band, layout.page_shape());
  return *made;
}

}  // namespace

std::int64_t memory_of(const solver::Field& field) {
  return static_cast<std::int64_t>(field.pages.size() * sizeof(float) +
                                   field.table.size() * sizeof(std::int32_t));
}

void FieldDelta::keep(const solver::Field& field, std::int64_t page, Side& side) {
  const std::int64_t voxels = field.layout.voxels_per_page();
  const float* values = page_values(field, page);
  if (values == nullptr) {
    side.table.push_back(field.table[static_cast<std::size_t>(page)]);
    return;
  }
  side.table.push_back(static_cast<std::int32_t>(static_cast<std::int64_t>(side.values.size()) / voxels));
  side.values.insert(side.values.end(), values, values + voxels);
}

FieldDelta::FieldDelta(const solver::Field& before, const solver::Field& after) : layout_(after.layout) {
  std::optional<solver::Field> made;
  const solver::Field& from = with_pages(before, layout_, made);
  before_.band = before.band;
  after_.band = after.band;
  for (std::int64_t page = 0; page < layout_.page_count(); ++page) {
    if (same_page(from, after, page)) continue;
    pages_.push_back(page);
    keep(from, page, before_);
    keep(after, page, after_);
  }
  for (Side* side : {&before_, &after_}) side->values.shrink_to_fit();
}

std::int64_t FieldDelta::bytes() const {
  const std::size_t entries = pages_.size() * (sizeof(std::int64_t) + 2 * sizeof(std::int32_t));
  return static_cast<std::int64_t>(entries + (before_.values.size() + after_.values.size()) * sizeof(float));
}

solver::Field FieldDelta::replaced(const solver::Field& field, const Side& side) const {
  std::optional<solver::Field> made;
  const solver::Field& from = with_pages(field, layout_, made);
  const std::int64_t voxels = layout_.voxels_per_page();
  solver::Field result = solver::Field::empty(from.geometry, side.band, layout_.page_shape());
  result.pages.reserve(from.pages.size());
  std::size_t next = 0;  // of the changed pages
  for (std::int64_t page = 0; page < layout_.page_count(); ++page) {
    const bool changed = next < pages_.size() && pages_[next] == page;
    const std::int32_t entry = changed ? side.table[next] : from.table[static_cast<std::size_t>(page)];
    if (changed) ++next;
    std::int32_t& slot = result.table[static_cast<std::size_t>(page)];
    if (entry < 0) {
      slot = entry;
      continue;
    }
    slot = static_cast<std::int32_t>(result.resident_pages());
    const float* values = (changed ? side.values.data() : from.pages.data()) + entry * voxels;
    result.pages.insert(result.pages.end(), values, values + voxels);
  }
  return result;
}

}  // namespace tidemark::document
