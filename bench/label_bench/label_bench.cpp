// How long the tools that finish labels take and how much memory, a dab of their brush, a session file of the
// labels, and filled slices.
//
// `label_bench` has 20 labels on 512 x 512 x 600 voxels; each tool works on the largest one and on all.
// Memory is the peak beside the labels, in bytes a voxel. `label_bench FILE [LABEL]` takes every fourth slice
// of a label, along each axis, and prints Dice of what is filled.
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "bench/peak_memory.h"
#include "document/label_tool.h"
#include "document/region_statistics.h"
#include "document/session_file.h"
#include "imaging/load_study.h"
#include "imaging/regions/fill_slices.h"
#include "renderer/label_volume.h"

using namespace tidemark;

namespace {

class Watch {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// A large ball and 19 others beside each other, each with bubbles inside and crumbs around.
document::LabelVoxels labelled_volume() {
  document::LabelVoxels volume;
  volume.geometry.size = {512, 512, 600};
  volume.geometry.spacing_mm = {0.7, 0.7, 1.0};
  const Index3 size = volume.geometry.size;
  std::vector<std::uint8_t> voxels(static_cast<std::size_t>(volume.geometry.voxel_count()));
  std::mt19937 random(1);
  for (int label = 1; label <= 20; ++label) {
    document::Label named;
    named.id = static_cast<std::uint8_t>(label);
    named.name = fmt::format("Label {}", label);
    volume.list.push_back(named);
    const int n = label - 2;
    const glm::dvec3 centre = label == 1 ? glm::dvec3(180.0, 180.0, 200.0)
                                         : glm::dvec3(40.0 + 70.0 * (n % 5), 40.0 + 70.0 * (n / 5), 480.0);
    const double radius = label == 1 ? 150.0 : 30.0;
    // Crumbs around it.
    for (int crumb = 0; crumb < 10'000; ++crumb) {
      glm::dvec3 place(random() % 1000, random() % 1000, random() % 1000);
      place = (centre + radius * (place / 500.0 - 1.0) * 1.1) / volume.geometry.spacing_mm;
      if (volume.geometry.contains(Index3(place)))
        voxels[static_cast<std::size_t>(volume.geometry.offset(Index3(place)))] = named.id;
    }
    for (auto k = static_cast<std::int64_t>(centre.z - radius);
         k <= static_cast<std::int64_t>(centre.z + radius); ++k) {
      for (std::int64_t j = 0; j < size.y; ++j) {
        for (std::int64_t i = 0; i < size.x; ++i) {
          const glm::dvec3 off = glm::dvec3(i, j, k) * volume.geometry.spacing_mm - centre;
          if (off.x * off.x + off.y * off.y + off.z * off.z > radius * radius) continue;
          // One voxel in a hundred is missing: bubbles everywhere.
          if (random() % 100 == 0) continue;
          voxels[static_cast<std::size_t>(volume.geometry.offset({i, j, k}))] = named.id;
        }
      }
    }
  }
  volume.voxels = std::make_shared<const PagedBytes>(size, voxels);
  return volume;
}

void time_tools(const document::LabelVoxels& volume) {
  std::vector<std::uint8_t> all;
  for (const document::Label& label : volume.list) all.push_back(label.id);
  document::Labels labels(volume.geometry);
  if (!labels.assign(volume.list, *volume.voxels)) std::exit(1);
  fmt::print("{:<28} {:>9} {:>9} {:>9} {:>13}\n", "seconds", "largest", "all 20", "applied", "bytes a voxel");
  using document::LabelTool;
  for (const auto& [name, tool, amount] : {std::tuple("largest island", LabelTool::largest_island, 0.0),
                                           {"small islands", LabelTool::small_islands, 1.0},
                                           {"holes", LabelTool::holes, 0.0},
                                           {"holes in slices", LabelTool::slice_holes, 0.0},
                                           {"grow by 5 mm", LabelTool::grow, 5.0},
                                           {"shrink by 5 mm", LabelTool::shrink, 5.0},
                                           {"median of 2 mm", LabelTool::median, 2.0},
                                           {"Gaussian of 2 mm", LabelTool::gaussian, 2.0}}) {
    document::LabelToolUse use;
    use.tool = tool;
    use.amount = amount;
    const Watch one;
    const auto largest = document::use_tool(use, {1}, volume);
    const double seconds_of_one = one.seconds();
    const bench::PeakMemory memory;
    const Watch every;
    const auto regions = document::use_tool(use, all, volume);
    const double seconds_of_all = every.seconds();
    const auto bytes = static_cast<double>(memory.bytes());
    if (!largest || !regions) std::exit(1);
    const Watch applying;
    if (!labels.finish(*largest)) std::exit(1);
    fmt::print("{:<28} {:>9.2f} {:>9.2f} {:>9.2f} {:>13.2f}\n", name, seconds_of_one, seconds_of_all,
               applying.seconds(), bytes / static_cast<double>(volume.geometry.voxel_count()));
    if (!labels.assign(volume.list, *volume.voxels)) std::exit(1);
  }
}

// Dabs of 10 mm at the border of the large ball: what the engine does of them, and the renderer for 3D.
void time_dabs(const document::LabelVoxels& from) {
  document::Labels labels(from.geometry);
  if (!labels.assign(from.list, *from.voxels)) std::exit(1);
  Volume source;
  source.geometry = from.geometry;
  source.voxels = std::vector<std::int16_t>(static_cast<std::size_t>(from.geometry.voxel_count()));
  const auto volume = std::make_shared<const Volume>(std::move(source));
  document::LabelStatistics statistics;
  renderer::LabelVolume shown(PageLayout(from.geometry.size, kDefaultPageShape));
  const auto show = [&] {
    shown.set_voxels(labels.voxels());
    shown.prepare_borders();
  };
  const Watch first_figures;
  statistics.measure(volume, labels.voxels());
  const double first_seconds = first_figures.seconds();
  const Watch first_look;
  show();
  fmt::print("\nfirst figures {:.2f} s, first look {:.2f} s\n", first_seconds, first_look.seconds());
  fmt::print("{:<28} {:>9} {:>9} {:>9} {:>9}\n", "ms a dab", "brush", "publish", "figures", "look");
  std::mt19937 random(2);
  for (int n = 0; n < 10; ++n) {
    const double angle = random() % 628 * 0.01;
    const glm::dvec3 place =
        glm::dvec3(180.0 + 150.0 * std::cos(angle), 180.0 + 150.0 * std::sin(angle), 200.0) /
        from.geometry.spacing_mm;
    const Index3 reach(glm::ceil(10.0 / from.geometry.spacing_mm));
    Region dab(VoxelRange{Index3(place) - reach, Index3(place) + reach + Index3(1)}.widened(
        Index3(0), from.geometry.size));
    for (std::int64_t k = 0; k < dab.size().z; ++k) {
      for (std::int64_t j = 0; j < dab.size().y; ++j) {
        for (std::int64_t i = 0; i < dab.size().x; ++i) {
          const Index3 voxel = dab.first() + Index3(i, j, k);
          if (from.geometry.contains(voxel) &&
              glm::length((glm::dvec3(voxel) - place) * from.geometry.spacing_mm) <= 10.0)
            dab.add(voxel);
        }
      }
    }
    const auto ms = [](const Watch& watch) { return 1000.0 * watch.seconds(); };
    const Watch brushing;
    if (!labels.brush({1, {}, dab}, document::Labels::Stroke::adds)) std::exit(1);
    const double brush = ms(brushing);
    const Watch publishing;
    const auto published = std::make_shared<const PagedBytes>(labels.voxels());
    const double publish = ms(publishing);
    const Watch measuring;
    statistics.measure(volume, *published);
    const double figures = ms(measuring);
    const Watch looking;
    show();
    fmt::print("{:<28} {:>9.2f} {:>9.2f} {:>9.2f} {:>9.2f}\n", n + 1, brush, publish, figures, ms(looking));
  }
}

// A session file of the labels: what is there beside them meanwhile, in bytes a voxel.
void time_session(const document::LabelVoxels& from) {
  document::SessionContents contents;
  contents.origin.phantom = "balls";
  contents.geometry = from.geometry;
  contents.recipe.source.size = from.geometry.size;
  contents.recipe.executor = {.name = "host", .page_shape = kDefaultPageShape};
  contents.phi =
      std::make_shared<const solver::Field>(solver::Field::empty(from.geometry, 3.0, kDefaultPageShape));
  contents.labels = from.list;
  contents.label_voxels = from.voxels;
  const auto file = std::filesystem::temp_directory_path() / "tidemark-label-bench.tidemark";
  const auto timed = [&](const char* name, const auto& work) {
    const bench::PeakMemory memory;
    const Watch watch;
    if (const Status done = work(); !done) {
      fmt::print(stderr, "{}\n", done.error().message);
      std::exit(1);
    }
    fmt::print("{:<28} {:>9.2f} s {:>9.2f} bytes a voxel\n", name, watch.seconds(),
               static_cast<double>(memory.bytes()) / static_cast<double>(from.geometry.voxel_count()));
  };
  fmt::print("\n");
  timed("session file written", [&] { return document::write_session(contents, file); });
  timed("read", [&]() -> Status {
    const auto read = document::load_session(file);
    return read ? Status() : Status(pass_on(read));
  });
  std::filesystem::remove(file);
}

int fill_slices(const char* file, const char* label) {
  const auto volume = imaging::load_volume(file);
  if (!volume) {
    fmt::print(stderr, "{}\n", volume.error().message);
    return 3;
  }
  const Geometry& grid = volume->geometry;
  const auto wanted = static_cast<float>(label != nullptr ? std::atof(label) : 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    Region truth(VoxelRange{Index3(0), grid.size});
    Region drawn = truth;
    for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
      if (volume->value(i) != wanted) continue;
      truth.add(grid.voxel_at(i));
      if (grid.voxel_at(i)[axis] % 4 == 0) drawn.add(grid.voxel_at(i));
    }
    const auto filled = imaging::with_slices_filled(drawn, grid, axis);
    // Beyond the first and the last slice that were drawn nothing is known.
    VoxelRange known{Index3(0), grid.size};
    known.low[axis] = drawn.bounds().low[axis];
    known.high[axis] = drawn.bounds().high[axis];
    if (filled) fmt::print("axis {}: Dice {:.4f}\n", axis, dice(*filled, intersection(truth, whole(known))));
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1) return fill_slices(argv[1], argc > 2 ? argv[2] : nullptr);
  const document::LabelVoxels volume = labelled_volume();
  time_tools(volume);
  time_dabs(volume);
  time_session(volume);
  return 0;
}
