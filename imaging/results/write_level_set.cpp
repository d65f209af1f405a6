#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <new>

#include "core/atomic_file.h"
#include "imaging/results/results.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

openvdb::Coord coord(Index3 v) {
  return {static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z)};
}

// Voxels to patient mm. OpenVDB multiplies row vectors from the left.
openvdb::math::Transform::Ptr transform_of(const Geometry& geometry) {
  openvdb::Mat4R matrix = openvdb::Mat4R::identity();
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 step = geometry.direction[axis] * geometry.spacing_mm[axis];
    for (int c = 0; c < 3; ++c) matrix(axis, c) = step[c];
    matrix(3, axis) = geometry.origin_mm[axis];
  }
  return openvdb::math::Transform::createLinearTransform(matrix);
}

openvdb::FloatGrid::Ptr grid_of(const Volume& phi, double band) {
  const Geometry& geometry = phi.geometry;
  const glm::dvec3 h = geometry.spacing_mm;
  const double smallest = std::min({h.x, h.y, h.z});
  const auto background = static_cast<float>(band * smallest);
  const auto grid = openvdb::FloatGrid::create(background);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("phi");
  grid->setCreator("Tidemark " TIDEMARK_VERSION);
  grid->setTransform(transform_of(geometry));
  grid->insertMeta("units", openvdb::StringMetadata("mm"));
  grid->insertMeta("coordinates", openvdb::StringMetadata("patient LPS"));

  auto accessor = grid->getAccessor();
  const auto& values = std::get<std::vector<float>>(phi.voxels);
  const Index3 last = geometry.size - Index3(1);
  for (std::int64_t k = 0; k < geometry.size.z; ++k) {
    for (std::int64_t j = 0; j < geometry.size.y; ++j) {
      for (std::int64_t i = 0; i < geometry.size.x; ++i) {
        const Index3 v(i, j, k);
        const double value = values[static_cast<std::size_t>(geometry.offset(v))];
        if (value <= -band) continue;
        const auto distance = static_cast<float>(-std::min(value, band) * smallest);
        const bool border =
            value > 0.0 && (glm::any(glm::equal(v, Index3(0))) || glm::any(glm::equal(v, last)));
        if (value < band || border) {
          accessor.setValue(coord(v), distance);
        } else {
          accessor.setValueOff(coord(v), -background);
        }
        for (int axis = 0; border && axis < 3; ++axis) {
          for (const std::int64_t beyond : {std::int64_t{-1}, geometry.size[axis]}) {
            if (std::abs(v[axis] - beyond) != 1) continue;
            Index3 outside = v;
            outside[axis] = beyond;
            accessor.setValue(coord(outside), -distance);
          }
        }
      }
    }
  }
  openvdb::tools::pruneLevelSet(grid->tree());
  return grid;
}

tl::unexpected<Error> cannot_write(const fs::path& file, ErrorKind kind, std::string_view why) {
  return fail(kind, "{}: cannot write: {}", file.string(), why);
}

// OpenVDB's own file does not say that it could not be written to its end, and reading half of one takes
// OpenVDB any time and memory. So the stream is ours.
class CheckedArchive : public openvdb::io::Archive {
 public:
  // Whether the file is whole.
  [[nodiscard]] bool write_file(const fs::path& file, const openvdb::FloatGrid::Ptr& grid) const {
    std::ofstream stream(file, std::ios::binary);
    constexpr bool kSeekable = true;
    write(stream, openvdb::GridCPtrVec{grid}, kSeekable);
    stream.close();
    return stream.good();
  }
};

Status write(const Volume& phi, double band, const fs::path& file) {
  const auto* values = std::get_if<std::vector<float>>(&phi.voxels);
  if (values == nullptr || static_cast<std::int64_t>(values->size()) != phi.geometry.voxel_count()) {
    return cannot_write(file, ErrorKind::internal, "phi must be a float volume with a value for every voxel");
  }
  TIDEMARK_TRY(require_finite(phi, file.string()));
  for (int axis = 0; axis < 3; ++axis) {
    if (phi.geometry.size[axis] > std::numeric_limits<int>::max() - 2) {
      return cannot_write(file, ErrorKind::capability,
                          fmt::format("{} voxels along an axis are too many", phi.geometry.size[axis]));
    }
  }
  openvdb::initialize();
  const auto grid = grid_of(phi, band);
  auto target = AtomicFile::create(file);
  if (!target) return pass_on(target);
  CheckedArchive archive;
  // Every reader knows zip; not every one was built with Blosc.
  archive.setCompression(openvdb::io::COMPRESS_ZIP | openvdb::io::COMPRESS_ACTIVE_MASK);
  if (!archive.write_file(target->temporary_path(), grid)) {
    return cannot_write(file, ErrorKind::write, "the file is not whole (is the disk full?)");
  }
  return target->commit();
}

}  // namespace

Status write_level_set(const Volume& phi, double band, const fs::path& file) {
  try {
    return write(phi, band, file);
  } catch (const std::bad_alloc&) {
    return cannot_write(file, ErrorKind::capability, "there is not enough memory");
  } catch (const std::exception& error) {
    return cannot_write(file, ErrorKind::write, error.what());
  }
}

}  // namespace tidemark::imaging
