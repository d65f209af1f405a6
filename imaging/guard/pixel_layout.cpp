#include "imaging/guard/pixel_layout.h"

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <memory>

#include "core/deflate_ratio.h"
#include "imaging/guard/text_voxels.h"

namespace tidemark::imaging::files {
namespace {

struct InflateEnd {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};

// Inflates the stream (gzip members one after the other, or one zlib stream) and hands it to `take` piece by
// piece. Stops once more than `limit` bytes have come out. Returns how many did.
template <class Take>
Result<std::int64_t> inflate_stream(const std::filesystem::path& file, std::int64_t offset,
                                    std::int64_t limit, const Take& take) {
  std::ifstream input(file, std::ios::binary);
  if (!input.seekg(offset)) return fail(ErrorKind::input, "{}: cannot be read", file.string());
  z_stream stream{};
  if (inflateInit2(&stream, 15 + 32) != Z_OK) return fail(ErrorKind::capability, "zlib: no memory");
  const std::unique_ptr<z_stream, InflateEnd> end(&stream);
  constexpr std::size_t kChunk = 1 << 17;
  std::vector<unsigned char> packed(kChunk);
  std::vector<unsigned char> unpacked(kChunk);
  std::int64_t length = 0;
  int state = Z_OK;
  while (length <= limit) {
    if (stream.avail_in == 0) {
      input.read(reinterpret_cast<char*>(packed.data()), kChunk);
      stream.next_in = packed.data();
      stream.avail_in = static_cast<uInt>(input.gcount());
      if (stream.avail_in == 0) break;
    }
    if (state == Z_STREAM_END) {
      if (stream.next_in[0] != 0x1f || inflateReset(&stream) != Z_OK) break;  // padding, not a member
    }
    stream.next_out = unpacked.data();
    stream.avail_out = kChunk;
    state = inflate(&stream, Z_NO_FLUSH);
    if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR) {
      return fail(ErrorKind::input, "{}: the compressed data are damaged ({})", file.string(),
                  stream.msg != nullptr ? stream.msg : "zlib error");
    }
    const auto count = static_cast<std::int64_t>(kChunk - stream.avail_out);
    take(unpacked.data(), count, length);
    length += count;
  }
  if (length <= limit && state != Z_STREAM_END) {
    return fail(ErrorKind::input, "{}: truncated: the compressed data end early", file.string());
  }
  return length;
}

template <class Take>
Status inflate_exactly(const PixelLayout& layout, const Take& take) {
  const std::int64_t expected = layout.prefix + layout.bytes;
  const auto length = inflate_stream(layout.file, layout.offset, expected, take);
  if (!length) return pass_on(length);
  if (*length == expected) return {};
  return fail(ErrorKind::input, "{}: the header says {} bytes, the compressed data hold {}{}",
              layout.file.string(), expected, *length > expected ? "more than " : "",
              std::min(*length, expected));
}

}  // namespace

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool has_suffix(const std::filesystem::path& file, const char* suffix) {
  return lower(file.filename().string()).ends_with(suffix);
}

std::optional<Format> format_of(const std::filesystem::path& file) {
  if (has_suffix(file, ".nii") || has_suffix(file, ".nii.gz")) return Format::nifti;
  if (has_suffix(file, ".nrrd") || has_suffix(file, ".nhdr")) return Format::nrrd;
  if (has_suffix(file, ".mha") || has_suffix(file, ".mhd")) return Format::meta;
  if (has_suffix(file, ".gipl") || has_suffix(file, ".gipl.gz")) return Format::gipl;
  return std::nullopt;
}

Result<PixelLayout> locate_pixels(const std::filesystem::path& file) {
  const auto format = format_of(file);
  if (!format) {
    return fail(ErrorKind::input, "{}: not a volume file (.nii .nii.gz .nrrd .nhdr .mha .mhd .gipl .gipl.gz)",
                file.string());
  }
  switch (*format) {
    case Format::nifti:
      return locate_nifti(file);
    case Format::nrrd:
      return locate_nrrd(file);
    case Format::meta:
      return locate_meta(file);
    case Format::gipl:
      return locate_gipl(file);
  }
  return fail(ErrorKind::internal, "{}: unknown format", file.string());
}

