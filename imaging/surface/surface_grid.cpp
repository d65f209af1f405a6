#include "imaging/surface/surface_grid.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <array>
#include <cmath>

namespace tidemark::imaging {
namespace {

// phi continued by one voxel beyond the border: where the border is inside, with the opposite sign, so that
// linear interpolation crosses zero half way, on the face of the border voxel.
class PaddedField {
 public:
  explicit PaddedField(const PhiValues& phi) : geometry_(phi.geometry()), phi_(phi) {}

  [[nodiscard]] float value(Index3 v) const {
    const Index3 inner = glm::clamp(v, Index3(0), geometry_.size - Index3(1));
    const float phi = phi_.at(inner);
    return inner == v ? phi : -std::abs(phi);
  }

  // Whether phi > 0 on the padded row of voxels (-1 .. size.x) at (j, k).
  void signs(std::int64_t j, std::int64_t k, std::vector<std::uint8_t>& row) const {
    row.assign(static_cast<std::size_t>(geometry_.size.x) + 2, 0);
    if (j < 0 || k < 0 || j >= geometry_.size.y || k >= geometry_.size.z) return;
    phi_.signs(j, k, row.data() + 1);
  }

 private:
  const Geometry& geometry_;
  const PhiValues& phi_;
};

void add_cell(openvdb::FloatGrid::Accessor& accessor, const PaddedField& field, Index3 cell) {
  for (int corner = 0; corner < 8; ++corner) {
    const Index3 v = cell + Index3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    accessor.setValue(openvdb::Coord(static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z)),
                      -field.value(v));
  }
}

}  // namespace

openvdb::FloatGrid::Ptr surface_grid(const PhiValues& phi) {
  const Geometry& geometry = phi.geometry();
  const PaddedField field(phi);
  // The background is what lies far outside; its size is of no account, only its sign.
  auto grid = openvdb::FloatGrid::create(1.0F);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  auto accessor = grid->getAccessor();
  std::array<std::vector<std::uint8_t>, 4> rows;
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(geometry.size.x) + 2);
  for (std::int64_t k = -1; k < geometry.size.z; ++k) {
    field.signs(-1, k, rows[0]);
    field.signs(-1, k + 1, rows[1]);
    for (std::int64_t j = -1; j < geometry.size.y; ++j) {
      field.signs(j + 1, k, rows[2]);
      field.signs(j + 1, k + 1, rows[3]);
      for (std::size_t i = 0; i < inside.size(); ++i) {
        inside[i] = static_cast<std::uint8_t>(rows[0][i] + rows[1][i] + rows[2][i] + rows[3][i]);
      }
      for (std::size_t i = 0; i + 1 < inside.size(); ++i) {
        const int corners_inside = inside[i] + inside[i + 1];
        if (corners_inside != 0 && corners_inside != 8) {
          add_cell(accessor, field, {static_cast<std::int64_t>(i) - 1, j, k});
        }
      }
      std::swap(rows[0], rows[2]);
      std::swap(rows[1], rows[3]);
    }
  }
  // Gives voxels away from the surface, stored or not, the sign of their side.
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

}  // namespace tidemark::imaging
