// The argument --label NAME[,MEANING[,RRGGBB]]: a segment's name, meaning and colour in DICOM results.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "imaging/results/segments.h"

namespace tidemark::cli {

// Parts that were not given leave the segment's own.
struct LabelArgument {
  std::string name;
  std::optional<imaging::SegmentMeaning> meaning;
  std::optional<imaging::SegmentColour> colour;

  void apply(imaging::Segment& segment) const;
};

// Fails with ErrorKind::usage naming the part that makes no sense.
Result<LabelArgument> parse_label(std::string_view text);

// --label, once or, in the order of the segments, several times.
CLI::Option* add_label(CLI::App& app, LabelArgument& label);
CLI::Option* add_labels(CLI::App& app, std::vector<LabelArgument>& labels);

// The remark on results without a patient.
inline constexpr const char* kAnonymousStudy =
    "The input is no DICOM study: DICOM results make a new one of an anonymous patient";

}  // namespace tidemark::cli
