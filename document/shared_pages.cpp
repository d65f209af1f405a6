#include "document/shared_pages.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "document/field_bytes.h"

namespace tidemark::document {

SharedPages::SharedPages(const Geometry& geometry, double band, Index3 page_shape)
    : empty_(solver::Field::empty(geometry, band, page_shape)) {}

void SharedPages::add(const solver::Field& phi, std::size_t like) {
  if (!(phi.layout == empty_.layout)) {
    return add(phi.repaged(phi.band, empty_.layout.page_shape()), like);
  }
  const std::vector<float> values = pages_for_file(phi);
  const std::int64_t voxels = phi.layout.voxels_per_page();
  const auto same = [&](std::int32_t known, const float* page) {
    return known >= 0 &&
           std::memcmp(pages_.data() + known * voxels, page, static_cast<std::size_t>(voxels) * 4) == 0;
  };
  std::vector<std::int32_t> table = phi.table;
  for (std::size_t page = 0; page < table.size(); ++page) {
    if (table[page] < 0) continue;
    const float* own = values.data() + table[page] * voxels;
    if (like < tables_.size() && same(tables_[like][page], own)) {
      table[page] = tables_[like][page];
      continue;
    }
    table[page] = static_cast<std::int32_t>(static_cast<std::int64_t>(pages_.size()) / voxels);
    pages_.insert(pages_.end(), own, own + voxels);
  }
  tables_.push_back(std::move(table));
}

solver::Field SharedPages::field(std::size_t state) const {
  solver::Field phi = empty_;
  const std::int64_t voxels = phi.layout.voxels_per_page();
  const std::vector<std::int32_t>& table = tables_[state];
  for (std::size_t page = 0; page < table.size(); ++page) {
    phi.table[page] = table[page];
    if (table[page] < 0) continue;
    phi.table[page] = static_cast<std::int32_t>(phi.resident_pages());
    const float* values = pages_.data() + table[page] * voxels;
    phi.pages.insert(phi.pages.end(), values, values + voxels);
  }
  return phi;
}

std::int64_t SharedPages::bytes() const {
  return static_cast<std::int64_t>(pages_.size() * sizeof(float) +
                                   tables_.size() * empty_.table.size() * sizeof(std::int32_t));
}

Status SharedPages::assign(std::vector<float> pages, std::vector<std::vector<std::int32_t>> tables,
                           const std::string& what) {
  const auto there = static_cast<std::int64_t>(pages.size()) / empty_.layout.voxels_per_page();
  for (const std::vector<std::int32_t>& table : tables) {
    for (const std::int32_t entry : table) {
      if (entry != solver::Field::kInside && entry != solver::Field::kOutside &&
          (entry < 0 || entry >= there))
        return fail(ErrorKind::input, "{}: a page table names page {}, which is not there", what, entry);
    }
  }
  const auto limit = static_cast<float>(empty_.band);
  for (const float value : pages) {
    if (!std::isfinite(value) || std::abs(value) > limit)
      return fail(ErrorKind::input, "{}: phi is {}, the band is {}", what, value, empty_.band);
  }
  pages_ = std::move(pages);
  tables_ = std::move(tables);
  return {};
}

}  // namespace tidemark::document
