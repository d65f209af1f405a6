// Images of several frames, made for tests.
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "core/volume.h"

namespace tidemark::test {

// Slice k of a volume (int16 or uint16) as a frame.
struct EnhancedFrame {
  const Volume* volume = nullptr;
  std::int64_t k = 0;
};

// All slices of a volume, first to last.
std::vector<EnhancedFrame> frames_of(const Volume& volume);

struct Enhanced {
  const char* sop_class = UID_EnhancedMRImageStorage;
  // Called with the item of each frame's groups, which holds its plane position.
  std::function<void(DcmItem& groups, std::size_t frame)> frame = [](DcmItem&, std::size_t) {};
  // Called with the dataset when all is in it.
  std::function<void(DcmDataset&)> whole = [](DcmDataset&) {};
};

// Writes one file of all frames; orientation, pixel spacing and rescale of the first one's volume are shared.
// Ends the test program when that fails.
void write_enhanced(const std::vector<EnhancedFrame>& frames, const std::filesystem::path& file,
                    const Enhanced& enhanced = {});

// The item of a group in an item of groups, made when it is not there.
DcmItem& group(DcmItem& groups, const DcmTagKey& sequence);

// Replaces the pixels of 16 bits by JPEG 2000 streams, each frame in `pieces` fragments, with an offset table
// or an empty one.
void encode_frames_j2k(DcmDataset& dataset, int pieces, bool has_table);

}  // namespace tidemark::test
