#include "document/field_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

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

Result<FieldsReader> FieldsReader::open(const solver::Field& like, std::vector<std::int32_t> tables,
                                        std::size_t pages, std::string what) {
  FieldsReader reader(like, std::move(tables), std::move(what));
  TIDEMARK_TRY(reader.find_names(pages));
  const solver::Field empty = solver::Field::empty(like.geometry, like.band, like.layout.page_shape());
  for (std::size_t n = 0; n < reader.tables_.size(); ++n) {
    const std::size_t page = n % reader.tables_length();
    if (page == 0) reader.fields_.push_back(std::make_shared<solver::Field>(empty));
    if (reader.tables_[n] != kInsideEntry) continue;
    reader.fields_.back()->pages.set_constant(static_cast<std::int64_t>(page), solver::Field::Kind::inside);
  }
  reader.page_.resize(static_cast<std::size_t>(like.layout.voxels_per_page()));
  return reader;
}

Status FieldsReader::find_names(std::size_t pages) {
  if (tables_.size() % tables_length() != 0)
    return fail(ErrorKind::input, "{}: the page table or the pages have the wrong size", what_);
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  // There are no more of them than entries: a size alone takes no memory.
  if (pages <= tables_.size()) first_names_.assign(pages, kNone);
  for (std::size_t n = 0; n < tables_.size(); ++n) {
    const std::int32_t entry = tables_[n];
    if (entry == kOutsideEntry || entry == kInsideEntry) continue;
    if (entry < 0 || static_cast<std::size_t>(entry) >= pages) {
      return fail(ErrorKind::input, "{}: the page table names page {}, which is not there", what_, entry);
    }
    if (first_names_.empty()) continue;
    std::size_t& first = first_names_[static_cast<std::size_t>(entry)];
    if (first == kNone) {
      first = n;
    } else if (first % tables_length() != n % tables_length()) {
      return fail(ErrorKind::input, "{}: the page table names page {} twice", what_, entry);
    }
  }
  const bool all = first_names_.size() == pages &&
                   std::find(first_names_.begin(), first_names_.end(), kNone) == first_names_.end();
  if (!all) return fail(ErrorKind::input, "{}: the page table does not name all pages", what_);
  return {};
}

void FieldsReader::take(std::span<const std::byte> piece) {
  const std::span<std::byte> page = std::as_writable_bytes(std::span(page_));
  while (taken_ && !piece.empty()) {
    const auto part = piece.first(std::min(piece.size(), page.size() - page_bytes_));
    std::copy(part.begin(), part.end(), page.begin() + static_cast<std::ptrdiff_t>(page_bytes_));
    piece = piece.subspan(part.size());
    page_bytes_ += part.size();
    if (page_bytes_ < page.size()) continue;
    taken_ = put_page();
    page_bytes_ = 0;
  }
}

Status FieldsReader::put_page() {
  if (pages_ == first_names_.size())
    return fail(ErrorKind::input, "{}: the page table or the pages have the wrong size", what_);
  const auto limit = static_cast<float>(like_.band);
  const auto bad = std::find_if(page_.begin(), page_.end(), [&](float value) {
    return !std::isfinite(value) || std::abs(value) > limit;
  });
  if (bad != page_.end())
    return fail(ErrorKind::input, "{}: phi is {}, the band is {}", what_, *bad, like_.band);
  const std::size_t name = first_names_[pages_++];
  const auto page = static_cast<std::int64_t>(name % tables_length());
  SharedPages& pages = fields_[name / tables_length()]->pages;
  const float* const present = like_.pages.values(page);
  if (present != nullptr && std::memcmp(present, page_.data(), page_.size() * sizeof(float)) == 0) {
    pages.share(page, like_.pages);
  } else {
    std::copy(page_.begin(), page_.end(), pages.store(page));
  }
  return {};
}

Result<std::vector<std::shared_ptr<const solver::Field>>> FieldsReader::fields() {
  if (!taken_) return pass_on(taken_);
  if (pages_ != first_names_.size() || page_bytes_ != 0)
    return fail(ErrorKind::input, "{}: the page table or the pages have the wrong size", what_);
  for (std::size_t n = 0; n < tables_.size(); ++n) {
    if (tables_[n] < 0) continue;
    const std::size_t first = first_names_[static_cast<std::size_t>(tables_[n])];
    if (first == n) continue;
    fields_[n / tables_length()]->pages.share(static_cast<std::int64_t>(n % tables_length()),
                                              fields_[first / tables_length()]->pages);
  }
  return std::vector<std::shared_ptr<const solver::Field>>(fields_.begin(), fields_.end());
}

}  // namespace tidemark::document
