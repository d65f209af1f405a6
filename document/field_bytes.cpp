#include "document/field_bytes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tidemark::document {

bool is_page_shape(Index3 shape) {
  return shape == Index3(8, 8, 8) || shape == Index3(16, 16, 1) || shape == Index3(4, 4, 4);
}

std::vector<float> pages_for_file(const solver::Field& phi) {
  std::vector<float> pages = phi.pages;
  const Index3 shape = phi.layout.page_shape();
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    const std::int32_t entry = phi.table[static_cast<std::size_t>(page)];
    const Index3 valid = phi.layout.valid_shape(page);
    if (entry < 0 || valid == shape) continue;
    float* value = pages.data() + entry * phi.layout.voxels_per_page();
    for (std::int64_t i = 0; i < phi.layout.voxels_per_page(); ++i) {
      const Index3 v(i % shape.x, i / shape.x % shape.y, i / (shape.x * shape.y));
      if (v.x >= valid.x || v.y >= valid.y || v.z >= valid.z) value[i] = static_cast<float>(-phi.band);
    }
  }
  return pages;
}

Result<solver::Field> field_from_file(const Geometry& geometry, double band, Index3 page_shape,
                                      std::vector<std::int32_t> table, std::vector<float> pages,
                                      const std::string& what) {
  solver::Field phi = solver::Field::empty(geometry, band, page_shape);
  const auto voxels = static_cast<std::size_t>(phi.layout.voxels_per_page());
  if (table.size() != phi.table.size() || pages.size() % voxels != 0) {
    return fail(ErrorKind::input, "{}: the page table or the pages have the wrong size", what);
  }
  std::vector<bool> named(pages.size() / voxels, false);
  for (const std::int32_t entry : table) {
    if (entry == solver::Field::kInside || entry == solver::Field::kOutside) continue;
    if (entry < 0 || static_cast<std::size_t>(entry) >= named.size() ||
        named[static_cast<std::size_t>(entry)]) {
      return fail(ErrorKind::input, "{}: the page table names page {}, which is not there or named twice",
                  what, entry);
    }
    named[static_cast<std::size_t>(entry)] = true;
  }
  if (!std::all_of(named.begin(), named.end(), [](bool one) { return one; })) {
    return fail(ErrorKind::input, "{}: the page table does not name all pages", what);
  }
  const auto limit = static_cast<float>(band);
  const auto bad = std::find_if(pages.begin(), pages.end(), [&](float value) {
    return !std::isfinite(value) || std::abs(value) > limit;
  });
  if (bad != pages.end()) {
    return fail(ErrorKind::input, "{}: phi is {}, the band is {}", what, *bad, band);
  }
  phi.table = std::move(table);
  phi.pages = std::move(pages);
  return phi;
}

}  // namespace tidemark::document
