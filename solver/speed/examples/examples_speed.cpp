#include "solver/speed/examples/examples_speed.h"

#include <algorithm>

#include "core/thread_pool.h"
#include "solver/speed/speed_kinds.h"

namespace tidemark::solver {
namespace {

// Of each class. A stroke's voxels are much alike: more of them cost time and teach little.
constexpr std::size_t kMostSamples = 2000;
// What is evaluated at a time fits into the nearest caches.
constexpr std::int64_t kTileVoxels = 512;

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

  const Index3 size = features.geometry().size;
  ThreadPool threads;
  threads.for_each(count, 64, [&](std::int64_t begin, std::int64_t end, int) {
    std::vector<float> run;
    for (std::int64_t first = begin; first < end && !progress.cancelled();) {
      const std::int64_t offset = voxels[static_cast<std::size_t>(first)];
      const Index3 voxel(offset % size.x, offset / size.x % size.y, offset / (size.x * size.y));
      std::int64_t length = 1;
      while (first + length < end && voxel.x + length < size.x &&
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
  options.nearness = values.at("nearness");
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
  const Nearness nearness(strokes, volumes.front()->geometry);
  auto features = Features::of(std::move(volumes), progress);
  if (!features) return pass_on(features);
  auto samples = samples_of(*features, strokes, progress);
  if (!samples) return pass_on(samples);
  auto forest = solver::train(*samples, options.training, progress);
  if (!forest) return pass_on(forest);
  return std::make_shared<ExamplesSpeed>(std::move(*features), std::move(*forest), nearness, options);
}

void ExamplesSpeed::evaluate(const VoxelBox& box, double* speed) const {
  VoxelBox tile;
  tile.size.z = std::min<std::int64_t>(box.size.z, 8);
  tile.size.y = std::min<std::int64_t>(box.size.y, tile.size.z == 8 ? 8 : 16);
  tile.size.x = std::max<std::int64_t>(1, kTileVoxels / (tile.size.y * tile.size.z));
  ForestEvaluator forest(forest_);
  std::vector<float> features;
  std::vector<double> speeds;
  std::vector<float> nearness;
  Index3 at;
  for (at.z = 0; at.z < box.size.z; at.z += tile.size.z) {
    for (at.y = 0; at.y < box.size.y; at.y += tile.size.y) {
      for (at.x = 0; at.x < box.size.x; at.x += tile.size.x) {
        const VoxelBox part{box.first + at, glm::min(tile.size, box.size - at)};
        features.resize(static_cast<std::size_t>(part.voxels() * features_.count()));
        speeds.resize(static_cast<std::size_t>(part.voxels()));
        features_.evaluate(part, features.data());
        forest.evaluate(features.data(), features_.count(), part.voxels(), speeds.data());
        nearness.resize(speeds.size());
        nearness_.evaluate(part, nearness.data());
        for (std::size_t i = 0; i < speeds.size(); ++i) {
          const double sum = options_.sharpness * speeds[i] + options_.nearness * nearness[i];
          speeds[i] = std::clamp(sum, -1.0, 1.0);
        }
        const double* from = speeds.data();
        for (std::int64_t z = 0; z < part.size.z; ++z) {
          for (std::int64_t y = 0; y < part.size.y; ++y, from += part.size.x) {
            std::copy_n(from, part.size.x, speed + at.x + box.size.x * (at.y + y + box.size.y * (at.z + z)));
          }
        }
      }
    }
  }
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
                      .text = "How fast the surface moves where the trees are not of one mind.",
                      .unit = "",
                      .low = 0.5,
                      .high = 10,
                      .initial = ExamplesOptions{}.sharpness},
                     {.name = "nearness",
                      .title = "Nearness",
                      .text = "How much it counts which strokes are nearer, those inside or those outside.",
                      .unit = "",
                      .low = 0,
                      .high = 5,
                      .initial = ExamplesOptions{}.nearness}},
      .make = make_examples};
  return kind;
}

}  // namespace tidemark::solver
