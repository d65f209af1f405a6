// tidemark-cli compare: how much segmentations share, and how far apart their surfaces are.
#include <algorithm>
#include <memory>
#include <optional>

#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "app/cli/study_input.h"
#include "document/comparison.h"
#include "document/file_regions.h"
#include "imaging/files/volume_file.h"
#include "imaging/regions/staple.h"

namespace tidemark::cli {
namespace {

using document::FileRegions;

constexpr CommandHelp kCompare{
    "compare", "Compares segmentations: overlap, volumes and distances",
    "Compares the segmentations A and B, and more of them each with each, on the voxels of the first: Dice, "
    "Jaccard,\n"
    "volumes in ml, what only one of them has, and the distances between their surfaces in mm, both ways "
    "together\n"
    "(mean, 95th percentile, largest). A surface runs half way between voxels inside and outside; distances "
    "are\n"
    "taken between the middles of the voxel faces that it consists of.\n"
    "Files are volumes (every voxel that is not 0 is inside; with --labels each number is a label), DICOM\n"
    "segmentations and RT structure sets.",
    "  tidemark-cli compare mine.nii.gz theirs.nii.gz\n"
    "  tidemark-cli compare mine.dcm theirs.dcm --labels --json\n"
    "  tidemark-cli compare one.nii.gz two.nii.gz three.nii.gz --staple estimate.nii.gz\n"};

struct CompareOptions {
  std::vector<std::string> files;
  std::string grid;
  std::string staple;
  bool labels = false;
};

struct ComparedRow {
  std::string label;
  const FileRegions* reader = nullptr;
  const FileRegions* other = nullptr;
  document::Comparison comparison;
};

Json to_json(const ComparedRow& row) {
  const document::Comparison& comparison = row.comparison;
  const auto ml = [&](std::int64_t voxels) { return static_cast<double>(voxels) * comparison.voxel_ml; };
  Json object;
  if (!row.label.empty()) object["label"] = row.label;
  object["a"] = row.reader->file.string();
  object["b"] = row.other->file.string();
  object["dice"] = comparison.dice();
  object["jaccard"] = comparison.jaccard();
  object["voxels_a"] = comparison.voxels;
  object["voxels_b"] = comparison.other_voxels;
  object["voxels_common"] = comparison.common;
  object["volume_a_ml"] = ml(comparison.voxels);
  object["volume_b_ml"] = ml(comparison.other_voxels);
  object["only_a_ml"] = ml(comparison.voxels - comparison.common);
  object["only_b_ml"] = ml(comparison.other_voxels - comparison.common);
  const auto& distance = comparison.distance;
  object["mean_distance_mm"] = distance ? Json(distance->mean_mm) : Json();
  object["hausdorff95_mm"] = distance ? Json(distance->most_mm) : Json();
  object["hausdorff_mm"] = distance ? Json(distance->largest_mm) : Json();
  return object;
}

void say(Console& console, const std::vector<ComparedRow>& rows, bool names_files) {
  console.say("{:<24} {:>7} {:>8} {:>10} {:>10} {:>9} {:>9} {:>9}", "", "Dice", "Jaccard", "A ml", "B ml",
              "mean mm", "95 % mm", "most mm");
  for (const ComparedRow& row : rows) {
    const document::Comparison& comparison = row.comparison;
    const auto& distance = comparison.distance;
    const auto mm = [&](double value) { return distance ? fmt::format("{:.3f}", value) : std::string("-"); };
    const std::string name = row.label.empty() ? "mask" : row.label;
    if (names_files) console.say("{} and {}", row.reader->file.string(), row.other->file.string());
    console.say("{:<24} {:>7.4f} {:>8.4f} {:>10.3f} {:>10.3f} {:>9} {:>9} {:>9}", name, comparison.dice(),
                comparison.jaccard(), static_cast<double>(comparison.voxels) * comparison.voxel_ml,
                static_cast<double>(comparison.other_voxels) * comparison.voxel_ml,
                mm(distance ? distance->mean_mm : 0.0), mm(distance ? distance->most_mm : 0.0),
                mm(distance ? distance->largest_mm : 0.0));
  }
}

// The names of all regions, in the order in which files bring them.
std::vector<std::string> names_in(const std::vector<FileRegions>& readers) {
  std::vector<std::string> names;
  for (const FileRegions& reader : readers) {
    for (const auto& region : reader.list) {
      if (std::find(names.begin(), names.end(), region.first) == names.end()) names.push_back(region.first);
    }
  }
  return names;
}

Result<std::vector<ComparedRow>> compare_all(const std::vector<FileRegions>& readers, const Geometry& grid,
                                             Console& console) {
  const Region nothing;
  std::vector<ComparedRow> rows;
  for (const std::string& name : names_in(readers)) {
    for (auto reader = readers.begin(); reader != readers.end(); ++reader) {
      for (auto other = std::next(reader); other != readers.end(); ++other) {
        const Region* a = reader->find(name);
        const Region* b = other->find(name);
        if (a == nullptr && b == nullptr) continue;
        auto comparison = document::compare(a != nullptr ? *a : nothing, b != nullptr ? *b : nothing, grid,
                                            console.progress());
        if (!comparison) return pass_on(comparison);
        rows.push_back({name, &*reader, &*other, *comparison});
      }
    }
  }
  return rows;
}

Result<Json> estimate(const std::vector<FileRegions>& readers, const Geometry& grid, const std::string& file,
                      Outputs& outputs, Console& console) {
  std::vector<Region> regions;
  for (const FileRegions& reader : readers) regions.push_back(reader.list.front().second);
  auto estimated = imaging::estimate_truth(regions, grid, console.progress());
  if (!estimated) return pass_on(estimated);
  const Mask mask = mask_of(estimated->region, grid);
  Status staged = outputs.stage(
      file, [&](const std::filesystem::path& name) { return imaging::write_mask_file(mask, name); });
  if (!staged) return pass_on(staged);
  Json object;
  object["volume_ml"] = static_cast<double>(estimated->region.count()) * grid.voxel_volume_ml();
  for (std::size_t n = 0; n < readers.size(); ++n) {
    const imaging::ReaderQuality& quality = estimated->readers[n];
    const std::string name = readers[n].file.string();
    object["readers"].push_back({{"file", name},
                                 {"sensitivity", quality.sensitivity},
                                 {"specificity", quality.specificity},
                                 {"dice", quality.dice}});
    console.say("STAPLE     {}: sensitivity {:.4f}, specificity {:.4f}, Dice {:.4f}", name,
                quality.sensitivity, quality.specificity, quality.dice);
  }
  return object;
}

Status check(const CompareOptions& options, Outputs& outputs, const Progress& progress) {
  if (options.files.size() < 2) return fail(ErrorKind::usage, "compare needs two files at least");
  if (options.staple.empty()) return {};
  if (options.labels) return fail(ErrorKind::usage, "--staple is for masks, not for --labels");
  TIDEMARK_TRY(outputs.announce("--staple", options.staple, {FileForm::volume}));
  std::vector<std::string> inputs = options.files;
  if (!options.grid.empty()) inputs.push_back(options.grid);
  return spare_inputs(outputs, inputs, progress);
}

Status run(Program& program, const CompareOptions& options) {
  Console& console = program.console;
  Outputs outputs;
  TIDEMARK_TRY(check(options, outputs, console.progress()));
  std::optional<Geometry> grid;
  if (!options.grid.empty()) {
    StudyInput study;
    study.path = options.grid;
    const auto chosen = find_study(study, console.progress());
    if (!chosen) return pass_on(chosen);
    grid = chosen->series.geometry;
  }
  std::vector<FileRegions> readers;
  for (const std::string& file : options.files) {
    auto reader = document::read_regions(file, options.labels, grid, console.progress());
    if (!reader && !readers.empty() && options.grid.empty() && reader.error().kind == ErrorKind::input &&
        std::filesystem::exists(file))
      return fail(ErrorKind::input, "{} (--grid STUDY compares on the voxels of a study)",
                  reader.error().message);
    if (!reader) return pass_on(reader);
    for (const std::string& change : reader->changes) console.warn(file + ": " + change);
    readers.push_back(std::move(*reader));
    if (console.interrupted()) return cancelled_error();
  }
  auto rows = compare_all(readers, *grid, console);
  if (!rows) return pass_on(rows);
  say(console, *rows, readers.size() > 2);
  Json result;
  result["comparisons"] = Json::array();
  for (const ComparedRow& row : *rows) result["comparisons"].push_back(to_json(row));
  if (!options.staple.empty()) {
    auto estimated = estimate(readers, *grid, options.staple, outputs, console);
    if (!estimated) return pass_on(estimated);
    result["staple"] = std::move(*estimated);
    TIDEMARK_TRY(outputs.commit(console.progress()));
    console.say("Wrote      {}", options.staple);
  }
  console.result(result);
  return {};
}

}  // namespace

void add_compare(CLI::App& app, Program& program) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App& command =
      add_command(app, program, kCompare, [&program, options] { return run(program, *options); });
  command.add_option("FILES", options->files, "Two segmentations or more: A B ...")
      ->required()
      ->type_name("");
  command.add_flag(
      "--labels", options->labels,
      "Compares label by label: numbers of a volume, segments of the same name in DICOM results");
  command
      .add_option(
          "--grid", options->grid,
          "The study on whose voxels they are compared (default: the first file's own;\nRT structure sets "
          "have none)")
      ->type_name("INPUT");
  command
      .add_option(
          "--staple", options->staple,
          "Where an estimate of the truth from all files is written, by STAPLE\n(.nii .nii.gz .nrrd .mha: 1 "
          "inside), with each one's sensitivity and specificity")
      ->type_name("FILE");
}

}  // namespace tidemark::cli
