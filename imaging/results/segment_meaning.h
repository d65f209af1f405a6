// The meaning of a region, in codes that other systems understand.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/result.h"

namespace tidemark::imaging {

// A coded concept (DICOM PS3.3 8.8): {"10200004", "SCT", "Liver"}.
struct Code {
  std::string value;
  std::string scheme;  // "SCT" is SNOMED CT
  std::string meaning;

  bool operator==(const Code&) const = default;
};

// Segmented Property Category and Type (PS3.3 C.8.20.4, PS3.16 CID 7150 and 7151). The default: some tissue,
// which is always true.
struct SegmentMeaning {
  Code category{"123037004", "SCT", "Anatomical Structure"};
  Code type{"85756007", "SCT", "Tissue"};

  bool operator==(const SegmentMeaning&) const = default;
};

// The meanings that a user can choose from, each by a word: "tissue" first, then in alphabetical order.
struct NamedMeaning {
  std::string_view word;
  SegmentMeaning meaning;
};
[[nodiscard]] std::span<const NamedMeaning> segment_meanings();

// By its word. Fails (ErrorKind::usage) naming the words there are.
[[nodiscard]] Result<SegmentMeaning> find_segment_meaning(std::string_view word);

// The meaning of a region's English name ("Left kidney"; in "liver tumours" the abnormal thing comes before
// its place); tissue where the name has none.
[[nodiscard]] SegmentMeaning guess_segment_meaning(std::string_view name);

}  // namespace tidemark::imaging
