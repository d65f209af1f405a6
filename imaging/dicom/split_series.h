// The volumes of one series. One Series Instance UID may stand for echoes, times, directions of diffusion,
// magnitude and phase, stacks, or a localiser in three orientations.
#pragma once

#include <string>
#include <vector>

#include "imaging/dicom/slice_header.h"

namespace tidemark::imaging {

struct SeriesPart {
  std::vector<SliceHeader> slices;
  std::string label;                 // "echo 2, TE 30 ms"; empty when the series is one part
  bool is_rest = false;              // images that fit into none of the other parts
  std::vector<std::string> changes;  // the images left out
};

// Splits the slices of one series (at least one) by size, orientation, pixel spacing and stack. Where several
// images lie at one position, it splits further by the first attribute that tells them apart
// of: series number, type of image, echo, diffusion, temporal position, trigger time, acquisition, time of
// acquisition, time of the content, number of the instance. Of exact copies one is kept. Images alone of
// their kind come last, together: scouts, captures of the screen.
//
// The series stays one part, for arrange_series() to refuse it, when no attribute tells volumes apart, and
// when one of its images cannot be used or is alone and may be a slice that was damaged.
[[nodiscard]] std::vector<SeriesPart> split_series(std::vector<SliceHeader> slices);

}  // namespace tidemark::imaging
