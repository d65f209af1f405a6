// The attributes that tell the volumes of one series apart.
#pragma once

#include "imaging/dicom/attribute_reader.h"
#include "imaging/dicom/slice_header.h"

namespace tidemark::imaging {

// Of a classic image, or of the attributes that a converted image has kept of one. Absent attributes change
// nothing.
void read_traits(const AttributeReader& in, SliceTraits& traits);

// The first three numbers as a vector; nothing when there are fewer.
[[nodiscard]] std::optional<glm::dvec3> read_vector(const AttributeReader& in, const DcmTagKey& key);

// A date and a time, or both in one, as a number that orders them.
[[nodiscard]] std::optional<double> moment(const std::string& date, const std::string& time);

}  // namespace tidemark::imaging
