// phi as bytes for files: page tables, and the pages that they name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
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

// Makes fields of tables and pages as FieldBytes writes them. The pages come piece by piece, and none is in
// memory twice: fields share what they have in common.
class FieldsReader {
 public:
  // The fields are like `like`, with whose stored pages they share what is the same. `pages`: how many there
  // are; `what` is for messages. Fails (ErrorKind::input) when the sizes do not fit, or a table names a page
  // that is not there or lies elsewhere in another, or a page has no name.
  static Result<FieldsReader> open(const solver::Field& like, std::vector<std::int32_t> tables,
                                   std::size_t pages, std::string what);

  // The next bytes of the pages, as many as there are.
  void take(std::span<const std::byte> piece);
  // After the last piece, once. Fails (ErrorKind::input) where a value was not finite or beyond the band, or
  // there were fewer or more bytes than the pages have.
  Result<std::vector<std::shared_ptr<const solver::Field>>> fields();

 private:
  FieldsReader(const solver::Field& like, std::vector<std::int32_t> tables, std::string what)
      : like_(like), tables_(std::move(tables)), what_(std::move(what)) {}
  [[nodiscard]] std::size_t tables_length() const {
    return static_cast<std::size_t>(like_.layout.page_count());
  }
  Status find_names(std::size_t pages);
  Status put_page();

  solver::Field like_;
  std::vector<std::int32_t> tables_;
  std::string what_;
  std::vector<std::size_t> first_names_;  // of each page: its place in the tables
  std::vector<std::shared_ptr<solver::Field>> fields_;
  std::vector<float> page_;     // that is being taken
  std::size_t page_bytes_ = 0;  // of it that are there
  std::size_t pages_ = 0;       // that were taken
  Status taken_;                // until a page was bad
};

// Page shapes that files may name: those that executors have.
[[nodiscard]] bool is_page_shape(Index3 shape);

}  // namespace tidemark::document
