// Frames whose attributes stand in functional groups (DICOM PS3.3 C.7.6.16), shared and of each frame, and
// frames of reconstructed NM images, whose places follow from those of the first.
#pragma once

#include <vector>

#include "imaging/dicom/slice_header.h"

class DcmItem;

namespace tidemark::imaging {

// The headers of all frames of the image with that dataset, made from the dataset's own attributes (`whole`).
// A single header with a problem where the common attributes or those of a frame make no sense, or the places
// of the frames are missing.
[[nodiscard]] std::vector<SliceHeader> read_frames(DcmItem& dataset, SliceHeader whole);

}  // namespace tidemark::imaging
