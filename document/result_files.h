// Result files for other systems, written from a case, and label maps read from them.
#pragma once

#include "document/session_contents.h"
#include "imaging/results/results.h"

namespace tidemark::document {

// The choice of segments.
enum class ResultContent { all_labels, visible_labels, surface };

// The name of the surface's segment.
inline constexpr const char* kSurfaceSegment = "Surface";

// The segments of a snapshot of a case: its labels, without those that hold no voxel, or the inside of its
// surface with phi. Fails (ErrorKind::usage) when there are none.
Result<imaging::Segments> result_segments(const SessionContents& contents, ResultContent content);

// As DICOM Segmentation or RT Structure Set; `source` as for write_segmentation(). Fails as both do.
Status write_result(const imaging::Segments& segments, imaging::ResultForm form, imaging::SourceFiles source,
                    const std::filesystem::path& file, const Progress& progress = {});

// A structured report about a segmentation that was written of these segments: their measures, with the
// values of the volume inside. Fails as measure() and write_measurement_report() do.
Status write_measurements(const imaging::Segments& segments, const std::shared_ptr<const Volume>& volume,
                          const std::filesystem::path& segmentation, const std::filesystem::path& file,
                          const Progress& progress = {});

// The labels in a file, on that grid: the segments of a DICOM Segmentation or RT Structure Set, or the
// numbers of a volume file, whose axes may be in another order or run the other way. Without a grid: on its
// own, which a structure set has not. Fails (ErrorKind::input) naming the file and why it does not fit.
Result<imaging::Segments> read_labels(const std::filesystem::path& file, const Geometry* grid,
                                      const Progress& progress = {});

}  // namespace tidemark::document
