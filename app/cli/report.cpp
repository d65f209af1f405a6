#include "app/cli/report.h"

#include <algorithm>

#include "app/cli/arguments.h"

namespace tidemark::cli {
namespace {

double per_second(std::int64_t count, double seconds) {
  return seconds > 0.0 ? static_cast<double>(count) / seconds : 0.0;
}

Json parameters_json(const RunFigures& figures) {
  const solver::Parameters& parameters = figures.parameters;
  Json object;
  object["target"] = parameters.target;
  object["range"] = parameters.range;
  object["alpha"] = parameters.alpha;
  object["alpha_paper"] = solver::paper_alpha(parameters);
  object["band"] = figures.band;
  object["rescale"] = parameters.rescale.value_or(0.75 / figures.band);
  object["target_gradient"] = parameters.target_gradient;
  object["scheme"] = parameters.scheme == solver::Scheme::split ? "split" : "paper";
  object["data"] = parameters.data_form == solver::DataForm::clamped ? "clamped" : "raw";
  object["data_term"] = parameters.data_term;
  object["curvature_term"] = parameters.curvature_term;
  object["rescaling_term"] = parameters.rescaling_term;
  object["smooth_mm"] = figures.smooth_mm ? Json(*figures.smooth_mm) : Json();
  return object;
}

Json drive_json(const document::Drive& drive) {
  Json object;
  for (const solver::SpeedTerm& term : drive.setting.terms) {
    object["speed"].push_back({{"function", term.function}, {"values", term.values}});
  }
  object["combine"] = drive.setting.combine == solver::Combine::least ? "least" : "product";
  for (const auto& image : drive.images) object["images"].push_back(image->name);
  if (drive.strokes != nullptr) {
    object["examples"] = {{"inside", drive.strokes->inside.size()},
                          {"outside", drive.strokes->outside.size()}};
  }
  if (drive.constraints != nullptr) {
    object["wall_voxels"] = drive.constraints->count(solver::Constraint::wall);
    object["anchor_voxels"] = drive.constraints->count(solver::Constraint::anchor);
  }
  return object;
}

Json coarse_json(const std::vector<document::CoarseRun>& runs) {
  Json list = Json::array();
  for (const auto& [size, advance] : runs) {
    list.push_back({{"size", {size.x, size.y, size.z}},
                    {"steps", advance.steps},
                    {"seconds", advance.seconds},
                    {"converged", advance.converged}});
  }
  return list;
}

const char* describe(document::Outcome outcome) {
  switch (outcome) {
    case document::Outcome::converged:
      return "converged: the surface has stopped moving";
    case document::Outcome::vanished:
      return "vanished: it has shrunk to nothing";
    case document::Outcome::seeded_outside:
      return "vanished: the start lies outside of what attracts";
    case document::Outcome::filled_volume:
      return "the volume is filled";
    case document::Outcome::unfinished:
      break;
  }
  return "not converged";
}

bool has_pace(const RunFigures& figures) {
  return has_surface(figures.outcome) && figures.advance.steps > 0;
}

std::string describe_pace(const RunFigures& figures) {
  if (!has_pace(figures)) return {};
  return fmt::format(": {:.0f} steps/s, {:.0f} million voxel updates/s", steps_per_second(figures.advance),
                     voxel_updates_per_second(figures.advance) / 1e6);
}

}  // namespace

MaskChange change_between(const Region& before, const Region& after, const Geometry& grid) {
  MaskChange change;
  const std::int64_t common = common_count(before, after);
  change.added = after.count() - common;
  change.removed = before.count() - common;
  const double voxel_ml = grid.voxel_volume_ml();
  change.added_ml = static_cast<double>(change.added) * voxel_ml;
  change.removed_ml = static_cast<double>(change.removed) * voxel_ml;
  return change;
}

std::string advice_on(const RunFigures& figures) {
  const bool by_range = figures.drive == nullptr || document::uses_tent(*figures.drive);
  switch (figures.outcome) {
    case document::Outcome::vanished:
      return fmt::format(
          "the surface has vanished: it has shrunk to nothing (a larger start, {} or --alpha?)",
          by_range ? "--range" : "another --speed");
    case document::Outcome::seeded_outside:
      if (!by_range) {
        return "the surface has vanished: its speed is negative everywhere where it began (another start?)";
      }
      return fmt::format(
          "the surface has vanished: no value where it began is within {:.6g} -+ {:.6g} (another start or "
          "--target, a larger --range?)",
          figures.parameters.target, figures.parameters.range);
    case document::Outcome::filled_volume:
      return fmt::format("the surface has filled the volume (a smaller {}?)",
                         by_range ? "--range or --alpha" : "--alpha, --walls or another --speed");
    case document::Outcome::converged:
    case document::Outcome::unfinished:
      break;
  }
  return {};
}

double steps_per_second(const solver::AdvanceReport& report) {
  return per_second(report.steps, report.seconds);
}

double voxel_updates_per_second(const solver::AdvanceReport& report) {
  return per_second(report.voxel_updates, report.seconds);
}

double bytes_per_resident_voxel(const solver::MemoryReport& memory) {
  const std::int64_t voxels =
      memory.peak_resident_pages * memory.page_shape.x * memory.page_shape.y * memory.page_shape.z;
  return voxels > 0 ? static_cast<double>(memory.peak_state_bytes) / static_cast<double>(voxels) : 0.0;
}

Json grid_json(const Geometry& geometry) {
  Json object;
  object["size"] = {geometry.size.x, geometry.size.y, geometry.size.z};
  object["spacing_mm"] = {geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z};
  return object;
}

Json to_json(const RunFigures& figures) {
  const solver::AdvanceReport& advance = figures.advance;
  const solver::MemoryReport& memory = figures.memory;
  Json object;
  object["executor"] = figures.executor;
  object["threads"] = figures.threads;
  object["steps"] = advance.steps;
  object["seconds"] = advance.seconds;
  object["steps_per_second"] = has_pace(figures) ? Json(steps_per_second(advance)) : Json();
  object["voxel_updates"] = advance.voxel_updates;
  object["voxel_updates_per_second"] = has_pace(figures) ? Json(voxel_updates_per_second(advance)) : Json();
  object["coarse_levels"] = coarse_json(figures.coarse_runs);
  object["paging_seconds"] = advance.paging_seconds;
  object["converged"] = advance.converged;
  object["outcome"] = document::name_of(figures.outcome);
  object["wider_range"] = figures.wider_range ? Json(*figures.wider_range) : Json();
  object["surface_speed"] = advance.surface_speed;
  object["moving_pages"] = advance.moving_pages;
  if (const auto& place = figures.moves_at) object["moves_at"] = {place->x, place->y, place->z};
  object["time_step"] = figures.time_step;
  object["volume_ml"] = figures.surface.volume_ml;
  object["surface_mm2"] = figures.surface.surface_mm2;
  object["voxels_inside"] = figures.surface.voxels_inside;
  if (figures.dice) object["dice"] = *figures.dice;
  if (const auto& distance = figures.truth_distance) {
    object["truth_distance"] = {{"mean_mm", distance->mean_mm},
                                {"hausdorff95_mm", distance->most_mm},
                                {"hausdorff_mm", distance->largest_mm}};
  }
  object["resident_pages"] = memory.resident_pages;
  object["peak_resident_pages"] = memory.peak_resident_pages;
  object["quiet_pages"] = memory.quiet_pages;
  object["page_shape"] = {memory.page_shape.x, memory.page_shape.y, memory.page_shape.z};
  object["page_bytes"] = memory.state_bytes;
  object["peak_page_bytes"] = memory.peak_state_bytes;
  object["source_bytes"] = memory.source_bytes;
  object["bytes_per_resident_voxel"] = bytes_per_resident_voxel(memory);
  object.update(grid_json(figures.geometry));
  object["modality"] = figures.modality;
  object["unit"] = figures.unit;
  object["description"] = figures.description;
  object["series_uid"] = figures.series_uid.empty() ? Json() : Json(figures.series_uid);
  object["changes"] = figures.changes;
  object["start"] = figures.start;
  object["parameters"] = parameters_json(figures);
  object["drive"] = figures.drive == nullptr ? Json() : drive_json(*figures.drive);
  if (figures.change) {
    object["change"] = {{"added_voxels", figures.change->added},
                        {"removed_voxels", figures.change->removed},
                        {"added_ml", figures.change->added_ml},
                        {"removed_ml", figures.change->removed_ml}};
  }
  return object;
}

void say(Console& console, const RunFigures& figures) {
  const solver::AdvanceReport& advance = figures.advance;
  for (const auto& [size, coarse] : figures.coarse_runs) {
    console.say("Coarse     {} steps on {} x {} x {} voxels, {:.3f} s", coarse.steps, size.x, size.y, size.z,
                coarse.seconds);
  }
  console.say("Steps      {}, {}", advance.steps, describe(figures.outcome));
  console.say("Time       {:.3f} s in the solver ({}, {} threads){}", advance.seconds, figures.executor,
              figures.threads, describe_pace(figures));
  console.say("Volume     {:.3f} ml, {} voxels", figures.surface.volume_ml, figures.surface.voxels_inside);
  console.say("Surface    {:.1f} mm^2", figures.surface.surface_mm2);
  console.say("Pages      {} (at most {}), {:.1f} MB of solver state", figures.memory.resident_pages,
              figures.memory.peak_resident_pages,
              static_cast<double>(figures.memory.state_bytes) / kMebibyte);
  if (figures.dice) console.say("Dice       {:.4f} against the truth", *figures.dice);
  if (const auto& distance = figures.truth_distance) {
    console.say("Distance   {:.2f} mm to the truth on average, 95 % within {:.2f} mm, all within {:.2f} mm",
                distance->mean_mm, distance->most_mm, distance->largest_mm);
  }
  if (figures.wider_range) {
    console.say(
        "Hint       stopped inside of like tissue: its values vary more than --range {:.6g}; try {:.6g}",
        figures.parameters.range, *figures.wider_range);
  }
}

}  // namespace tidemark::cli
