#include "imaging/ai/packed_bytes.h"

#include <zlib.h>

#include <algorithm>
#include <memory>

#include "core/typed_volume.h"

namespace tidemark::imaging {
namespace {

constexpr int kGzip = 15 + 16;                // the largest window, with a header of gzip
constexpr std::size_t kMostAtOnce = 1 << 30;  // zlib counts in 32 bits

}  // namespace

Status pack_values(const Volume& volume, const std::filesystem::path& file, const Progress& progress) {
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> out(gzopen(file.c_str(), "wb1"), gzclose);
  const auto failed = [&] {
    return fail(ErrorKind::write, "{}: cannot be written: is the disk full?", file.string());
  };
  if (out == nullptr) return failed();
  const Index3 size = volume.geometry.size;
  const auto slice = static_cast<std::size_t>(size.x * size.y);
  std::vector<float> values(slice);
  for (std::int64_t k = 0; k < size.z; ++k) {
    if (progress.cancelled()) return cancelled_error();
    progress(static_cast<double>(k) / static_cast<double>(size.z), "packing the image");
    with_type(volume, [&](const auto& typed) {
      const std::int64_t first = volume.geometry.offset({0, 0, k});
      for (std::size_t at = 0; at < slice; ++at)
        values[at] = typed.value(first + static_cast<std::int64_t>(at));
    });
    const std::size_t bytes = slice * sizeof(float);
    if (gzfwrite(values.data(), 1, bytes, out.get()) != bytes) return failed();
  }
  if (gzflush(out.get(), Z_FINISH) != Z_OK) return failed();
  return {};
}

std::optional<std::vector<std::uint8_t>> unpacked(std::string_view gzip, std::int64_t bytes) {
  z_stream stream{};
  if (inflateInit2(&stream, kGzip) != Z_OK) return std::nullopt;
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
  std::vector<std::uint8_t> all(static_cast<std::size_t>(bytes));
  std::uint8_t beyond = 0;  // one more would show that there are too many
  std::size_t taken = 0;
  std::size_t given = 0;
  int state = Z_OK;
  while (state == Z_OK) {
    const std::size_t in = std::min(gzip.size() - taken, kMostAtOnce);
    const bool is_full = given == all.size();
    const std::size_t room = is_full ? 1 : std::min(all.size() - given, kMostAtOnce);
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(gzip.data())) + taken;
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = is_full ? &beyond : all.data() + given;
    stream.avail_out = static_cast<uInt>(room);
    state = inflate(&stream, Z_NO_FLUSH);
    taken += in - stream.avail_in;
    const std::size_t got = room - stream.avail_out;
    if (is_full && got > 0) return std::nullopt;
    given += is_full ? 0 : got;
    if (got == 0 && stream.avail_in == in) break;  // it ends early
  }
  if (state != Z_STREAM_END || given != all.size()) return std::nullopt;
  return all;
}

}  // namespace tidemark::imaging