Status check_extent(const PixelLayout& layout) {
  std::error_code error;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(layout.file, error));
  if (error) return fail(ErrorKind::input, "{}: {}", layout.file.string(), error.message());
  const std::int64_t there = std::max<std::int64_t>(0, size - layout.offset);
  if (layout.coding == Coding::raw && there > layout.bytes) {
    return fail(ErrorKind::input, "{}: the header says {} bytes of voxels, the file has {} more",
                layout.file.string(), layout.bytes, there - layout.bytes);
  }
  const bool enough = layout.coding == Coding::raw    ? there == layout.bytes
                      : layout.coding == Coding::text ? there / 2 + 1 >= layout.voxels
                                                      : layout.bytes / kBestDeflateRatio <= there &&
                                                            layout.prefix / kBestDeflateRatio <= there;
  if (enough) return {};
  return fail(ErrorKind::input, "{}: truncated: the header says {} bytes of voxels, the file has {}{}",
              layout.file.string(), layout.bytes, there,
              layout.coding == Coding::deflate ? ", compressed" : "");
}

Status check_stream(const PixelLayout& layout) {
  if (layout.coding == Coding::text) return read_text(layout, [](std::int64_t, double) { return Status(); });
  if (layout.coding == Coding::raw) return {};
  return inflate_exactly(layout, [](const unsigned char*, std::int64_t, std::int64_t) {});
}

Status read_stored(const PixelLayout& layout, void* destination) {
  auto* const voxels = static_cast<unsigned char*>(destination);
  if (layout.coding == Coding::deflate) {
    return inflate_exactly(layout, [&](const unsigned char* piece, std::int64_t count, std::int64_t at) {
      const std::int64_t first = std::max(at, layout.prefix);
      const std::int64_t last = std::min(at + count, layout.prefix + layout.bytes);
      if (first < last)
        std::copy(piece + (first - at), piece + (last - at), voxels + (first - layout.prefix));
    });
  }
  std::ifstream input(layout.file, std::ios::binary);
  input.seekg(layout.offset);
  if (!input.read(static_cast<char*>(destination), layout.bytes)) {
    return fail(ErrorKind::input, "{}: the voxels cannot be read", layout.file.string());
  }
  return {};
}

bool is_gzip(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return stream.get() == 0x1f && stream.get() == 0x8b;
}

Result<std::string> read_start(const std::filesystem::path& file, std::size_t count) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) return fail(ErrorKind::input, "{}: no such file", file.string());
  if (!std::filesystem::is_regular_file(status)) {
    return fail(ErrorKind::input, "{}: not a regular file", file.string());
  }
  const gzFile stream = gzopen(file.c_str(), "rb");  // reads files that are not gzip as they are
  if (stream == nullptr) return fail(ErrorKind::input, "{}: cannot be opened", file.string());
  std::string start(count, '\0');
  const int got = gzread(stream, start.data(), static_cast<unsigned>(count));
  gzclose_r(stream);
  if (got < 0) return fail(ErrorKind::input, "{}: the compressed data are damaged", file.string());
  start.resize(static_cast<std::size_t>(got));
  return start;
}

std::optional<std::string> TextHeader::find(const std::string& name) const {
  const auto field = fields.find(name);
  if (field == fields.end()) return std::nullopt;
  return field->second;
}

std::optional<std::vector<std::int64_t>> whole_numbers(const std::string& text) {
  std::vector<std::int64_t> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    while (at != end && (*at == ' ' || *at == '\t')) ++at;
    if (at == end) return numbers;
    std::int64_t number = 0;
    const auto [next, error] = std::from_chars(at, end, number);
    if (error != std::errc() || (next != end && *next != ' ' && *next != '\t')) return std::nullopt;
    numbers.push_back(number);
    at = next;
  }
}

Result<std::filesystem::path> detached_file(const std::filesystem::path& header, const std::string& name) {
  const std::filesystem::path path(name);
  const bool several = name.find('%') != std::string::npos || name.rfind("LIST", 0) == 0;
  const bool outside = path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end();
  std::error_code ignored;
  const bool is_folder = std::filesystem::is_directory(header.parent_path() / path, ignored);
  if (name.empty() || several || outside || is_folder) {
    return fail(ErrorKind::input, "{}: data file '{}': only one file in the header's folder is accepted",
                header.string(), name);
  }
  return header.parent_path() / path;
}

}  // namespace tidemark::imaging::files
