// The reader of a slice's place and of the meaning of its stored values, from a classic image itself and from
// the groups of an enhanced image's frames.
#pragma once

#include "imaging/dicom/attribute_reader.h"
#include "imaging/dicom/slice_header.h"

namespace tidemark::imaging {

// Absent attributes change nothing; present ones must be numbers (PS3.3 C.7.6.2).
void read_position(AttributeReader& in, SliceHeader& header);
void read_orientation(AttributeReader& in, SliceHeader& header);
void read_pixel_spacing(AttributeReader& in, SliceHeader& header);

// What only an image by itself is measured by. Values that make no sense count as none.
void read_detector_spacing(const AttributeReader& in, SliceHeader& header);
void read_thickness(const AttributeReader& in, SliceHeader& header);

// Modality LUT (PS3.3 C.11.1): slope, intercept and the unit that they lead to, and whether there is a table.
void read_rescale(AttributeReader& in, SliceHeader& header);

// VOI LUT (PS3.3 C.11.2). A window that makes no sense counts as none.
void read_window(const AttributeReader& in, SliceHeader& header);

}  // namespace tidemark::imaging
