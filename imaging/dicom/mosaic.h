// Siemens mosaics: one image that shows the slices of a volume side by side, row by row.
#pragma once

#include <vector>

#include "imaging/dicom/slice_header.h"

class DcmItem;

namespace tidemark::imaging {

[[nodiscard]] bool is_mosaic(DcmItem& dataset);

// The headers of the mosaic's slices, made from that of the whole image. A single header with a problem when
// the number of slices, their direction or their distance is not known.
[[nodiscard]] std::vector<SliceHeader> read_tiles(DcmItem& dataset, SliceHeader whole);

}  // namespace tidemark::imaging
