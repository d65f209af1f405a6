#include "app/cli/start.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "app/cli/align.h"
#include "imaging/filters/filters.h"
#include "imaging/study.h"
#include "solver/distance_transform.h"

namespace tidemark::cli {
namespace {

Index3 flood_seed(const std::vector<double>& flood) {
  return {std::llround(flood[0]), std::llround(flood[1]), std::llround(flood[2])};
}

Result<Mask> initial_mask(const Volume& source, const StartOptions& options, Console& console) {
  if (options.threshold) return threshold(source, (*options.threshold)[0], (*options.threshold)[1]);
  if (options.flood) {
    const std::vector<double>& flood = *options.flood;
    return flood_fill(source, flood_seed(flood), flood[3], flood[4]);
  }
  auto mask = load_mask(*options.mask, console.progress());
  if (!mask) return pass_on(mask);
  return onto_grid(std::move(*mask), source.geometry, *options.mask);
}

Result<Field> saved_field(const Volume& source, const std::string& file, double band, Console& console) {
  const auto volume = load_volume(file, {}, console.progress());
  if (!volume) return tl::unexpected<Error>(volume.error());
  auto values = onto_grid(*volume, source.geometry, file);
  if (!values) return pass_on(values);
  const auto limit = static_cast<float>(band);
  for (float& value : *values) value = std::clamp(value, -limit, limit);
  return Field::from_dense(source.geometry, *values, band);
}

Status restore_init(Executor& executor, const Volume& source, const StartOptions& options, Console& console) {
  if (options.phi) {
    const auto field = saved_field(source, *options.phi, executor.band(), console);
    if (!field) return tl::unexpected<Error>(field.error());
    return executor.restore(*field);
  }
  if (!options.mask && !options.threshold && !options.flood) return {};
  const auto mask = initial_mask(source, options, console);
  if (!mask) return tl::unexpected<Error>(mask.error());
  return executor.restore(distance_transform(*mask, executor.band()));
}

Status paint_all(Executor& executor, const Geometry& geometry, const std::vector<SphereArgument>& spheres,
                 Brush brush) {
  for (const SphereArgument& argument : spheres) {
    const auto sphere = argument.resolve(geometry);
    if (!sphere) return tl::unexpected<Error>(sphere.error());
    if (Status painted = executor.paint(*sphere, brush); !painted) return painted;
  }
  return {};
}

Status check_order(const std::string& option, double low, double high) {
  if (low <= high) return {};
  return fail(ErrorKind::usage, "{}: the lower limit {} is above the upper limit {}", option, low, high);
}

std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

void add_start_options(CLI::App& app, StartOptions& options) {
  const char* const kGroup = "Start (at least one)";
  add_spheres(app, "--seed", SphereUnits::voxels, options.seeds,
              "A ball around voxel I,J,K with radius R in mm; may be repeated")
      ->group(kGroup);
  add_spheres(app, "--seed-mm", SphereUnits::millimetres, options.seeds,
              "A ball around a point in patient coordinates (LPS), all in mm; may be repeated")
      ->group(kGroup);
  app.add_option("--init", options.mask, "A mask on the same grid: every voxel that is not 0")
      ->type_name("MASK")
      ->group(kGroup);
  add_numbers(app, "--init-threshold", "LO,HI", options.threshold,
              "All voxels with values from LO to HI, in the volume's units (after --smooth)")
      ->group(kGroup);
  add_numbers(app, "--init-flood", "I,J,K,LO,HI", options.flood,
              "Voxels with values from LO to HI that are connected to voxel I,J,K")
      ->group(kGroup);
  app.add_option("--init-phi", options.phi, "A level set saved with --out-phi, to go on with")
      ->type_name("FILE")
      ->group(kGroup);
  add_spheres(app, "--erase", SphereUnits::voxels, options.erasers,
              "Takes a ball away from the start: voxel I,J,K, radius R in mm; may be repeated")
      ->group(kGroup);
  add_spheres(app, "--erase-mm", SphereUnits::millimetres, options.erasers,
              "The same in patient coordinates (LPS, mm)")
      ->group(kGroup);
}

Status check(const StartOptions& options) {
  const int inits = int{options.mask.has_value()} + int{options.threshold.has_value()} +
                    int{options.flood.has_value()} + int{options.phi.has_value()};
  if (inits > 1) {
    return fail(ErrorKind::usage,
                "only one of --init, --init-threshold, --init-flood and --init-phi can be given");
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
    for (const SphereArgument& argument : *spheres) {
      const auto sphere = argument.resolve(geometry);
      if (!sphere) return tl::unexpected<Error>(sphere.error());
    }
  }
  if (options.flood && !geometry.contains(flood_seed(*options.flood))) {
    const Index3 voxel = flood_seed(*options.flood);
    return fail(ErrorKind::usage,
                "--init-flood: voxel ({}, {}, {}) is outside the volume of {} x {} x {} voxels", voxel.x,
                voxel.y, voxel.z, geometry.size.x, geometry.size.y, geometry.size.z);
  }
  return {};
}

Status start(Executor& executor, const Volume& source, const StartOptions& options, Console& console) {
  if (Status done = restore_init(executor, source, options, console); !done) return done;
  if (Status done = paint_all(executor, source.geometry, options.seeds, Brush::add); !done) return done;
  if (Status done = paint_all(executor, source.geometry, options.erasers, Brush::erase); !done) return done;
  const auto phi = executor.snapshot();
  if (!phi) return tl::unexpected<Error>(phi.error());
  if (phi->mask().count() == 0) {
    return fail(ErrorKind::usage, "the start is empty: no voxel is inside ({})", describe(options));
  }
  return {};
}

std::string describe(const StartOptions& options) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (options.mask) add("mask " + std::filesystem::path(*options.mask).filename().string());
  if (options.phi) add("phi " + std::filesystem::path(*options.phi).filename().string());
  if (options.threshold)
    add(fmt::format("values {} to {}", (*options.threshold)[0], (*options.threshold)[1]));
  if (options.flood)
    add(fmt::format("flood fill, values {} to {}", (*options.flood)[3], (*options.flood)[4]));
  if (!options.seeds.empty()) add(counted(options.seeds.size(), "seed"));
  if (!options.erasers.empty()) add(counted(options.erasers.size(), "eraser"));
  return text;
}

}  // namespace tidemark::cli
