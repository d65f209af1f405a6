#include "document/checksum.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <bit>
#include <fstream>
#include <memory>
#include <vector>

namespace tidemark::document {
namespace {

static_assert(std::endian::native == std::endian::little,
              "files and checksums are made of little-endian numbers");

constexpr std::size_t kPiece = std::size_t{1} << 20;

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    good_ = context_ != nullptr && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1;
  }
  void add(std::span<const std::byte> bytes) {
    good_ = good_ && EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1;
  }
  template <class Number>
  void add_numbers(std::span<const Number> numbers) {
    add(std::as_bytes(numbers));
  }
  std::string finish() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned length = 0;
    good_ = good_ && EVP_DigestFinal_ex(context_.get(), digest.data(), &length) == 1;
    std::string text;
    for (unsigned i = 0; good_ && i < length; ++i) text += fmt::format("{:02x}", digest[i]);
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
  bool good_ = false;
};

}  // namespace

std::string sha256(std::span<const std::byte> bytes) {
  Sha256 sum;
  sum.add(bytes);
  return sum.finish();
}

Result<std::string> sha256_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  Sha256 sum;
  std::vector<char> piece(kPiece);
  while (stream.good()) {
    stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    sum.add(std::as_bytes(std::span(piece).first(static_cast<std::size_t>(stream.gcount()))));
  }
  if (!stream.eof()) return fail(ErrorKind::input, "{}: cannot be read", file.string());
  return sum.finish();
}

std::string checksum_of(const Volume& volume, const std::stop_token& stop) {
  Sha256 sum;
  const Geometry& geometry = volume.geometry;
  const std::array<std::int64_t, 4> sizes{geometry.size.x, geometry.size.y, geometry.size.z,
                                          static_cast<std::int64_t>(volume.voxels.index())};
  sum.add_numbers(std::span<const std::int64_t>(sizes));
  std::vector<double> numbers{volume.slope, volume.intercept};
  for (int a = 0; a < 3; ++a) {
    numbers.insert(numbers.end(), {geometry.spacing_mm[a], geometry.origin_mm[a]});
    for (int b = 0; b < 3; ++b) numbers.push_back(geometry.direction[a][b]);
  }
  sum.add_numbers(std::span<const double>(numbers));
  auto voxels =
      std::visit([](const auto& stored) { return std::as_bytes(std::span(stored)); }, volume.voxels);
  while (!voxels.empty()) {
    if (stop.stop_requested()) return {};
    const auto piece = voxels.first(std::min(voxels.size(), kPiece));
    sum.add(piece);
    voxels = voxels.subspan(piece.size());
  }
  return sum.finish();
}

}  // namespace tidemark::document
