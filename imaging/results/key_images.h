// Key images of a segmentation: the images that show each segment where it is largest.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "imaging/results/results.h"

namespace tidemark::imaging {

// The slices k of the grid, each once and in order: of each segment the one in which most of its voxels lie.
[[nodiscard]] std::vector<std::int64_t> key_slices(const Segments& segments);

struct KeyImageFiles {
  std::filesystem::path selection;     // Key Object Selection Document (PS3.16 TID 2010)
  std::filesystem::path presentation;  // Grayscale Softcopy Presentation State (PS3.3 A.33.1); empty: none
};

// Two new series of the study that the source's files belong to. The selection names the images of
// key_slices(), with the note as its description. The presentation state shows them with that window, and in
// a layer a segment with its outline and name; the selection asks for it. Fails (ErrorKind::input) naming
// what an image lacks, or images that no one state can show, and (ErrorKind::write). There are source files.
Status write_key_images(const Segments& segments, SourceFiles source, const WindowLevel& window,
                        const std::string& note, const KeyImageFiles& files);

}  // namespace tidemark::imaging
