// DICOM series in, through DCMTK: classic images, enhanced images of many frames, Siemens mosaics.
#pragma once

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "core/volume.h"
#include "imaging/series.h"

namespace tidemark::imaging {

// Whether the file starts as DICOM does ("DICM" at byte 128, or a plausible first tag of a file without
// preamble). Reads at most 256 bytes.
bool looks_like_dicom(const std::filesystem::path& file);

// Reads the headers of all files below `path` (in parallel) and groups their slices into series, and parts of
// series that hold several volumes, each sorted by ImagePositionPatient along the slice normal (DICOM PS3.3
// C.7.6.2.1.1), with geometry from the positions, never from SliceThickness. Of one file: the series, or the
// parts, that it belongs to. Files that are not DICOM images go to Catalogue::skipped.
Result<Catalogue> scan_dicom(const std::filesystem::path& path, const Progress& progress = {});

// Decodes the frames of a loadable series (in parallel) into one volume.
Result<Volume> load_dicom(const Series& series, const Progress& progress = {});

// The attributes of a written series.
struct DicomSeriesHeader {
  std::string modality = "MR";  // "CT" or "MR": the storage class that is written
  std::string patient_name = "Phantom";
  std::string patient_id = "PHANTOM";
  std::string series_description;
  WindowLevel window;
};

// Writes the volume (int16 or uint16) into `folder`, created if need be, as one classic single-frame
// CT or MR Image Storage file a slice, explicit little endian, with UIDs from the 2.25 root. The series
// appears whole or not at all: on failure (ErrorKind::write) the folder is unchanged.
Status write_dicom_series(const Volume& volume, const DicomSeriesHeader& header,
                          const std::filesystem::path& folder, const Progress& progress = {});

}  // namespace tidemark::imaging
