// The argument --label NAME[,MEANING[,RRGGBB]]: a segment's name, meaning and colour in DICOM results.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "imaging/results/segments.h"

namespace tidemark::cli {

// What was not given stays as the segment has it.
struct LabelArgument {
  std::string name;
  std::optional<SegmentMeaning> meaning;
  std::optional<SegmentColour> colour;

  void apply(Segment& segment) const;
};

// Fails with ErrorKind::usage naming the part that makes no sense.
Result<LabelArgument> parse_label(std::string_view text);

// --label, once or, in the order of the segments, several times.
CLI::Option* add_label(CLI::App& app, LabelArgument& label);
CLI::Option* add_labels(CLI::App& app, std::vector<LabelArgument>& labels);

// Said of results that have no patient to belong to.
inline constexpr const char* kAnonymousStudy =
    "The input is no DICOM study: DICOM results make a new one of an anonymous patient";

}  // namespace tidemark::cli
