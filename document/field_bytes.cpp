#include "document/field_bytes.h"

#include <algorithm>
#include <cmath>

namespace tidemark::document {

bool is_page_shape(Index3 shape) {
  return shape == Index3(8, 8, 8) || shape == Index3(16, 16, 1) || shape == Index3(4, 4, 4);
}

void FieldBytes::add(const solver::Field& phi) {
  ++fields_;
  kept_.push_back(phi.pages);
  voxels_per_page_ = static_cast<std::size_t>(phi.layout.voxels_per_page());
  tables_.reserve(tables_.size() + static_cast<std::size_t>(phi.layout.page_count()));
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    const solver::Field::Kind kind = phi.pages.kind(page);
    const std::int32_t constant = kind == solver::Field::Kind::inside ? kInsideEntry : kOutsideEntry;
    tables_.push_back(kind == solver::Field::Kind::stored ? number_of(phi, page) : constant);
  }
}

std::int32_t FieldBytes::number_of(const solver::Field& phi, std::int64_t page) {
  const float* const values = phi.pages.values(page);
  const auto next = static_cast<std::int32_t>(pages_.size());
  const auto [known, is_new] = numbers_.try_emplace(values, next);
  if (!is_new) return known->second;
  pages_.push_back(values);
  const Index3 shape = phi.layout.page_shape();
  const Index3 valid = phi.layout.valid_shape(page);
  if (valid == shape) return next;
  const std::int64_t voxels = phi.layout.voxels_per_page();
  float* const written = padded_.emplace_back(std::make_unique<float[]>(voxels_per_page_)).get();
  for (std::int64_t i = 0; i < voxels; ++i) {
    const Index3 v(i % shape.x, i / shape.x % shape.y, i / (shape.x * shape.y));
    const bool is_padding = v.x >= valid.x || v.y >= valid.y || v.z >= valid.z;
    written[i] = is_padding ? static_cast<float>(-phi.band) : values[i];
  }
  pages_.back() = written;
  return next;
}

std::int64_t FieldBytes::bytes() const {
  return static_cast<std::int64_t>(pages_.size() * voxels_per_page_ * sizeof(float) +
                                   tables_.size() * sizeof(std::int32_t));
}

ZipEntry FieldBytes::tables_entry(std::string_view name) const {
  return {name, std::as_bytes(std::span(tables_))};
}

ZipEntry FieldBytes::pages_entry(std::string_view name) const {
  return {name, pages_.size() * voxels_per_page_ * sizeof(float), [this](std::size_t number) {
            return number < pages_.size() ? std::as_bytes(page(number)) : std::span<const std::byte>();
          }};
}

Result<std::vector<std::shared_ptr<const solver::Field>>> fields_from_file(
    const Geometry& geometry, double band, Index3 page_shape, std::span<const std::int32_t> tables,
    std::span<const float> pages, const std::string& what) {
  const solver::Field empty = solver::Field::empty(geometry, band, page_shape);
  const std::int64_t voxels = empty.layout.voxels_per_page();
  const auto length = static_cast<std::size_t>(empty.layout.page_count());
  if (tables.size() % length != 0 || pages.size() % static_cast<std::size_t>(voxels) != 0) {
    return fail(ErrorKind::input, "{}: the page table or the pages have the wrong size", what);
  }
  const auto limit = static_cast<float>(band);
  const auto bad = std::find_if(pages.begin(), pages.end(), [&](float value) {
    return !std::isfinite(value) || std::abs(value) > limit;
  });
  if (bad != pages.end()) {
    return fail(ErrorKind::input, "{}: phi is {}, the band is {}", what, *bad, band);
  }
  struct Place {
    std::int64_t page = -1;  // none yet
    std::size_t field = 0;   // the first that has it
  };
  std::vector<Place> places(pages.size() / static_cast<std::size_t>(voxels));
  std::vector<std::shared_ptr<const solver::Field>> fields;
  for (std::size_t first = 0; first < tables.size(); first += length) {
    auto phi = std::make_shared<solver::Field>(empty);
    for (std::int64_t page = 0; page < empty.layout.page_count(); ++page) {
      const std::int32_t entry = tables[first + static_cast<std::size_t>(page)];
      if (entry == kOutsideEntry) continue;
      if (entry == kInsideEntry) {
        phi->pages.set_constant(page, solver::Field::Kind::inside);
        continue;
      }
      if (entry < 0 || static_cast<std::size_t>(entry) >= places.size()) {
        return fail(ErrorKind::input, "{}: the page table names page {}, which is not there", what, entry);
      }
      Place& place = places[static_cast<std::size_t>(entry)];
      if (place.page < 0) {
        place = {page, fields.size()};
        std::copy_n(pages.data() + entry * voxels, voxels, phi->pages.store(page));
      } else if (place.page == page) {
        phi->pages.share(page, fields[place.field]->pages);
      } else {
        return fail(ErrorKind::input, "{}: the page table names page {} twice", what, entry);
      }
    }
    fields.push_back(std::move(phi));
  }
  if (std::any_of(places.begin(), places.end(), [](const Place& place) { return place.page < 0; })) {
    return fail(ErrorKind::input, "{}: the page table does not name all pages", what);
  }
  return fields;
}

Result<std::shared_ptr<const solver::Field>> field_from_file(const Geometry& geometry, double band,
                                                             Index3 page_shape,
                                                             std::span<const std::int32_t> table,
                                                             std::span<const float> pages,
                                                             const std::string& what) {
  const PageLayout layout(geometry.size, page_shape);
  if (static_cast<std::int64_t>(table.size()) != layout.page_count())
    return fail(ErrorKind::input, "{}: the page table or the pages have the wrong size", what);
  auto fields = fields_from_file(geometry, band, page_shape, table, pages, what);
  if (!fields) return pass_on(fields);
  return std::move(fields->front());
}

}  // namespace tidemark::document
