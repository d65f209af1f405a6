// phi as bytes for files: page tables, and the pages that they name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/result.h"
#include "document/zip_archive.h"
#include "solver/field.h"

namespace tidemark::document {

// Of fields with one layout. What they share is there once.
class FieldBytes {
 public:
  FieldBytes() = default;
  explicit FieldBytes(const solver::Field& phi) { add(phi); }
  void add(const solver::Field& phi);

  [[nodiscard]] std::size_t fields() const { return fields_; }
  // One after the other. For each virtual page int32: the number of its page, kOutsideEntry or kInsideEntry.
  [[nodiscard]] const std::vector<std::int32_t>& tables() const { return tables_; }
  // The pages by their numbers. Every padding voxel is set, so that equal fields give equal bytes.
  [[nodiscard]] std::size_t pages() const { return pages_.size(); }
  [[nodiscard]] std::span<const float> page(std::size_t number) const {
    return {pages_[number], voxels_per_page_};
  }
  [[nodiscard]] std::int64_t bytes() const;
  // Both as entries of an archive, as long as this lives.
  [[nodiscard]] ZipEntry tables_entry(std::string_view name) const;
  [[nodiscard]] ZipEntry pages_entry(std::string_view name) const;

 private:
  std::int32_t number_of(const solver::Field& phi, std::int64_t page);

  std::size_t fields_ = 0;
  std::vector<std::int32_t> tables_;
  std::size_t voxels_per_page_ = 0;
  std::vector<const float*> pages_;                         // in kept_, or in padded_
  std::vector<std::unique_ptr<float[]>> padded_;            // those that reach beyond the volume
  std::unordered_map<const float*, std::int32_t> numbers_;  // of pages that lie at a place
  std::vector<SharedPages> kept_;                           // so that no other page comes to lie there
};
inline constexpr std::int32_t kOutsideEntry = -1;
inline constexpr std::int32_t kInsideEntry = -2;

// Checks tables and values, and makes fields of them that share what they have in common. Fails
// (ErrorKind::input) when the sizes do not fit, a table names a page that is not there or lies elsewhere in
// another, a page has no name, or a value is not finite or beyond the band. `what` is for the message.
Result<std::vector<std::shared_ptr<const solver::Field>>> fields_from_file(
    const Geometry& geometry, double band, Index3 page_shape, std::span<const std::int32_t> tables,
    std::span<const float> pages, const std::string& what);
// The same of one table.
Result<std::shared_ptr<const solver::Field>> field_from_file(const Geometry& geometry, double band,
                                                             Index3 page_shape,
                                                             std::span<const std::int32_t> table,
                                                             std::span<const float> pages,
                                                             const std::string& what);

// Page shapes that files may name: those that executors have.
[[nodiscard]] bool is_page_shape(Index3 shape);

}  // namespace tidemark::document
