#include "solver/speed/examples/examples_speed.h"

#include <algorithm>

#include "core/thread_pool.h"
#include "solver/speed/doubt_map.h"
#include "solver/speed/speed_kinds.h"

namespace tidemark::solver {
namespace {

// Of each class. A stroke's voxels are much alike: more of them cost time and teach little.
constexpr std::size_t kMostSamples = 2000;
// What is evaluated at a time, along each axis: it fits into the second cache, and few nodes around it are
// computed twice.
constexpr std::int64_t kTileSide = 16;
constexpr std::int64_t kTileReach = 32;  // voxels from the first cell's to the last one's

// Evenly, so that every stroke keeps its share.
void take_samples(const std::vector<std::int64_t>& stroke, std::vector<std::int64_t>& voxels) {
  const std::size_t count = std::min(stroke.size(), kMostSamples);
  for (std::size_t i = 0; i < count; ++i) voxels.push_back(stroke[i * stroke.size() / count]);
}

// Their features, by voxels that follow each other along x.
Result<Samples> samples_of(const Features& features, const Strokes& strokes, const Progress& progress) {
  std::vector<std::int64_t> voxels;
  take_samples(strokes.inside, voxels);
  const auto inside = static_cast<std::int64_t>(voxels.size());
  take_samples(strokes.outside, voxels);
  const auto count = static_cast<std::int64_t>(voxels.size());
  Samples samples{features.count(), {}, {}};
  samples.inside.assign(static_cast<std::size_t>(count), 0);
  std::fill_n(samples.inside.begin(), inside, std::uint8_t{1});
  samples.values.resize(static_cast<std::size_t>(count * features.count()));

  ThreadPool threads;
  threads.for_each(count, 64, [&](std::int64_t begin, std::int64_t end, int) {
    std::vector<float> run;
    for (std::int64_t first = begin; first < end && !progress.cancelled();) {
      const std::int64_t offset = voxels[static_cast<std::size_t>(first)];
      const Index3 voxel = features.geometry().voxel_at(offset);
      std::int64_t length = 1;
      while (first + length < end && voxel.x + length < features.geometry().size.x &&
             voxels[static_cast<std::size_t>(first + length)] == offset + length) {
        ++length;
      }
      run.resize(static_cast<std::size_t>(length * features.count()));
      features.evaluate({voxel, Index3(length, 1, 1)}, run.data());
      for (int f = 0; f < features.count(); ++f) {
        std::copy_n(run.data() + f * length, length, samples.values.data() + f * count + first);
      }
      first += length;
    }
  });
  if (progress.cancelled()) return cancelled_error();
  return samples;
}

// The values of a box that lies within another, x fastest.
template <class Value>
void copy_box(const double* values, const VoxelBox& box, const VoxelBox& into, Value* to) {
  const Index3 at = box.first - into.first;
  for (std::int64_t z = 0; z < box.size.z; ++z) {
    for (std::int64_t y = 0; y < box.size.y; ++y, values += box.size.x) {
      std::copy_n(values, box.size.x, to + number_in(into.size, at + Index3(0, y, z)));
    }
  }
}

template <class Visit>
void for_tiles(const VoxelBox& box, Index3 most, Visit visit) {
  VoxelBox tile;
  tile.size.z = std::min(box.size.z, most.z);
  tile.size.y = std::min(box.size.y, most.y);
  tile.size.x = std::max<std::int64_t>(1, most.x * most.y * most.z / (tile.size.y * tile.size.z));
  Index3 at;
  for (at.z = 0; at.z < box.size.z; at.z += tile.size.z) {
    for (at.y = 0; at.y < box.size.y; at.y += tile.size.y) {
      for (at.x = 0; at.x < box.size.x; at.x += tile.size.x) {
        visit(VoxelBox{box.first + at, glm::min(tile.size, box.size - at)});
      }
    }
  }
}

// The middle voxels of cells of `step` voxels that divide a box from its first voxel on.
VoxelLattice middles(Index3 cells, Index3 step, const VoxelBox& box) {
  VoxelLattice lattice;
  for (int axis = 0; axis < 3; ++axis) {
    for (std::int64_t cell = 0; cell < cells[axis]; ++cell) {
      const std::int64_t middle = std::min(cell * step[axis] + step[axis] / 2, box.size[axis] - 1);
      lattice[static_cast<std::size_t>(axis)].push_back(box.first[axis] + middle);
    }
  }
  return lattice;
}

// The forest's probabilities of cells, each by the voxel in its middle.
void write_prior(const Features& features, const Forest& forest, const WalkerGrid& grid, std::int64_t first,
                 std::int64_t last, float* inside) {
  ForestEvaluator evaluator(forest);
  std::vector<float> values;
  std::vector<double> probabilities;
  const VoxelBox all{Index3(0, 0, first), Index3(grid.size.x, grid.size.y, last - first)};
  const Index3 most = glm::clamp(Index3(kTileReach) / grid.step, Index3(4), Index3(kTileSide));
  for_tiles(all, most, [&](const VoxelBox& cells) {
    const VoxelBox voxels =
        common({grid.box.first + cells.first * grid.step, cells.size * grid.step}, grid.box);
    values.resize(static_cast<std::size_t>(cells.voxels() * features.count()));
    features.evaluate(middles(cells.size, grid.step, voxels), values.data());
    probabilities.resize(static_cast<std::size_t>(cells.voxels()));
    evaluator.evaluate(values.data(), features.count(), cells.voxels(), probabilities.data());
    copy_box(probabilities.data(), cells, all, inside);
  });
}

Status check(const std::vector<std::int64_t>& stroke, const char* kind, const Geometry& geometry) {
  if (stroke.empty()) {
    return fail(ErrorKind::usage, "examples: paint at least one stroke {} of what is to be found", kind);
  }
  const auto [low, high] = std::minmax_element(stroke.begin(), stroke.end());
  if (*low < 0 || *high >= geometry.voxel_count()) {
    return fail(ErrorKind::usage, "examples: the strokes {} have voxels that the volume has not", kind);
  }
  return {};
}

Result<std::shared_ptr<const SpeedFunction>> make_examples(const SpeedInputs& inputs,
                                                           const std::map<std::string, double>& values,
                                                           const Progress& progress) {
  std::vector<std::shared_ptr<const Volume>> volumes{inputs.source};
  volumes.insert(volumes.end(), inputs.images.begin(), inputs.images.end());
  ExamplesOptions options;
  options.sharpness = values.at("sharpness");
  options.walker.contrast = values.at("edges");
  options.training.trees = static_cast<int>(values.at("trees"));
  auto made = ExamplesSpeed::train(std::move(volumes), inputs.strokes ? *inputs.strokes : Strokes{}, options,
                                   progress);
  if (!made) return pass_on(made);
  return std::move(*made);
}

}  // namespace

Result<std::shared_ptr<const ExamplesSpeed>> ExamplesSpeed::train(
    std::vector<std::shared_ptr<const Volume>> volumes, const Strokes& strokes,
    const ExamplesOptions& options, const Progress& progress) {
  TIDEMARK_TRY(check(strokes.inside, "inside", volumes.front()->geometry));
  TIDEMARK_TRY(check(strokes.outside, "outside", volumes.front()->geometry));
  auto features = Features::of(volumes, progress);
  if (!features) return pass_on(features);
  auto samples = samples_of(*features, strokes, progress);
  if (!samples) return pass_on(samples);
  auto forest = solver::train(*samples, options.training, progress);
  if (!forest) return pass_on(forest);
  auto walker = RandomWalker::solve(
      volumes, strokes, options.walker,
      [&](const WalkerGrid& grid, std::int64_t first, std::int64_t last, float* inside) {
        if (!progress.cancelled()) write_prior(*features, *forest, grid, first, last, inside);
      },
      progress);
  if (!walker) return pass_on(walker);
  return std::make_shared<ExamplesSpeed>(std::move(*features), std::move(*forest), std::move(*walker),
                                         options);
}

void ExamplesSpeed::evaluate(const VoxelBox& box, double* speed) const {
  probabilities(box, speed);
  std::transform(speed, speed + box.voxels(), speed, [this](double inside) {
    return std::clamp(options_.sharpness * (2.0 * inside - 1.0), -1.0, 1.0);
  });
}

void ExamplesSpeed::evaluate_doubt(const VoxelBox& box, double* doubt) const {
  probabilities(box, doubt);
  std::transform(doubt, doubt + box.voxels(), doubt, entropy);
}

void ExamplesSpeed::probabilities(const VoxelBox& box, double* inside) const {
  const VoxelBox& known = walker_.grid().box;
  for_tiles(box, Index3(kTileSide),
            [&, forest = ForestEvaluator(forest_), features = std::vector<float>(),
             of_tile = std::vector<double>(), walked = std::vector<double>()](const VoxelBox& tile) mutable {
              of_tile.resize(static_cast<std::size_t>(tile.voxels()));
              const VoxelBox shared = common(tile, known);
              if (shared.size != tile.size) {
                features.resize(static_cast<std::size_t>(tile.voxels() * features_.count()));
                features_.evaluate(tile, features.data());
                forest.evaluate(features.data(), features_.count(), tile.voxels(), of_tile.data());
              }
              if (shared.voxels() > 0) {
                walked.resize(static_cast<std::size_t>(shared.voxels()));
                walker_.evaluate(shared, walked.data());
                copy_box(walked.data(), shared, tile, of_tile.data());
              }
              copy_box(of_tile.data(), tile, box, inside);
            });
}

const SpeedKind& examples_kind() {
  static const SpeedKind kind{
      .name = "examples",
      .title = "Examples",
      .text =
          "Learns from strokes inside and outside what belongs to the object: its brightness, texture, edges "
          "and place, in all images.",
      .needs_strokes = true,
      .uses_images = true,
      .parameters = {{.name = "trees",
                      .title = "Trees",
                      .text = "How many decision trees vote: more are smoother and take longer.",
                      .unit = "",
                      .low = 10,
                      .high = 500,
                      .initial = 100},
                     {.name = "sharpness",
                      .title = "Sharpness",
                      .text = "How fast the surface moves where it is in doubt.",
                      .unit = "",
                      .low = 0.5,
                      .high = 10,
                      .initial = ExamplesOptions{}.sharpness},
                     {.name = "edges",
                      .title = "Edges",
                      .text = "How much an edge keeps a stroke from saying what lies behind it.",
                      .unit = "",
                      .low = 0,
                      .high = 200,
                      .initial = WalkerOptions{}.contrast}},
      .make = make_examples};
  return kind;
}

}  // namespace tidemark::solver
