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

// A CSA header in its second form with one value a name.
std::string csa_bytes(const std::vector<std::pair<std::string, std::vector<std::string>>>& values);

// A Siemens mosaic of four slices of 2 x 2 pixels, whole and well, with that CSA header.
Dataset mosaic(const std::string& csa_header);
std::string csa_of_mosaic();

}  // namespace tidemark::test
