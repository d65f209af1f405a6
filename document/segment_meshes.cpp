#include "document/segment_meshes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <set>

#include "core/atomic_file.h"
#include "solver/distance_transform.h"

namespace tidemark::document {
namespace {

// The part of a mask that holds all of its voxels, with `reach` voxels around them: a small region in a large
// study takes as long as it is large.
Mask part_of(const Mask& mask, Index3 reach) {
  const Index3 size = mask.geometry.size;
  Index3 low = size;
  Index3 high(-1);
  for (std::int64_t z = 0; z < size.z; ++z) {
    for (std::int64_t y = 0; y < size.y; ++y) {
      const std::uint8_t* row = mask.voxels.data() + mask.geometry.offset({0, y, z});
      for (std::int64_t x = 0; x < size.x; ++x) {
        if (row[x] == 0) continue;
        low = glm::min(low, Index3(x, y, z));
        high = glm::max(high, Index3(x, y, z));
      }
    }
  }
  if (high.x < 0) return {mask.geometry, mask.voxels};
  low = glm::max(low - reach, Index3(0));
  high = glm::min(high + reach, size - Index3(1));
  Mask part{mask.geometry, {}};
  part.geometry.size = high - low + Index3(1);
  part.geometry.origin_mm = mask.geometry.to_patient(low);
  part.voxels.reserve(static_cast<std::size_t>(part.geometry.voxel_count()));
  for (std::int64_t z = low.z; z <= high.z; ++z) {
    for (std::int64_t y = low.y; y <= high.y; ++y) {
      const std::uint8_t* row = mask.voxels.data() + mask.geometry.offset({0, y, z});
      part.voxels.insert(part.voxels.end(), row + low.x, row + high.x + 1);
    }
  }
  return part;
}

// Folders, other streams and names that a program may not open elsewhere have no place in it.
std::string file_name_of(const std::string& name) {
  constexpr std::string_view kRefused = "/\\:*?\"<>|";
  std::string safe;
  for (const char c : name) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    safe += control || kRefused.find(c) != std::string_view::npos ? '_' : c;
  }
  return safe.empty() ? "unnamed" : safe;
}

}  // namespace

double surface_band(const Geometry& geometry) {
  const glm::dvec3 h = geometry.spacing_mm;
  return std::max(2.5, 2.0 * std::max({h.x, h.y, h.z}) / std::min({h.x, h.y, h.z}));
}

Result<imaging::Mesh> mesh_of(const solver::Field& phi) {
  constexpr Index3 kShape(imaging::PhiPages::kSide);
  if (phi.layout.page_shape() != kShape) return mesh_of(phi.repaged(phi.band, kShape));
  imaging::PhiPages pages{phi.geometry, {}};
  pages.pages.reserve(static_cast<std::size_t>(phi.layout.page_count()));
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page)
    pages.pages.push_back({phi.pages.values(page), phi.constant(page)});
  return imaging::extract_surface(pages);
}

Result<imaging::Mesh> mesh_of(const Mask& mask) {
  const double band = surface_band(mask.geometry);
  const glm::dvec3 h = mask.geometry.spacing_mm;
  const glm::dvec3 reach = glm::ceil(band * std::min({h.x, h.y, h.z}) / h) + 2.0;
  return mesh_of(solver::distance_transform(part_of(mask, Index3(reach)), band));
}

Result<imaging::Mesh> mesh_of(const Geometry& geometry, const imaging::Segment& segment) {
  if (segment.phi) return imaging::extract_surface(*segment.phi);
  return mesh_of(imaging::union_of({geometry, {segment}, {}}));
}

std::vector<std::filesystem::path> mesh_files(const std::vector<std::string>& segment_names,
                                              const std::filesystem::path& like) {
  std::vector<std::filesystem::path> files;
  std::set<std::string> taken;
  for (const std::string& segment : segment_names) {
    const std::string wanted = like.stem().string() + "-" + file_name_of(segment);
    std::string name = wanted;
    for (int number = 2; !taken.insert(name).second; ++number) name = wanted + " " + std::to_string(number);
    files.push_back(like.parent_path() / (name + like.extension().string()));
  }
  return files;
}

Status write_meshes(const imaging::Segments& segments, const std::filesystem::path& like,
                    const Progress& progress) {
  std::vector<std::string> names;
  for (const imaging::Segment& segment : segments.list) names.push_back(segment.name);
  const std::vector<std::filesystem::path> files = mesh_files(names, like);
  std::vector<AtomicFile> staged;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (progress.cancelled()) return cancelled_error();
    progress(static_cast<double>(i) / static_cast<double>(files.size()), "writing surfaces");
    const auto mesh = mesh_of(segments.geometry, segments.list[i]);
    if (!mesh) return pass_on(mesh);
    auto file = AtomicFile::create(files[i]);
    if (!file) return pass_on(file);
    TIDEMARK_TRY(imaging::write_mesh(*mesh, file->temporary_path()));
    staged.push_back(std::move(*file));
  }
  return AtomicFile::commit_all(staged, progress);
}

}  // namespace tidemark::document
