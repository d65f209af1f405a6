// The folder of copies that outlive a crash: who may look into it, and which copies nobody holds.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/file_lock.h"
#include "core/result.h"

namespace tidemark::document {

// Copies have ids of letters, digits and hyphens; their files are named "ID.SUFFIX".
[[nodiscard]] std::string new_copy_id();
[[nodiscard]] bool is_copy_id(const std::string& id);

// Makes the folder, for its owner alone, and holds the copy there. Fails with ErrorKind::write, also when
// another holds it, and with ErrorKind::usage on an id that is none.
Result<FileLock> hold_copy(const std::filesystem::path& folder, const std::string& id);
// Whether a running program holds it.
[[nodiscard]] bool is_held(const std::filesystem::path& folder, const std::string& id);
// The ids of copies with a file "ID....SUFFIX" that no running program holds, each once.
[[nodiscard]] std::vector<std::string> left_copies(const std::filesystem::path& folder,
                                                   std::string_view suffix);
void remove_hold(const std::filesystem::path& folder, const std::string& id);

}  // namespace tidemark::document
