// Key images of a segmentation: the images that show each segment where it is largest.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "imaging/results/results.h"

namespace tidemark::imaging {

// What a selection says of them where nobody says anything else.
inline constexpr const char* kKeyImageNote = "Segments where they are largest";

// The slices k of the grid, each once and in order: of each segment the one in which most of its voxels lie,
// of those that have an image.
[[nodiscard]] std::vector<std::int64_t> key_slices(const Segments& segments,
                                                   const std::function<bool(std::int64_t k)>& has_image);

struct KeyImageFiles {
  std::filesystem::path selection;     // Key Object Selection Document (PS3.16 TID 2010)
  std::filesystem::path presentation;  // Grayscale Softcopy Presentation State (PS3.3 A.33.1); empty: none
};

// A window as the files' own values have it: unset where the volume has another unit than they (SUV, a
// mapping of MR).
[[nodiscard]] std::optional<WindowLevel> window_of_files(const Volume& volume, const WindowLevel& window);

// Two new series of the study that the source's files belong to. The selection names the images of
// key_slices(), with the note as its description. The presentation state shows them with that window, and in
// a layer a segment with its outline and name; the selection asks for it. Fails (ErrorKind::input) naming
// what an image lacks, or images that no one state can show, and (ErrorKind::write).
Status write_key_images(const Segments& segments, SourceFiles source,
                        const std::optional<WindowLevel>& window, const std::string& note,
                        const KeyImageFiles& files, const Progress& progress = {});

}  // namespace tidemark::imaging
