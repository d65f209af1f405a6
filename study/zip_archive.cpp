#include "study/zip_archive.h"

#include <zip.h>

#include <algorithm>

namespace tidemark {
namespace {

// Deflate makes at most so many bytes of one.
constexpr std::size_t kMostPerByte = 1032;

std::string reason(int code) {
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

}  // namespace

void ZipReader::Discard::operator()(struct zip* archive) const {
  zip_discard(archive);
}

Result<ZipReader> ZipReader::open(const std::filesystem::path& file,
                                  std::span<const std::string_view> names) {
  ZipReader reader;
  reader.file_ = file.string();
  int code = 0;
  reader.archive_.reset(zip_open(file.c_str(), ZIP_RDONLY | ZIP_CHECKCONS, &code));
  if (reader.archive_ == nullptr) {
    const bool readable = code == ZIP_ER_NOZIP || code == ZIP_ER_INCONS;
    return fail(ErrorKind::input, "{}: {}", reader.file_,
                readable ? "is damaged, or was not written by Tidemark" : "cannot be read: " + reason(code));
  }
  const zip_int64_t count = zip_get_num_entries(reader.archive_.get(), 0);
  for (zip_int64_t i = 0; i < count; ++i) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    constexpr zip_uint64_t kNeeded = ZIP_STAT_NAME | ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE;
    const bool good = zip_stat_index(reader.archive_.get(), static_cast<zip_uint64_t>(i), 0, &stat) == 0 &&
                      (stat.valid & kNeeded) == kNeeded;
    if (!good || std::find(names.begin(), names.end(), stat.name) == names.end() || reader.has(stat.name)) {
      return fail(ErrorKind::input, "{}: holds entries that do not belong into it", reader.file_);
    }
    reader.entries_[stat.name] = {static_cast<std::size_t>(i), static_cast<std::size_t>(stat.size),
                                  static_cast<std::size_t>(stat.comp_size)};
  }
  return reader;
}

bool ZipReader::has(std::string_view name) const {
  return entries_.find(name) != entries_.end();
}

std::size_t ZipReader::size(std::string_view name) const {
  const auto found = entries_.find(name);
  return found == entries_.end() ? 0 : found->second.bytes;
}

Result<std::vector<std::byte>> ZipReader::read(std::string_view name, std::size_t bytes) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return fail(ErrorKind::input, "{}: {} is missing", file_, name);
  const Entry& entry = found->second;
  if (entry.bytes != bytes) {
    return fail(ErrorKind::input, "{}: {} has {} bytes instead of {}", file_, name, entry.bytes, bytes);
  }
  if (bytes / kMostPerByte > entry.compressed) {
    return fail(ErrorKind::input, "{}: {} cannot hold {} bytes", file_, name, bytes);
  }
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> stream(
      zip_fopen_index(archive_.get(), entry.index, 0), zip_fclose);
  if (stream == nullptr) return fail(ErrorKind::input, "{}: {} cannot be read", file_, name);
  std::vector<std::byte> contents(bytes);
  std::size_t done = 0;
  zip_int64_t got = 1;
  while (done < bytes && got > 0) {
    got = zip_fread(stream.get(), contents.data() + done, bytes - done);
    if (got > 0) done += static_cast<std::size_t>(got);
  }
  // Reading on to the end is what compares the entry's own checksum.
  std::byte beyond{};
  if (done < bytes || zip_fread(stream.get(), &beyond, 1) != 0) {
    return fail(ErrorKind::input, "{}: {} is damaged", file_, name);
  }
  return contents;
}

Status write_zip(const std::filesystem::path& file, std::span<const ZipEntry> entries) {
  int code = 0;
  zip_t* archive = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
  if (archive == nullptr) {
    return fail(ErrorKind::write, "{}: cannot write: {}", file.string(), reason(code));
  }
  bool good = true;
  for (const ZipEntry& entry : entries) {
    zip_source_t* source = zip_source_buffer(archive, entry.bytes.data(), entry.bytes.size(), 0);
    const zip_int64_t index =
        source == nullptr ? -1
                          : zip_file_add(archive, std::string(entry.name).c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0 && source != nullptr) zip_source_free(source);
    constexpr zip_uint32_t kFastest = 1;
    good = good && index >= 0 &&
           zip_set_file_compression(archive, static_cast<zip_uint64_t>(index), ZIP_CM_DEFLATE, kFastest) == 0;
  }
  if (good && zip_close(archive) == 0) return {};
  const std::string why = zip_strerror(archive);
  zip_discard(archive);
  return fail(ErrorKind::write, "{}: cannot write: {}", file.string(), why);
}

}  // namespace tidemark
