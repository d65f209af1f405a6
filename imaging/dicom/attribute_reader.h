// Attributes of a DICOM dataset, or of an item of a sequence, as values of ours.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

class DcmItem;
class DcmTagKey;

namespace tidemark::imaging {

// "PixelSpacing (0028,0030)", as messages name an attribute.
[[nodiscard]] std::string name_of(const DcmTagKey& key);

// Reads attributes and remembers the first that makes no sense.
class AttributeReader {
 public:
  AttributeReader(DcmItem& item, std::string& problem) : item_(item), problem_(problem) {}

  // Values with backslashes between them, whatever their representation; empty when absent, or longer than
  // any that is read (1 MiB).
  [[nodiscard]] std::string text(const DcmTagKey& key) const;

  // A text that is kept for every slice (a UID, a code or a name), cut to 256 bytes. A file of many slices
  // could otherwise take much memory by a long one.
  [[nodiscard]] std::string name(const DcmTagKey& key) const;

  // Nothing when absent or empty; a problem when it is not `count` numbers (at least one when count is 0).
  std::optional<std::vector<double>> decimals(const DcmTagKey& key, std::size_t count);

  // The first of the numbers. Text that is no number counts as absent: for attributes that only help.
  [[nodiscard]] std::optional<double> number(const DcmTagKey& key) const;

  // A size or a count of bits, whatever integer representation it comes in; a problem when it is absent or
  // not within [low, high].
  std::int64_t whole(const DcmTagKey& key, std::int64_t low, std::int64_t high);

  // The first item of a sequence; null when there is none.
  [[nodiscard]] DcmItem* first_item(const DcmTagKey& sequence) const;

  void report(std::string problem) {
    if (problem_.empty()) problem_ = std::move(problem);
  }

  [[nodiscard]] DcmItem& item() const { return item_; }

 private:
  DcmItem& item_;
  std::string& problem_;
};

}  // namespace tidemark::imaging
