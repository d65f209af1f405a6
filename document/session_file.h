// Session files (.tidemark): a case in one zip archive, but for the volume's voxels.
//
// Entries: session.json, phi.table (int32 a virtual page) and phi.pages (float), labels and truth (uint8 a
// voxel, each only where there are any), and those of the history (history_file.h). Numbers are
// little-endian.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "document/session_contents.h"

namespace tidemark::document {

inline constexpr int kSessionVersion = 1;
// Of the archive, session.json first.
[[nodiscard]] std::span<const std::string_view> session_entry_names();

// Whole or not at all. The history takes time, and is not for copies that are made in passing.
enum class InFile { all, no_history };
Status write_session(const SessionContents& contents, const std::filesystem::path& file,
                     InFile what = InFile::all);
// Fails (ErrorKind::input) naming the file and what is wrong in it. The origin's path is the one that exists:
// relative to the session file, else where it was when it was saved.
Result<SessionContents> load_session(const std::filesystem::path& file);
// The origin alone, without reading the rest.
Result<StudyOrigin> load_origin(const std::filesystem::path& file);

}  // namespace tidemark::document
