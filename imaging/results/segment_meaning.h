// The meaning of a region, in codes that other systems understand.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "core/result.h"

namespace tidemark {

// A coded concept (DICOM PS3.3 8.8): {"10200004", "SCT", "Liver"}.
struct Code {
  std::string value;
  std::string scheme;  // "SCT" is SNOMED CT
  std::string meaning;

  bool operator==(const Code&) const = default;
};

// Segmented Property Category and Type (PS3.3 C.8.20.4, PS3.16 CID 7150 and 7151). As it stands: some tissue,
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

// What a name of a region says in English ("Left kidney", "liver tumours": what is abnormal comes before
// where it is); tissue where it says nothing.
[[nodiscard]] SegmentMeaning guess_segment_meaning(std::string_view name);

}  // namespace tidemark
