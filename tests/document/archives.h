// Session files as their archives' entries, to be looked at and to be spoilt.
#pragma once

#include <zip.h>

#include <filesystem>
#include <map>
#include <string>

#include "tests/support/support.h"

namespace tidemark::test {

using Entries = std::map<std::string, std::string>;

inline Entries entries_of(const std::filesystem::path& file) {
  Entries entries;
  zip_t* archive = zip_open(file.c_str(), ZIP_RDONLY, nullptr);
  if (archive == nullptr) qFatal("no archive");
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive, 0); ++i) {
    zip_stat_t stat;
    zip_stat_index(archive, static_cast<zip_uint64_t>(i), 0, &stat);
    std::string bytes(stat.size, '\0');
    zip_file_t* entry = zip_fopen_index(archive, static_cast<zip_uint64_t>(i), 0);
    zip_fread(entry, bytes.data(), bytes.size());
    zip_fclose(entry);
    entries[stat.name] = std::move(bytes);
  }
  zip_discard(archive);
  return entries;
}

inline void write_entries(const std::filesystem::path& file, const Entries& entries) {
  zip_t* archive = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
  for (const auto& [name, bytes] : entries) {
    zip_file_add(archive, name.c_str(), zip_source_buffer(archive, bytes.data(), bytes.size(), 0), 0);
  }
  if (zip_close(archive) != 0) qFatal("no archive could be written");
}

}  // namespace tidemark::test
