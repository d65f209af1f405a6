// The check that a DICOM file's pixel data can be the frames that its Image Pixel module promises.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "imaging/guard/dicom/frame_header.h"
#include "imaging/guard/dicom/tag_walk.h"

namespace tidemark::imaging {

class PixelExtent {
 public:
  explicit PixelExtent(const TransferSyntax& syntax);

  // To be called by the walk for every element of the dataset.
  void note(const ElementHeader& header, ByteReader& reader, const Fragments* fragments);

  // One line without the file's name, or empty. Missing fields and those that are no numbers are checked by
  // their reader, not here.
  [[nodiscard]] std::string problem(std::int64_t file_size) const;
  [[nodiscard]] std::int64_t offset() const { return pixels_ ? pixels_->begin : 0; }

 private:
  enum class TableProblem { none, size, count, entry };
  [[nodiscard]] std::optional<std::int64_t> number(const ElementHeader& header, ByteReader& reader) const;
  static TableProblem check_table(ByteReader& reader, const Fragments& fragments);
  [[nodiscard]] std::string native_problem() const;
  [[nodiscard]] std::string compressed_problem(std::int64_t file_size) const;
  // Bytes of all frames, decoded; nothing without all the fields, or when the product is too large.
  [[nodiscard]] std::optional<std::int64_t> needed() const;

  const TransferSyntax& syntax_;
  ElementCoding coding_;
  std::optional<std::int64_t> rows_;
  std::optional<std::int64_t> columns_;
  std::optional<std::int64_t> samples_;
  std::optional<std::int64_t> bits_;
  std::optional<std::int64_t> frames_ = 1;
  std::array<char, 16> colours_{};
  std::optional<ElementHeader> pixels_;
  std::optional<Fragments> fragments_;
  std::optional<FrameSize> frame_size_;
  TableProblem table_problem_ = TableProblem::none;
};

}  // namespace tidemark::imaging
