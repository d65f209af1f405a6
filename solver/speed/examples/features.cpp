#include "solver/speed/examples/features.h"

#include <algorithm>
#include <numeric>

namespace tidemark::solver {
namespace {

std::int64_t count_of(const VoxelLattice& lattice) {
  return std::ssize(lattice[0]) * std::ssize(lattice[1]) * std::ssize(lattice[2]);
}

// Where voxels lie between nodes, along one axis.
struct BetweenNodes {
  std::vector<std::int64_t> node;  // the one before, counted from the block's first
  std::vector<float> weight;       // of the one after
};

BetweenNodes between_nodes(const std::vector<std::int64_t>& voxels, std::int64_t step,
                           std::int64_t first_node) {
  BetweenNodes result;
  for (const std::int64_t i : voxels) {
    result.node.push_back(i / step - first_node);
    result.weight.push_back(static_cast<float>(i % step) / static_cast<float>(step));
  }
  return result;
}

// A voxel on a node is that node: the next one may be in the reach, or no number.
inline float between(float here, float next, float weight) {
  return weight == 0.0F ? here : here + weight * (next - here);
}

// Trilinear, for one feature: nodes' values to those of the box's voxels.
void interpolate(const float* nodes, Index3 size, const std::array<BetweenNodes, 3>& at,
                 std::vector<float>& row, float* voxels) {
  row.resize(static_cast<std::size_t>(size.x));
  for (std::size_t z = 0; z < at[2].node.size(); ++z) {
    for (std::size_t y = 0; y < at[1].node.size(); ++y) {
      const float* a = nodes + size.x * (at[1].node[y] + size.y * at[2].node[z]);
      const float* b = a + size.x;
      const float* c = a + size.x * size.y;
      const float* d = c + size.x;
      const float wy = at[1].weight[y];
      const float wz = at[2].weight[z];
      for (std::int64_t x = 0; x < size.x; ++x) {
        row[static_cast<std::size_t>(x)] = between(between(a[x], b[x], wy), between(c[x], d[x], wy), wz);
      }
      for (std::size_t x = 0; x < at[0].node.size(); ++x) {
        const float* pair = row.data() + at[0].node[x];
        *voxels++ = between(pair[0], pair[1], at[0].weight[x]);
      }
    }
  }
}

// The features of one scale.
void evaluate_scale(const Volume& volume, const ScaleSpace& space, int scale, const VoxelLattice& lattice,
                    float* features) {
  const Index3 step = space.step(scale);
  VoxelBox nodes;
  std::array<BetweenNodes, 3> at;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<std::int64_t>& voxels = lattice[static_cast<std::size_t>(axis)];
    const std::int64_t first = voxels.front() / step[axis];
    // A voxel on a node is that node: where there are no others, one node more is not read.
    const std::int64_t last = (voxels.back() - 1 + step[axis]) / step[axis];
    nodes.first[axis] = first;
    nodes.size[axis] = last - first + 1;
    at[static_cast<std::size_t>(axis)] = between_nodes(voxels, step[axis], first - kFeatureReach);
  }
  const Moments moments = space.moments(volume, scale, grown(nodes, Index3(kFeatureReach)));
  std::vector<float> of_nodes;
  node_features(moments, space.step_mm(scale), of_nodes);
  std::vector<float> row;
  for (int feature = 0; feature < kNodeFeatures; ++feature) {
    interpolate(of_nodes.data() + feature * moments.box.voxels(), moments.box.size, at, row,
                features + feature * count_of(lattice));
  }
}

}  // namespace

Result<Features> Features::of(std::vector<std::shared_ptr<const Volume>> volumes, const Progress& progress) {
  Features features;
  const Index3 size = volumes.front()->geometry.size;
  for (const auto& volume : volumes) {
    const Index3 other = volume->geometry.size;
    if (other != size) {
      return fail(ErrorKind::usage, "examples: an image has {} x {} x {} voxels, the volume {} x {} x {}",
                  other.x, other.y, other.z, size.x, size.y, size.z);
    }
    auto space = ScaleSpace::of(volume, progress);
    if (!space) return pass_on(space);
    features.spaces_.push_back(std::move(*space));
  }
  features.volumes_ = std::move(volumes);
  return features;
}

int Features::count() const {
  int count = 3;
  for (const auto& space : spaces_) count += space->scales() * kNodeFeatures;
  return count;
}

void Features::evaluate(const VoxelBox& box, float* features) const {
  VoxelLattice lattice;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::int64_t>& along = lattice[static_cast<std::size_t>(axis)];
    along.resize(static_cast<std::size_t>(box.size[axis]));
    std::iota(along.begin(), along.end(), box.first[axis]);
  }
  evaluate(lattice, features);
}

void Features::evaluate(const VoxelLattice& lattice, float* features) const {
  const std::int64_t voxels = count_of(lattice);
  for (std::size_t image = 0; image < volumes_.size(); ++image) {
    for (int scale = 0; scale < spaces_[image]->scales(); ++scale) {
      evaluate_scale(*volumes_[image], *spaces_[image], scale, lattice, features);
      features += kNodeFeatures * voxels;
    }
  }
  const glm::vec3 spacing(geometry().spacing_mm);
  for (const std::int64_t z : lattice[2]) {
    for (const std::int64_t y : lattice[1]) {
      for (const std::int64_t x : lattice[0]) {
        const glm::vec3 position = glm::vec3(x, y, z) * spacing;
        for (int axis = 0; axis < 3; ++axis) features[axis * voxels] = position[axis];
        ++features;
      }
    }
  }
}

std::int64_t Features::memory() const {
  std::int64_t bytes = 0;
  for (const auto& space : spaces_) bytes += space->memory();
  return bytes;
}

}  // namespace tidemark::solver
