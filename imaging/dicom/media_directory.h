// DICOMDIR, the table of contents of a DICOM medium (PS3.3 F, PS3.10 8).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/result.h"

namespace tidemark {

struct MediaDirectory {
  struct Missing {
    std::string name;        // as the directory names it: "IMAGES/IM000001"
    std::string series_uid;  // of the series whose record stands before it
  };
  std::vector<std::filesystem::path> files;  // that are there, in the order of their records, each once
  std::vector<Missing> missing;
};

// By its name, which the standard prescribes; discs' file systems change its case or add ";1".
[[nodiscard]] bool is_media_directory(const std::filesystem::path& file);

// The files that it refers to. Names are compared without regard to case, and to the ";1" and the last point
// of ISO 9660. What lies outside the directory's own folder, or behind a link, counts as missing. Fails
// (ErrorKind::input), naming the file, when it is damaged or is no such directory.
[[nodiscard]] Result<MediaDirectory> read_media_directory(const std::filesystem::path& file);

// "a, b and 7 more"
[[nodiscard]] std::string list_missing(const std::vector<MediaDirectory::Missing>& missing);

}  // namespace tidemark
