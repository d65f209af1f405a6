// A file of servers: where it lies, and the parts of it that all such files share.
#pragma once

#include <filesystem>
#include <string>

#include "core/json/json_field.h"
#include "core/result.h"
#include "imaging/web/web_server.h"

namespace tidemark::imaging {

// Which of both to read: `own` where it is there, else the site's of that name in site_folder(), where that
// is. A site's that says "locked": true comes first, and so does one that cannot be read.
[[nodiscard]] std::filesystem::path server_file_to_read(const std::filesystem::path& own, const char* name);

// The file that a user has chosen; where none is (empty), server_file_to_read(). Fails (ErrorKind::usage)
// where the site has locked its own.
Result<std::filesystem::path> chosen_server_file(const std::filesystem::path& chosen,
                                                 const std::filesystem::path& own, const char* name);

// The most that such a file may hold.
inline constexpr JsonLimits kServerFileLimits{.bytes = std::size_t{1} << 20, .depth = 8};
inline constexpr std::size_t kMostServers = 100;
// Its text. `purpose` says what it is for where it is missing. Fails (ErrorKind::input) naming the file.
Result<std::string> text_of_server_file(const std::filesystem::path& file, const char* purpose);

// Relative paths are those in `folder`; empty where there is none.
std::filesystem::path read_path(const JsonField& parent, const char* key,
                                const std::filesystem::path& folder);
void read_whole(const JsonField& parent, const char* key, int high, int& value);
// Whether a site's file is locked.
[[nodiscard]] bool read_locked(const JsonField& root);
// The fields url, user and secret.
WebAccess read_web_access(const JsonField& field, const std::filesystem::path& folder);
TlsFiles read_tls(const JsonField& field, const std::filesystem::path& folder);

}  // namespace tidemark::imaging
