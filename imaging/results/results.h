// Segments as files that other systems accept, out and in: DICOM Segmentation (SEG), RT Structure Set,
// OpenVDB. Files are written through a temporary file: on failure the target is as it was before.
#pragma once

#include <filesystem>
#include <optional>
#include <span>

#include "core/progress.h"
#include "imaging/results/segments.h"

namespace tidemark::imaging {

enum class ResultForm { segmentation, structure_set };

// The kind of a DICOM file by its SOP class; nothing when it is neither or cannot be read.
[[nodiscard]] std::optional<ResultForm> result_form_of(const std::filesystem::path& file);

// Fails (ErrorKind::usage) where the file is a DICOM object of a class that no result here has, such as an
// image: studies are never written to, whatever a result is to be called.
[[nodiscard]] Status spare_study_file(const std::filesystem::path& file);

// StudyInstanceUID (0020,000D) of any DICOM file; empty when it has none or cannot be read.
[[nodiscard]] std::string study_uid_of(const std::filesystem::path& file);

// The DICOM files of the series that was segmented, in slice order (Series::files): the result belongs to
// their patient, study and frame of reference, and refers to them slice by slice, in images of many frames to
// the frames at each slice's place. Empty when the volume was not DICOM: the result then makes a new study of
// an anonymous patient.
using SourceFiles = std::span<const std::filesystem::path>;

// Segmentation Storage, BINARY: a frame for each segment and slice that is not empty (DICOM PS3.3 A.51).
// Fails with ErrorKind::write, with ErrorKind::input when a source file cannot be read, and with
// ErrorKind::capability on a grid that DICOM cannot describe.
Status write_segmentation(const Segments& segments, SourceFiles source, const std::filesystem::path& file,
                          const Progress& progress = {});

// RT Structure Set Storage: a region of interest for each segment, closed planar contours slice by slice,
// where its phi is 0 or, without phi, half way between voxels inside and outside (PS3.3 A.19). Fails
// likewise.
Status write_structure_set(const Segments& segments, SourceFiles source, const std::filesystem::path& file,
                           const Progress& progress = {});

// The segments of a Segmentation. With a grid: on its voxels, whichever way the frames run. Without: on the
// smallest grid that holds all frames. Fails (ErrorKind::input) when frames do not lie on the voxels.
Result<Segments> read_segmentation(const std::filesystem::path& file, const Geometry* grid = nullptr);

// The regions of a structure set: inside are the grid's voxels whose centres the contours surround. Contours
// of one region in one slice are combined by exclusive or, so that both kinds of holes are holes. Fails
// (ErrorKind::input) when contours do not lie in the grid's slices.
Result<Segments> read_structure_set(const std::filesystem::path& file, const Geometry& grid);

// Either of them; a structure set needs the grid.
Result<Segments> read_result(const std::filesystem::path& file, const Geometry* grid);

// A sentence for users where results, or an image, name a frame of reference that is not the study's; none
// where either is not known.
[[nodiscard]] std::optional<std::string> frame_remark(std::span<const std::string> named,
                                                      const std::string& of_study);

// Whether the file is a parametric map or a segmentation, by its SOP class.
[[nodiscard]] bool holds_map(const std::filesystem::path& file);

// The values of a parametric map (Parametric Map Storage, PS3.3 A.75: float, double or whole numbers, by its
// real world value mapping), or of a segmentation as fractions from 0 to 1: at each voxel the largest of its
// segments. Fails (ErrorKind::input) when frames lie on no common grid, or several of a parametric map at one
// place.
struct LoadedMap {
  Volume volume;              // float, on the smallest grid that holds all frames
  std::vector<bool> covered;  // whether a frame has the voxel; others are 0
  std::string frame_of_reference_uid;
};
Result<LoadedMap> read_map(const std::filesystem::path& file);

// A mask from any file that can be one, on that grid: a volume (every voxel that is not 0), a Segmentation or
// a structure set (what is inside any of its segments). Without a grid: on its own, which a structure set has
// not. Fails (ErrorKind::input) naming the file and why it does not fit.
struct LoadedMask {
  Mask mask;
  std::vector<std::string> changes;                   // left out by reading, one sentence each
  std::vector<std::string> frames_of_reference = {};  // as of Segments
};
Result<LoadedMask> load_any_mask(const std::filesystem::path& file, const Geometry* grid,
                                 const Progress& progress = {});

// phi (float, > 0 inside, in units of the smallest voxel spacing, beyond the band +-band) as an OpenVDB level
// set in mm and patient coordinates (LPS): negative inside, as OpenVDB's are. Voxels within the band are
// active. Where the volume's border is inside, voxels one beyond it close the surface.
Status write_level_set(const Volume& phi, double band, const std::filesystem::path& file);

}  // namespace tidemark::imaging
