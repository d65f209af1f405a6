#include "app/cli/start.h"

#include <cmath>
#include <filesystem>

#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "solver/coarse_grid.h"

namespace tidemark::cli {
namespace {

constexpr const char* kStartGroup = "Start (at least one)";

Index3 flood_seed(const std::vector<double>& flood) {
  return {std::llround(flood[0]), std::llround(flood[1]), std::llround(flood[2])};
}

Result<document::FieldStart> read_phi(const std::string& file, const Geometry& grid, double band,
                                      Console& console) {
  const auto volume = imaging::load_volume(file, {}, console.progress());
  if (!volume) return pass_on(volume);
  auto values = imaging::onto_grid(*volume, grid, file);
  if (!values) return pass_on(values);
  return document::FieldStart{
      std::make_shared<const solver::Field>(solver::Field::from_dense(grid, *values, band)),
      std::filesystem::path(file).filename().string()};
}

Result<std::vector<solver::Sphere>> resolve(const std::vector<SphereArgument>& arguments,
                                            const Geometry& grid) {
  std::vector<solver::Sphere> spheres;
  for (const SphereArgument& argument : arguments) {
    const auto sphere = argument.resolve(grid);
    if (!sphere) return pass_on(sphere);
    spheres.push_back(*sphere);
  }
  return spheres;
}

Status check_order(const std::string& option, double low, double high) {
  if (low <= high) return {};
  return fail(ErrorKind::usage, "{}: the lower limit {} is above the upper limit {}", option, low, high);
}

}  // namespace

void add_start_options(CLI::App& app, StartOptions& options) {
  add_spheres(app, "--seed", SphereUnits::voxels, options.seeds,
              "A ball around voxel I,J,K with radius R in mm; may be repeated")
      ->group(kStartGroup);
  add_spheres(app, "--seed-mm", SphereUnits::millimetres, options.seeds,
              "A ball around a point in patient coordinates (LPS), all in mm; may be repeated")
      ->group(kStartGroup);
  app.add_option("--init", options.mask,
                 "A mask on the same grid: every voxel that is not 0;\na DICOM segmentation or RT structure "
                 "set (.dcm): all "
                 "its segments")
      ->type_name("MASK")
      ->group(kStartGroup);
  add_numbers(app, "--init-threshold", "LO,HI", options.threshold,
              "All voxels with values from LO to HI, in the volume's units (after --smooth)")
      ->group(kStartGroup);
  add_numbers(app, "--init-flood", "I,J,K,LO,HI", options.flood,
              "Voxels with values from LO to HI that are connected to voxel I,J,K")
      ->group(kStartGroup);
  app.add_flag("--init-speed", options.speed,
               "All voxels where the speed (--speed) is above 0: the surface would grow there")
      ->group(kStartGroup);
  app.add_option("--init-phi", options.phi, "A level set saved with --out-phi, to go on with")
      ->type_name("FILE")
      ->group(kStartGroup);
  add_spheres(app, "--erase", SphereUnits::voxels, options.erasers,
              "Takes a ball away from the start: voxel I,J,K, radius R in mm; may be repeated")
      ->group(kStartGroup);
  add_spheres(app, "--erase-mm", SphereUnits::millimetres, options.erasers,
              "The same in patient coordinates (LPS, mm)")
      ->group(kStartGroup);
}

void add_levels_option(CLI::App& app, StartOptions& options) {
  std::map<std::string, int> words{{"auto", kLevelsBySize}};
  for (int levels = 1; levels <= solver::CoarseGrid::kMostLevels; ++levels)
    words[std::to_string(levels)] = levels;
  add_choice(app, "--levels", options.levels, words,
             "Coarse to fine: come to rest on a quarter and a half of the resolution first (3), on half\n"
             "(2), on as many levels as suit the volume (auto), or not (1, the default)")
      ->group(kStartGroup);
}

Status check(const StartOptions& options) {
  if (options.phi && options.levels != 1) {
    return fail(ErrorKind::usage, "--levels: --init-phi goes on as it is, on the finest");
  }
  const int inits = int{options.mask.has_value()} + int{options.threshold.has_value()} +
                    int{options.flood.has_value()} + int{options.speed} + int{options.phi.has_value()};
  if (inits > 1) {
    return fail(
        ErrorKind::usage,
        "only one of --init, --init-threshold, --init-flood, --init-speed and --init-phi can be given");
  }
  if (options.threshold) {
    return check_order("--init-threshold", (*options.threshold)[0], (*options.threshold)[1]);
  }
  if (!options.flood) return {};
  const std::vector<double>& flood = *options.flood;
  for (int axis = 0; axis < 3; ++axis) {
    const double index = flood[static_cast<std::size_t>(axis)];
    if (index < 0.0 || index > 1e9 || index != std::floor(index)) {
      return fail(ErrorKind::usage, "--init-flood: {} is not a voxel index", index);
    }
  }
  return check_order("--init-flood", flood[3], flood[4]);
}

Status check_inside(const StartOptions& options, const Geometry& geometry) {
  for (const auto* spheres : {&options.seeds, &options.erasers}) {
    TIDEMARK_TRY(resolve(*spheres, geometry));
  }
  if (options.flood && !geometry.contains(flood_seed(*options.flood))) {
    const Index3 voxel = flood_seed(*options.flood);
    return fail(ErrorKind::usage,
                "--init-flood: voxel ({}, {}, {}) is outside the volume of {} x {} x {} voxels", voxel.x,
                voxel.y, voxel.z, geometry.size.x, geometry.size.y, geometry.size.z);
  }
  return {};
}

Result<document::Start> make_start(const StartOptions& options, const StudyPlace& study, double band,
                                   Console& console) {
  const Geometry& grid = study.grid;
  document::Start start;
  if (options.threshold)
    start.from = document::ThresholdStart{(*options.threshold)[0], (*options.threshold)[1]};
  if (options.flood) {
    start.from = document::FloodStart{flood_seed(*options.flood), (*options.flood)[3], (*options.flood)[4]};
  }
  if (options.speed) start.from = document::SpeedStart{};
  if (options.mask) {
    auto mask = read_mask(*options.mask, study, console);
    if (!mask) return pass_on(mask);
    start.from = document::MaskStart{std::make_shared<const BitMask>(*mask),
                                     std::filesystem::path(*options.mask).filename().string()};
  }
  if (options.phi) {
    auto phi = read_phi(*options.phi, grid, band, console);
    if (!phi) return pass_on(phi);
    start.from = std::move(*phi);
  }
  auto seeds = resolve(options.seeds, grid);
  if (!seeds) return pass_on(seeds);
  start.seeds = std::move(*seeds);
  auto erasers = resolve(options.erasers, grid);
  if (!erasers) return pass_on(erasers);
  start.erasers = std::move(*erasers);
  start.levels = options.levels == kLevelsBySize ? solver::levels_for(grid) : options.levels;
  return start;
}

}  // namespace tidemark::cli
