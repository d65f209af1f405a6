// Paths of the file system as texts of Qt, and back.
#pragma once

#include <QString>
#include <filesystem>
#include <system_error>

namespace tidemark::ui {

// Bytes that are not UTF-8, which names on old media may have, become U+FFFD: std::filesystem's own
// conversions throw.
inline QString text_of(const std::filesystem::path& path) {
  return QString::fromStdString(path.native());
}

// Never throws, as conversions from UTF-16 do: half a surrogate pair becomes U+FFFD or "?".
inline std::filesystem::path path_of(const QString& text) {
  return text.toStdString();
}

// Whether both are there and are one file, by whatever name.
inline bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code none;
  return std::filesystem::equivalent(a, b, none);
}

// Whether they are one file once both are written, though none may be there yet.
inline bool is_same_place(const QString& a, const QString& b) {
  const std::filesystem::path one = path_of(a);
  const std::filesystem::path other = path_of(b);
  return is_same_file(one, other) ||
         (one.filename() == other.filename() && is_same_file(one.parent_path(), other.parent_path()));
}

}  // namespace tidemark::ui
