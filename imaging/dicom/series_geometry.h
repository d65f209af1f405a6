// The grid of a volume from the headers of a series' images, or the reason why there is none.
#pragma once

#include <string>
#include <vector>

#include "imaging/dicom/slice_header.h"
#include "imaging/series.h"

namespace tidemark::imaging {

// An image alone is a volume of one slice, and what it does not say about its place is supposed. Else sorts
// the images of one series along their normal and checks that they make a stack: same size, pixel
// spacing and orientation, one image a position (DICOM PS3.3 C.7.6.2.1.1); of which a regular grid is made by
// the default policy (plan_regular_grid()). The direction of the k axis is cross(i, j), so that the grid is
// right-handed. `slices` must not be empty. A series that fails a check comes back with loadable = false and
// a reason that names the files.
[[nodiscard]] Series arrange_series(std::vector<SliceHeader> slices);

// Makes the grid of a series anew; nothing changes where there is no stack.
void set_grid(Series& series, const GridPolicy& policy);

// The key of a series: its Series Instance UID. Images without one belong together when they lie in one
// folder and have the same modality and description.
[[nodiscard]] std::string series_key(const SliceHeader& slice);

// Splits images into series by their key, and series into the volumes that they hold (split_series.h), whose
// UIDs get a number: "1.2.3#2". No volume has images of two patients or studies. Copies of one series in
// several folders (the same SOP Instance UIDs again) become one series a folder.
[[nodiscard]] std::vector<Series> group_series(std::vector<SliceHeader> slices);

}  // namespace tidemark::imaging
