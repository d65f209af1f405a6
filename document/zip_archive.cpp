#include "document/zip_archive.h"

#include <zip.h>

#include <algorithm>
#include <deque>
#include <utility>

#include "core/deflate_ratio.h"

namespace tidemark::document {
namespace {

std::string reason(int code) {
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  std::string text = zip_error_strerror(&error);
  zip_error_fini(&error);
  return text;
}

// An entry as libzip asks for it.
class EntrySource {
 public:
  explicit EntrySource(const ZipEntry& entry) : entry_(entry) { zip_error_init(&error_); }

  static zip_int64_t call(void* self, void* data, zip_uint64_t length, zip_source_cmd_t command) {
    return static_cast<EntrySource*>(self)->answer(data, length, command);
  }

 private:
  zip_int64_t answer(void* data, zip_uint64_t length, zip_source_cmd_t command) {
    switch (command) {
      case ZIP_SOURCE_SUPPORTS:
        return zip_source_make_command_bitmap(ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE,
                                              ZIP_SOURCE_STAT, ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, -1);
      case ZIP_SOURCE_STAT: {
        auto* const stat = static_cast<zip_stat_t*>(data);
        zip_stat_init(stat);
        stat->size = entry_.bytes;
        stat->valid = ZIP_STAT_SIZE;
        return sizeof(zip_stat_t);
      }
      case ZIP_SOURCE_OPEN:
        next_ = 0;
        rest_ = {};
        return 0;
      case ZIP_SOURCE_READ:
        return static_cast<zip_int64_t>(read({static_cast<std::byte*>(data), length}));
      case ZIP_SOURCE_CLOSE:
      case ZIP_SOURCE_FREE:
        return 0;
      case ZIP_SOURCE_ERROR:
        return zip_error_to_data(&error_, data, length);
      default:
        zip_error_set(&error_, ZIP_ER_OPNOTSUPP, 0);
        return -1;
    }
  }

  std::size_t read(std::span<std::byte> into) {
    std::size_t done = 0;
    while (done < into.size()) {
      if (rest_.empty()) rest_ = entry_.piece(next_++);
      if (rest_.empty()) break;
      const std::size_t count = std::min(rest_.size(), into.size() - done);
      std::copy_n(rest_.begin(), count, into.begin() + static_cast<std::ptrdiff_t>(done));
      rest_ = rest_.subspan(count);
      done += count;
    }
    return done;
  }

  const ZipEntry& entry_;
  std::size_t next_ = 0;             // piece
  std::span<const std::byte> rest_;  // of the one before
  zip_error_t error_;
};

}  // namespace

Result<ZipReader> ZipReader::open(const std::filesystem::path& file,
                                  std::span<const std::string_view> names) {
  constexpr std::int64_t kMostEntries = 100;  // before their names are looked at
  auto opened = imaging::FileBytes::open(file);
  if (!opened) return pass_on(opened);
  ZipReader reader;
  reader.file_ = file.string();
  auto directory = imaging::ZipDirectory::read(std::move(*opened), kMostEntries);
  if (!directory) {
    return fail(ErrorKind::input, "{}: is damaged, or was not written by Tidemark", reader.file_);
  }
  reader.directory_ = std::make_unique<imaging::ZipDirectory>(std::move(*directory));
  for (const imaging::ZipRecord& record : reader.directory_->records()) {
    const bool is_known = std::find(names.begin(), names.end(), record.name) != names.end();
    if (!is_known || !reader.entries_.try_emplace(record.name, &record).second) {
      return fail(ErrorKind::input, "{}: holds entries that do not belong into it", reader.file_);
    }
  }
  return reader;
}

bool ZipReader::has(std::string_view name) const {
  return entries_.find(name) != entries_.end();
}

std::size_t ZipReader::size(std::string_view name) const {
  const auto found = entries_.find(name);
  return found == entries_.end() ? 0 : static_cast<std::size_t>(found->second->bytes);
}

std::size_t ZipReader::packed_size(std::string_view name) const {
  const auto found = entries_.find(name);
  return found == entries_.end() ? 0 : static_cast<std::size_t>(found->second->packed);
}

Status ZipReader::unpack(std::string_view name, std::size_t bytes, const imaging::ZipDirectory::Take& take) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return fail(ErrorKind::input, "{}: {} is missing", file_, name);
  const imaging::ZipRecord& record = *found->second;
  if (static_cast<std::size_t>(record.bytes) != bytes) {
    return fail(ErrorKind::input, "{}: {} has {} bytes instead of {}", file_, name, record.bytes, bytes);
  }
  if (static_cast<std::int64_t>(bytes / kBestDeflateRatio) > record.packed) {
    return fail(ErrorKind::input, "{}: {} cannot hold {} bytes", file_, name, bytes);
  }
  if (const Status unpacked = directory_->unpack(record, take); !unpacked)
    return fail(ErrorKind::input, "{}: {} is damaged: {}", file_, name, unpacked.error().message);
  return {};
}

Status write_zip(const std::filesystem::path& file, std::span<const ZipEntry> entries) {
  int code = 0;
  zip_t* archive = zip_open(file.c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code);
  if (archive == nullptr) {
    return fail(ErrorKind::write, "cannot write: {}", reason(code));
  }
  std::deque<EntrySource> sources;
  bool good = true;
  for (const ZipEntry& entry : entries) {
    zip_source_t* source = zip_source_function(archive, EntrySource::call, &sources.emplace_back(entry));
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
  return fail(ErrorKind::write, "cannot write: {}", why);
}

}  // namespace tidemark::document
