// A DICOM Structured Report (PS3.16 TID 1500, Measurement Report) about the segments of a DICOM Segmentation.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "imaging/results/segment_meaning.h"

namespace tidemark::imaging {

// A number with its codes.
struct ReportedMeasure {
  Code quantity;
  double value = 0.0;
  Code unit;                       // UCUM
  std::optional<Code> derivation;  // "Mean"; unset: it is the quantity itself
};

struct ReportedSegment {
  std::size_t index = 0;  // as read_segmentation() lists them, from 0
  std::vector<ReportedMeasure> measures;
};

// Patient and study are those of the segmentation, which the report refers to segment by segment; `modality`
// is that of the images that were measured (CT, MR, PT, ...). Nobody has verified it. Written through a
// temporary file. Fails with ErrorKind::input, naming the segmentation and what it lacks, and with
// ErrorKind::write.
Status write_measurement_report(const std::filesystem::path& segmentation,
                                const std::vector<ReportedSegment>& segments, const std::string& modality,
                                const std::filesystem::path& file);

}  // namespace tidemark::imaging
