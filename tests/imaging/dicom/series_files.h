// Series made and damaged for tests.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "core/volume.h"
#include "imaging/series.h"

class DcmDataset;

namespace tidemark::test {

// A volume whose every voxel value is different from its neighbours', oblique, with three different spacings.
Volume sample_volume(Index3 size);
Volume sample_volume_uint16(Index3 size);

// Writes the volume as CT (or MR) into the folder and returns its files in slice order. Ends the test program
// when that fails.
std::vector<std::filesystem::path> write_series(const Volume& volume, const std::filesystem::path& folder,
                                                const char* modality = "CT");

// Loads the file, lets `change` work on it, and saves it under `target` (the same file when empty).
void edit(const std::filesystem::path& file, const std::function<void(DcmDataset&)>& change,
          const std::filesystem::path& target = {});

// Sets one attribute's text, whatever it says; an empty text removes the attribute.
void set_text(const std::filesystem::path& file, unsigned group, unsigned element, const char* text);

// Moves slice k of the grid by k * mm along the columns, as a tilted gantry does.
void tilt(const std::vector<std::filesystem::path>& files, const Geometry& grid, double mm);

// The file's first `bytes` bytes only.
void truncate(const std::filesystem::path& file, std::uintmax_t bytes);

// The only series below the path. Ends the test program when there is none or another.
imaging::Series only_series(const std::filesystem::path& path);

// Fails the test that runs unless grid, voxels and rescale are the same.
void verify_same(const Volume& read, const Volume& written);

}  // namespace tidemark::test
