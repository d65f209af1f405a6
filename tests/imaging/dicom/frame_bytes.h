// Images of several slices byte by byte, so that a test can write what no library would.
#pragma once

#include <string>
#include <vector>

#include "tests/imaging/dicom/dicom_bytes.h"

namespace tidemark::test {

inline constexpr std::uint32_t kSharedGroups = 0x52009229;
inline constexpr std::uint32_t kFrameGroups = 0x52009230;

// A sequence of items of those bytes.
std::string sequence(std::uint32_t tag, const std::vector<std::string>& items);

// The groups of a frame: its plane position, and whatever else stands before and after it.
std::string frame_groups(const std::string& position, const std::string& before = {},
                         const std::string& after = {});

// An enhanced CT image of frames of 4 x 3 pixels, whole and well.
Dataset enhanced(int frames);

// A CSA header of those names and values, in its second form.
std::string csa_bytes(const std::vector<std::pair<std::string, std::vector<std::string>>>& values);
// The same in the first form, which has no mark, and says each length with the number of the first name's
// values on top.
std::string csa_in_first_form(std::string header, std::uint32_t first_items);

// A Siemens mosaic of four slices of 2 x 2 pixels, whole and well, with that CSA header.
Dataset mosaic(const std::string& csa_header);
std::string csa_of_mosaic();

}  // namespace tidemark::test
