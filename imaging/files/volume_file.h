// Volume files other than DICOM: NIfTI, NRRD, MetaImage (read and write) and GIPL (read) through ITK, and
// pictures (read): PNG, JPEG, TIFF.
#pragma once

#include <filesystem>

#include "core/progress.h"
#include "core/volume.h"
#include "imaging/series.h"

namespace tidemark::imaging {

// By suffix, case ignored: .nii .nii.gz .nrrd .nhdr .mha .mhd .gipl .gipl.gz .png .jpg .jpeg .tif .tiff
// (reading); .nii .nii.gz .nrrd .mha (writing).
bool is_readable_volume_file(const std::filesystem::path& file);
bool is_picture_file(const std::filesystem::path& file);  // of the former, those from .png on
bool is_writable_volume_file(const std::filesystem::path& file);

// The header alone, as a series of one file (loadable = false with a reason when the content is refused).
Result<Series> scan_volume_file(const std::filesystem::path& file);

// 3D scalar images. int16 and uint16 stay as they are, 8-bit types become int16 or uint16, others float.
// Geometry is converted to LPS (NIfTI stores RAS). A picture is a volume of one slice, or of its pages: i
// along its rows, j down; colours become their luminance, and the pixels' size is that of its resolution.
Result<Volume> read_volume_file(const std::filesystem::path& file, const Progress& progress = {});

// Both of a file that is no picture, by one look at its header.
struct VolumeWithSeries {
  Series series;
  Volume volume;
};
Result<VolumeWithSeries> read_volume_with_series(const std::filesystem::path& file,
                                                 const Progress& progress = {});

// Whether a file of that name can hold the grid without saying how its axes lie in the patient. MetaImage
// cannot, and NIfTI then has no origin and no directions.
[[nodiscard]] bool can_leave_sides_open(const std::filesystem::path& file, const Geometry& grid);

// What is written of a grid whose sides nobody knows.
enum class UnknownSides {
  open,    // the file says so, where it can
  stated,  // a place in a patient, for a program that goes by such places and sends back a file with the same
};

// Written through a temporary file; on failure (ErrorKind::write) the target is as it was before. Values are
// written rescaled: as int16 or uint16 when slope and intercept are whole numbers and all fits, else float.
Status write_volume_file(const Volume& volume, const std::filesystem::path& file,
                         UnknownSides sides = UnknownSides::open);
Status write_mask_file(const Mask& mask, const std::filesystem::path& file);  // as uint8, 0 and 1

}  // namespace tidemark::imaging
