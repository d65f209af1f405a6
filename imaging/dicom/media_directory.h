// DICOMDIR, the table of contents of a DICOM medium (PS3.3 F, PS3.10 8).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/result.h"

namespace tidemark::imaging {

// Files that a directory names and that are not there.
struct MissingFiles {
  std::int64_t count = 0;
  std::vector<std::string> first_names;  // as the directory names them: "IMAGES/IM000001"
};

struct MediaDirectory {
  std::vector<std::filesystem::path> files;  // that are there, in the order of their records, each once
  MissingFiles missing;
  // By the UID of the series whose record stands before theirs; of very many series some are left out.
  std::map<std::string, MissingFiles> missing_of_series;
};

// By its name, which the standard prescribes; discs' file systems change its case or add ";1".
[[nodiscard]] bool is_media_directory(const std::filesystem::path& file);

// The files that it refers to. Names are compared without regard to case, and to the ";1" and the last point
// of ISO 9660. What lies outside the directory's own folder, or behind a link, counts as missing. Fails
// (ErrorKind::input), naming the file, when it is damaged or is no such directory.
//
// The walk that checks the file's tags reads it, in one pass and without DCMTK: a directory of many records
// takes time that is linear in its size, and the memory of what it names.
[[nodiscard]] Result<MediaDirectory> read_media_directory(const std::filesystem::path& file,
                                                          const Progress& progress = {});

// "a, b and 7 more"
[[nodiscard]] std::string list_missing(const MissingFiles& missing);

}  // namespace tidemark::imaging
