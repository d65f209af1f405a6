#include "tests/imaging/dicom/nifti_peer.h"

#include <QProcess>
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <iterator>

namespace tidemark::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "dcm2niix";
constexpr int kLongestRun = 60'000;  // ms

// A NIfTI-1 file of a little endian machine, read by its published layout.
class NiftiBytes {
 public:
  explicit NiftiBytes(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(stream), {});
  }
  [[nodiscard]] bool is_whole() const { return bytes_.size() >= 352 && at<std::int32_t>(0) == 348; }
  template <class T>
  [[nodiscard]] T at(std::size_t offset) const {
    T value{};
    if (offset + sizeof value <= bytes_.size()) std::memcpy(&value, bytes_.data() + offset, sizeof value);
    return value;
  }
  [[nodiscard]] std::size_t size() const { return bytes_.size(); }

 private:
  std::vector<char> bytes_;
};

template <class Stored>
void read_values(const NiftiBytes& bytes, std::size_t first, std::vector<float>& values) {
  const auto start = static_cast<std::size_t>(bytes.at<float>(108));  // vox_offset
  const double written = static_cast<double>(bytes.at<float>(112));   // scl_slope; 0 says 1
  const double slope = written != 0.0 ? written : 1.0;
  const double intercept = static_cast<double>(bytes.at<float>(116));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto stored = bytes.at<Stored>(start + (first + i) * sizeof(Stored));
    values[i] = static_cast<float>(slope * static_cast<double>(stored) + intercept);
  }
}

std::vector<PeerVolume> volumes_of(const NiftiBytes& bytes) {
  if (!bytes.is_whole()) return {};
  PeerVolume volume;
  const int dimensions = bytes.at<std::int16_t>(40);
  for (int axis = 0; axis < 3; ++axis) {
    volume.size[axis] =
        axis < dimensions ? bytes.at<std::int16_t>(42 + 2 * static_cast<std::size_t>(axis)) : 1;
  }
  // The sform, from RAS to LPS.
  for (int row = 0; row < 3; ++row) {
    const double sign = row < 2 ? -1.0 : 1.0;
    const std::size_t begin = 280 + 16 * static_cast<std::size_t>(row);
    for (int axis = 0; axis < 3; ++axis) {
      const auto part = bytes.at<float>(begin + 4 * static_cast<std::size_t>(axis));
      volume.step[axis][row] = sign * static_cast<double>(part);
    }
    volume.origin[row] = sign * static_cast<double>(bytes.at<float>(begin + 12));
  }
  const auto voxels = static_cast<std::size_t>(volume.size.x * volume.size.y * volume.size.z);
  const std::int16_t count = dimensions > 3 ? bytes.at<std::int16_t>(48) : std::int16_t{1};
  const std::int16_t type = bytes.at<std::int16_t>(70);
  std::vector<PeerVolume> volumes;
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    volumes.push_back(volume);
    std::vector<float>& values = volumes.back().values;
    values.resize(voxels);
    if (type == 2)
      read_values<std::uint8_t>(bytes, n * voxels, values);
    else if (type == 4)
      read_values<std::int16_t>(bytes, n * voxels, values);
    else if (type == 512)
      read_values<std::uint16_t>(bytes, n * voxels, values);
    else if (type == 8)
      read_values<std::int32_t>(bytes, n * voxels, values);
    else if (type == 16)
      read_values<float>(bytes, n * voxels, values);
    else
      values.clear();
  }
  return volumes;
}

}  // namespace

std::string peer_version() {
  QProcess process;
  process.start(kProgram, {"--version"});
  if (!process.waitForFinished(kLongestRun)) return {};
  return process.readAllStandardOutput().trimmed().split('\n').back().toStdString();
}

std::vector<PeerVolume> convert_folder(const fs::path& folder) {
  const QTemporaryDir target;
  QProcess process;
  process.start(kProgram, {"-z", "n", "-b", "n", "-d", "0", "-f", "%s_%p", "-o", target.path(),
                           QString::fromStdString(folder.string())});
  process.waitForFinished(kLongestRun);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(target.path().toStdString())) {
    if (entry.path().extension() == ".nii") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<PeerVolume> volumes;
  for (const fs::path& file : files) {
    for (PeerVolume& volume : volumes_of(NiftiBytes(file))) volumes.push_back(std::move(volume));
  }
  return volumes;
}

Agreement compare(const Volume& ours, const PeerVolume& peer) {
  const Geometry& grid = ours.geometry;
  if (glm::determinant(peer.step) == 0.0) return Agreement::other_grid;
  const glm::dmat3 back = glm::inverse(peer.step);
  // From our voxels to the peer's: whole steps, and the corners on voxels. Positions are single precision
  // there.
  const glm::dvec3 first = back * (grid.origin_mm - peer.origin);
  std::array<glm::dvec3, 3> steps;
  for (int axis = 0; axis < 3; ++axis) steps[axis] = back * (grid.direction[axis] * grid.spacing_mm[axis]);
  const auto to_peer = [&](Index3 v) {
    return first + steps[0] * static_cast<double>(v.x) + steps[1] * static_cast<double>(v.y) +
           steps[2] * static_cast<double>(v.z);
  };
  constexpr double kTolerance = 0.05;  // of a voxel
  const Index3 last = grid.size - Index3(1);
  for (const Index3 corner : {Index3(0), {last.x, 0, 0}, {0, last.y, 0}, {0, 0, last.z}, last}) {
    const glm::dvec3 place = to_peer(corner);
    const glm::dvec3 off = glm::abs(place - glm::round(place));
    const Index3 voxel(glm::round(place));
    const bool within = voxel.x >= 0 && voxel.y >= 0 && voxel.z >= 0 && voxel.x < peer.size.x &&
                        voxel.y < peer.size.y && voxel.z < peer.size.z;
    if (std::max({off.x, off.y, off.z}) > kTolerance || !within) return Agreement::other_grid;
  }
  if (grid.voxel_count() != peer.size.x * peer.size.y * peer.size.z) return Agreement::other_grid;
  if (peer.values.empty()) return Agreement::other_values;
  const auto offset = [&](Index3 v) { return v.x + peer.size.x * (v.y + peer.size.y * v.z); };
  const std::int64_t begin = offset(Index3(glm::round(first)));
  const std::int64_t step = offset(Index3(glm::round(steps[0])));
  for (std::int64_t k = 0; k < grid.size.z; ++k) {
    for (std::int64_t j = 0; j < grid.size.y; ++j) {
      const Index3 across(glm::round(steps[1] * static_cast<double>(j) + steps[2] * static_cast<double>(k)));
      const std::int64_t row = begin + offset(across);
      for (std::int64_t i = 0; i < grid.size.x; ++i) {
        const float theirs = peer.values[static_cast<std::size_t>(row + step * i)];
        const float value = ours.value({i, j, k});
        if (std::abs(theirs - value) > 1e-4F * std::max(1.0F, std::abs(value))) {
          return Agreement::other_values;
        }
      }
    }
  }
  return Agreement::same;
}

}  // namespace tidemark::test
