// tidemark-cli info: the series under a path, before any voxel is read.
#include <memory>

#include "app/cli/program.h"
#include "app/cli/study_input.h"
#include "imaging/load_study.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kInfo{
    "info", "Lists the series found under a path",
    "Lists the series under PATH: size in voxels (i,j,k), spacing in mm, orientation and origin in patient\n"
    "coordinates (LPS, mm), the frame of reference and which other series share it, transfer syntax, and\n"
    "whether and why not they can be loaded.\n"
    "A DICOM series that holds several volumes (echoes, times, b-values, stacks) is listed volume by "
    "volume,\n"
    "each with its number behind the UID: 1.2.3#2. Without a number --series takes the largest.",
    "  tidemark-cli info study/                 every DICOM series below a folder\n"
    "  tidemark-cli info brain.nii.gz           one volume file\n"
    "  tidemark-cli info study/ --json          the same for programs\n"
    "  tidemark-cli info study/ --gaps fill     with missing slices interpolated\n"};

Json triple(const glm::dvec3& v) {
  return Json::array({v.x, v.y, v.z});
}

Json to_json(const imaging::Series& series, const imaging::Catalogue& catalogue) {
  const Geometry& grid = series.geometry;
  const bool known = grid.voxel_count() > 0;
  Json direction = Json::array();  // the unit vector of the i axis, then of j, then of k
  for (int axis = 0; axis < 3; ++axis) {
    for (int part = 0; part < 3; ++part) direction.push_back(grid.direction[axis][part]);
  }
  Json object;
  object["uid"] = series.uid;
  object["modality"] = series.modality;
  object["description"] = series.description;
  object["date"] = series.date;
  object["files"] = series.files.size();
  object["images"] = series.sources.size();  // slices: frames of files, or tiles of frames
  object["size"] = known ? Json::array({grid.size.x, grid.size.y, grid.size.z}) : Json();
  object["spacing_mm"] = known ? triple(grid.spacing_mm) : Json();
  object["direction"] = known ? direction : Json();
  object["origin_mm"] = known ? triple(grid.origin_mm) : Json();
  object["frame_of_reference"] = series.frame_of_reference_uid;
  object["same_frame"] = Json::array();  // the UIDs of the other series on it
  for (const imaging::Series* other : catalogue.on_the_frame_of(series)) {
    object["same_frame"].push_back(other->uid);
  }
  object["scalar"] = series.scalar;
  object["unit"] = series.unit;
  object["transfer_syntaxes"] = series.transfer_syntaxes;
  object["loadable"] = series.loadable;
  object["reason"] = series.reason;
  object["fillable"] = series.fillable();  // with --gaps fill
  object["changes"] = series.changes;
  object["warnings"] = series.warnings;
  return object;
}

Json to_json(const imaging::Catalogue& catalogue) {
  Json object;
  object["series"] = Json::array();
  object["skipped"] = Json::array();
  for (const imaging::Series& series : catalogue.series)
    object["series"].push_back(to_json(series, catalogue));
  for (const imaging::SkippedFile& skipped : catalogue.skipped) {
    object["skipped"].push_back({{"file", skipped.file.string()}, {"reason", skipped.reason}});
  }
  return object;
}

// The letter of the patient's side that an axis points to most: L R, P A, H F.
std::string axis_letters(const glm::dmat3& direction) {
  constexpr const char* kTowards[3][2] = {{"R", "L"}, {"A", "P"}, {"F", "H"}};
  std::string letters;
  for (int axis = 0; axis < 3; ++axis) {
    int strongest = 0;
    for (int part = 1; part < 3; ++part) {
      if (std::abs(direction[axis][part]) > std::abs(direction[axis][strongest])) strongest = part;
    }
    letters += kTowards[strongest][direction[axis][strongest] > 0 ? 1 : 0];
  }
  return letters;
}

void say_geometry(Console& console, const Geometry& grid) {
  console.say("  size        {} x {} x {} voxels", grid.size.x, grid.size.y, grid.size.z);
  console.say("  spacing     {:.6g} x {:.6g} x {:.6g} mm", grid.spacing_mm.x, grid.spacing_mm.y,
              grid.spacing_mm.z);
  console.say("  axes        {} (to which side of the patient i, j and k run)", axis_letters(grid.direction));
  console.say("  origin      {:.6g}, {:.6g}, {:.6g} mm (LPS)", grid.origin_mm.x, grid.origin_mm.y,
              grid.origin_mm.z);
}

// Series of one frame lie in the same patient coordinates: they can be shown and used together as they are.
void say_frame(Console& console, const imaging::Series& series, const imaging::Catalogue& catalogue) {
  if (series.frame_of_reference_uid.empty()) return;
  console.say("  frame       {}", series.frame_of_reference_uid);
  for (const imaging::Series* other : catalogue.on_the_frame_of(series)) {
    console.say("              shared with {}{}{}", other->uid, other->description.empty() ? "" : ", ",
                other->description);
  }
}

void say_series(Console& console, const imaging::Series& series, const imaging::Catalogue& catalogue) {
  console.say("{}{}{}", series.modality, series.modality.empty() ? "" : "  ", series.description);
  console.say("  uid         {}", series.uid);
  if (!series.date.empty()) console.say("  date        {}", series.date);
  const bool has_many = series.sources.size() > series.files.size();
  console.say("  files       {}{}", series.files.size(),
              has_many ? fmt::format(" with {} slices in them", series.sources.size()) : "");
  if (series.geometry.voxel_count() > 0) say_geometry(console, series.geometry);
  say_frame(console, series, catalogue);
  if (!series.scalar.empty()) {
    console.say("  values      {}{}{}", series.scalar, series.unit.empty() ? "" : ", ", series.unit);
  }
  for (const std::string& syntax : series.transfer_syntaxes) console.say("  syntax      {}", syntax);
  console.say("  loadable    {}", series.loadable ? "yes" : "no: " + series.reason);
  if (series.fillable()) console.say("              --gaps fill interpolates");
  for (const std::string& change : series.changes) console.say("  changed     {}", change);
  for (const std::string& warning : series.warnings) console.say("  warning     {}", warning);
}

void say_catalogue(Console& console, const imaging::Catalogue& catalogue) {
  for (const imaging::Series& series : catalogue.series) {
    say_series(console, series, catalogue);
    console.say("");
  }
  for (const imaging::SkippedFile& skipped : catalogue.skipped) {
    console.say("skipped {}: {}", skipped.file.string(), skipped.reason);
  }
  console.say("{} series, {} files skipped", catalogue.series.size(), catalogue.skipped.size());
}

Status run(Program& program, const StudyInput& study) {
  Console& console = program.console;
  auto catalogue = imaging::find_series(study.path, console.progress(), study.policy());
  if (!catalogue) return pass_on(catalogue);
  if (console.interrupted()) return cancelled_error();
  if (console.json()) {
    console.result(to_json(*catalogue));
  } else {
    say_catalogue(console, *catalogue);
  }
  return {};
}

}  // namespace

void add_info(CLI::App& app, Program& program) {
  auto study = std::make_shared<StudyInput>();
  CLI::App& command = add_command(app, program, kInfo, [&program, study] { return run(program, *study); });
  command
      .add_option("PATH", study->path,
                  "A DICOM folder, file or DICOMDIR, a volume file, or a zip archive of these")
      ->required()
      ->type_name("");
  add_grid_options(command, *study);
}

}  // namespace tidemark::cli
