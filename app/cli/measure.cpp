// tidemark-cli measure: the sizes, forms and values of the regions of a segmentation.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "app/cli/image_files.h"
#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "app/cli/study_input.h"
#include "core/csv.h"
#include "core/json/json_field.h"
#include "core/text_file.h"
#include "document/file_regions.h"
#include "document/measure_codes.h"
#include "document/result_files.h"
#include "imaging/results/key_images.h"
#include "imaging/results/results.h"
#include "renderer/sheet.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kMeasure{
    "measure", "Measures segmentations: volume, diameters, form, and values inside",
    "Measures the regions of SEGMENTATION on the voxels of INPUT: volume and surface, sphericity, the "
    "longest\n"
    "diameter, the longest one in an axial slice with the longest at right angles to it (RECIST's two), the\n"
    "reach along the main axes, and mean, deviation, range and percentiles of the study's values; of PET in\n"
    "standardised uptake values the peak (a ball of 1 ml) and the total lesion glycolysis, too.\n"
    "An image that ends within a region is measured in the part that it covers, with a warning.\n"
    "Diameters end at the middles of voxel faces; places are mm in the patient (LPS).\n"
    "SEGMENTATION is a volume (every voxel that is not 0 is inside; with --labels each number is a label), "
    "a\n"
    "DICOM segmentation or an RT structure set.",
    "  tidemark-cli measure ct/ tumour.nii.gz\n"
    "  tidemark-cli measure ct/ labels.dcm --labels --image pet/ --csv measures.csv\n"
    "  tidemark-cli measure ct/ labels.dcm --labels --report report.dcm\n"
    "  tidemark-cli measure ct/ labels.dcm --labels --key-images key.dcm --presentation outlines.dcm\n"
    "  tidemark-cli measure may/ may.dcm --labels --json > may.json\n"
    "  tidemark-cli measure june/ june.dcm --labels --before may.json      how much they changed\n"};

constexpr std::size_t kMostRegions = 65'535;

struct MeasureOptions {
  StudyInput study;
  std::string file;
  std::vector<std::string> images;
  std::string before;
  std::string csv;
  std::string report;
  std::string key_images;
  std::string presentation;
  std::string note = imaging::kKeyImageNote;
  bool labels = false;
};

struct MeasuredRow {
  std::size_t index = 0;  // of the file's regions
  std::string label;
  document::Measures measures;
};

// A region as it was in an earlier study.
struct Earlier {
  std::string label;
  double volume_ml = 0.0;
  double diameter_mm = 0.0;  // the longest in a slice
};

Result<std::vector<Earlier>> read_earlier(const std::string& file) {
  const auto text = read_text_file(file, JsonLimits{}.bytes);
  if (!text) return pass_on(text);
  const auto document = JsonDocument::parse(*text, file);
  if (!document) return pass_on(document);
  const JsonField whole(*document, file);
  const JsonField regions = whole.at("regions");
  std::vector<Earlier> earlier(regions.size(kMostRegions));
  for (std::size_t n = 0; n < earlier.size() && whole.good(); ++n) {
    const JsonField region = regions.at(n);
    if (region.has("label")) earlier[n].label = region.at("label").text();
    earlier[n].volume_ml = region.at("volume_ml").number(0.0);
    earlier[n].diameter_mm = region.at("longest_in_slice").at("mm").number(0.0);
  }
  if (!whole.good()) return pass_on(whole.status());
  return earlier;
}

// Percent of what was; null: there was nothing.
Json change(double now, double before) {
  return before > 0.0 ? Json(100.0 * (now - before) / before) : Json();
}

std::string percent(const Json& change) {
  return change.is_null() ? "new" : fmt::format("{:+.1f} %", change.get<double>());
}

// Regions of the same name, and the sum of the diameters of those that both studies have (RECIST 1.1 adds the
// longest diameters of its target lesions).
Json changes_since(const std::vector<Earlier>& earlier, const std::vector<MeasuredRow>& rows,
                   Console& console) {
  Json object{{"regions", Json::array()}, {"missing", Json::array()}};
  double sum = 0.0;
  double sum_before = 0.0;
  for (const MeasuredRow& row : rows) {
    const auto before = std::find_if(earlier.begin(), earlier.end(),
                                     [&](const Earlier& one) { return one.label == row.label; });
    const Earlier was = before == earlier.end() ? Earlier{} : *before;
    const double diameter_mm = row.measures.diameters.in_slice.length_mm();
    const Json volume = change(row.measures.volume_ml, was.volume_ml);
    const Json diameter = change(diameter_mm, was.diameter_mm);
    object["regions"].push_back(
        {{"label", row.label}, {"volume_percent", volume}, {"longest_in_slice_percent", diameter}});
    console.say("{:<24} volume {}, longest in a slice {}", row.label, percent(volume), percent(diameter));
    if (before == earlier.end()) continue;
    sum += diameter_mm;
    sum_before += was.diameter_mm;
  }
  for (const Earlier& one : earlier) {
    if (std::any_of(rows.begin(), rows.end(), [&](const MeasuredRow& row) { return row.label == one.label; }))
      continue;
    object["missing"].push_back(one.label);
    console.say("{:<24} is no longer there", one.label);
  }
  object["sum_mm"] = sum;
  object["sum_before_mm"] = sum_before;
  object["sum_percent"] = change(sum, sum_before);
  console.say("Sum of diameters         {:.1f} mm, was {:.1f} mm: {}", sum, sum_before,
              percent(object["sum_percent"]));
  return object;
}

void say(Console& console, const std::vector<MeasuredRow>& rows) {
  console.say("{:<24} {:>10} {:>9} {:>10} {:>10} {:>9} {:>9} {:>9}", "", "ml", "longest", "in a slice",
              "across", "mean", "SD", "median");
  for (const MeasuredRow& row : rows) {
    const imaging::Diameters& diameters = row.measures.diameters;
    for (const document::ImageValues& image : row.measures.images) {
      const bool first = &image == &row.measures.images.front();
      const std::string values =
          fmt::format("{:>9.2f} {:>9.2f} {:>9.2f}", image.values.mean, image.values.standard_deviation,
                      image.values.percentiles[imaging::kPercentiles.size() / 2]);
      if (first) {
        console.say("{:<24} {:>10.3f} {:>9.1f} {:>10.1f} {:>10.1f} {}",
                    row.label.empty() ? "mask" : row.label, row.measures.volume_ml,
                    diameters.longest.length_mm(), diameters.in_slice.length_mm(),
                    diameters.across.length_mm(), values);
      } else {
        console.say("  {:<65} {}", image.image, values);
      }
      if (const auto& uptake = image.values.uptake)
        console.say("  SUV peak {:.3f}, largest {:.3f}, total lesion glycolysis {:.2f}", uptake->peak,
                    image.values.largest, uptake->total_glycolysis);
    }
  }
}

std::string csv_of(const std::vector<MeasuredRow>& rows) {
  std::vector<std::string> header{"label",     "image",      "unit",       "voxels",      "volume_ml",
                                  "area_mm2",  "sphericity", "longest_mm", "in_slice_mm", "across_mm",
                                  "reach1_mm", "reach2_mm",  "reach3_mm",  "mean",        "sd",
                                  "smallest",  "largest"};
  for (const double percent : imaging::kPercentiles) header.push_back(fmt::format("p{}", percent));
  header.insert(header.end(), {"peak_1ml", "total_glycolysis", "covered"});
  std::string csv = csv_line(header);
  const auto number = [](double value) { return fmt::format("{:.10g}", value); };
  for (const MeasuredRow& row : rows) {
    const document::Measures& all = row.measures;
    const imaging::Diameters& d = all.diameters;
    for (const document::ImageValues& image : all.images) {
      const imaging::InsideValues& inside = image.values;
      std::vector<std::string> cells{csv_text(row.label), csv_text(image.image), csv_text(image.unit),
                                     std::to_string(all.voxels)};
      for (const double value :
           {all.volume_ml, all.area_mm2, all.sphericity, d.longest.length_mm(), d.in_slice.length_mm(),
            d.across.length_mm(), d.reach_mm.x, d.reach_mm.y, d.reach_mm.z, inside.mean,
            inside.standard_deviation, inside.smallest, inside.largest})
        cells.push_back(number(value));
      for (const double value : inside.percentiles) cells.push_back(number(value));
      cells.push_back(inside.uptake ? number(inside.uptake->peak) : "");
      cells.push_back(inside.uptake ? number(inside.uptake->total_glycolysis) : "");
      cells.push_back(number(image.covered));
      csv += csv_line(cells);
    }
  }
  return csv;
}

// The study's own values first.
Result<std::vector<document::MeasuredImage>> images_on(const Geometry& grid, imaging::LoadedSeries study,
                                                       const MeasureOptions& options, Console& console) {
  const StudyPlace place = place_of(study);
  std::vector<document::MeasuredImage> images;
  images.push_back({options.study.path, std::make_shared<const Volume>(std::move(study.volume))});
  for (const std::string& file : options.images) {
    const auto image = read_image(file, console);
    if (!image) return pass_on(image);
    const auto on_case = placed(*image, file, place, console);
    if (!on_case) return pass_on(on_case);
    auto measured = document::measured_image(file, **on_case, grid);
    if (!measured) return pass_on(measured);
    images.push_back(std::move(*measured));
  }
  return images;
}

std::string name_of(const std::string& label) {
  return label.empty() ? "the mask" : label;
}

// The images do not have all of the region.
void warn_of_parts(const MeasuredRow& row, const std::vector<document::MeasuredImage>& images,
                   Console& console) {
  for (const document::MeasuredImage& image : images) {
    const auto& all = row.measures.images;
    const auto found = std::find_if(
        all.begin(), all.end(), [&](const document::ImageValues& one) { return one.image == image.name; });
    const double covered = found == all.end() ? 0.0 : found->covered;
    if (covered < 1.0)
      console.warn(fmt::format("{}: covers {:.1f} % of {}", image.name, std::floor(1000.0 * covered) / 10.0,
                               name_of(row.label)));
  }
}

Result<std::vector<MeasuredRow>> measure_all(const document::FileRegions& regions, const Geometry& grid,
                                             const std::vector<document::MeasuredImage>& images,
                                             Console& console) {
  std::vector<MeasuredRow> rows;
  for (std::size_t index = 0; index < regions.list.size(); ++index) {
    const auto& [label, region] = regions.list[index];
    if (region.empty()) {
      console.warn(fmt::format("{}: {} is empty", regions.file.string(), name_of(label)));
      continue;
    }
    auto measures = document::measure(region, grid, images, nullptr, console.progress());
    if (!measures) return pass_on(measures);
    rows.push_back({index, label, std::move(*measures)});
    warn_of_parts(rows.back(), images, console);
  }
  return rows;
}

Status write_files(const std::vector<MeasuredRow>& rows, const std::string& modality,
                   const MeasureOptions& options, Outputs& outputs, const Progress& progress) {
  if (!options.csv.empty()) {
    TIDEMARK_TRY(outputs.stage(
        options.csv, [&](const std::filesystem::path& file) { return write_file(file, csv_of(rows)); }));
  }
  if (!options.report.empty()) {
    std::vector<imaging::ReportedSegment> segments;
    for (const MeasuredRow& row : rows)
      segments.push_back({row.index, document::coded(row.measures, modality)});
    TIDEMARK_TRY(outputs.stage(options.report, [&](const std::filesystem::path& file) {
      return imaging::write_measurement_report(options.file, segments, modality, file);
    }));
  }
  return outputs.commit(progress);
}

// The images themselves stay where they are.
Status stage_key_images(const imaging::LoadedSeries& study, const MeasureOptions& options, Outputs& outputs,
                        const Progress& progress) {
  if (options.key_images.empty()) return {};
  const std::vector<std::filesystem::path> source = imaging::dicom_files_of(study.series);
  if (source.empty()) {
    return fail(ErrorKind::usage, "--key-images: {} is no DICOM series whose images could be named",
                options.study.path);
  }
  const auto segments = document::read_labels(options.file, &study.volume.geometry, progress);
  if (!segments) return pass_on(segments);
  const auto window = imaging::window_of_files(study.volume, renderer::window_of(study.volume));
  const auto write = [&](const std::filesystem::path& selection, const std::filesystem::path& presentation) {
    return imaging::write_key_images(*segments, source, window, options.note, {selection, presentation},
                                     progress);
  };
  return outputs.stage(options.key_images, [&](const std::filesystem::path& selection) -> Status {
    if (options.presentation.empty()) return write(selection, {});
    return outputs.stage(options.presentation, [&](const std::filesystem::path& presentation) {
      return write(selection, presentation);
    });
  });
}

Status announce(const MeasureOptions& options, Outputs& outputs, const Progress& progress) {
  if (!options.csv.empty()) {
    TIDEMARK_TRY(outputs.announce_csv("--csv", options.csv));
  }
  if (!options.report.empty()) {
    TIDEMARK_TRY(outputs.announce_dicom("--report", options.report));
    if (!options.labels || imaging::result_form_of(options.file) != imaging::ResultForm::segmentation)
      return fail(ErrorKind::usage, "--report needs --labels, and a DICOM segmentation that it can refer to");
  }
  for (const auto& [option, file] :
       {std::pair{"--key-images", options.key_images}, {"--presentation", options.presentation}}) {
    if (file.empty()) continue;
    TIDEMARK_TRY(outputs.announce_dicom(option, file));
  }
  if (!options.key_images.empty() && !options.labels)
    return fail(ErrorKind::usage, "--key-images needs --labels: each label has an image of its own");
  if (!options.presentation.empty() && options.key_images.empty())
    return fail(ErrorKind::usage, "--presentation needs --key-images, whose images it shows");
  TIDEMARK_TRY(spare_study(outputs, options.study, progress));
  std::vector<std::string> inputs = options.images;
  inputs.push_back(options.file);
  if (!options.before.empty()) inputs.push_back(options.before);
  return spare_inputs(outputs, inputs, progress);
}

Status run(Program& program, const MeasureOptions& options) {
  Console& console = program.console;
  Outputs outputs;
  TIDEMARK_TRY(announce(options, outputs, console.progress()));
  std::vector<Earlier> earlier;
  if (!options.before.empty()) {
    auto read = read_earlier(options.before);
    if (!read) return pass_on(read);
    earlier = std::move(*read);
  }
  auto study = load_study(options.study, console.progress());
  if (!study) return pass_on(study);
  TIDEMARK_TRY(stage_key_images(*study, options, outputs, console.progress()));
  const std::string modality = study->volume.modality;
  std::optional<Geometry> grid = study->volume.geometry;
  const auto regions = document::read_regions(options.file, options.labels, grid, console.progress());
  if (!regions) return pass_on(regions);
  for (const std::string& change : regions->changes) console.warn(options.file + ": " + change);
  warn_of_frame(options.file, regions->frames_of_reference, place_of(*study), console);
  const auto images = images_on(*grid, std::move(*study), options, console);
  if (!images) return pass_on(images);
  const auto rows = measure_all(*regions, *grid, *images, console);
  if (!rows) return pass_on(rows);

  say(console, *rows);
  Json result{{"regions", Json::array()}};
  for (const MeasuredRow& row : *rows) {
    Json region;
    if (options.labels) region["label"] = row.label;
    region.update(document::to_json(row.measures));
    result["regions"].push_back(std::move(region));
  }
  if (!options.before.empty()) result["change"] = changes_since(earlier, *rows, console);
  TIDEMARK_TRY(write_files(*rows, modality, options, outputs, console.progress()));
  for (const std::string& file : {options.csv, options.report, options.key_images, options.presentation}) {
    if (!file.empty()) console.say("Wrote      {}", file);
  }
  console.result(result);
  return {};
}

}  // namespace

void add_measure(CLI::App& app, Program& program) {
  auto options = std::make_shared<MeasureOptions>();
  CLI::App& command =
      add_command(app, program, kMeasure, [&program, options] { return run(program, *options); });
  add_study_input(command, options->study);
  command.add_option("SEGMENTATION", options->file, "The regions that are measured")
      ->required()
      ->type_name("");
  command.add_flag("--labels", options->labels,
                   "Measures label by label: numbers of a volume, segments of DICOM results");
  command
      .add_option("--image", options->images,
                  "Another image whose values are measured inside, resampled to the voxels of INPUT; may "
                  "be\nrepeated")
      ->allow_extra_args(false)
      ->type_name("INPUT");
  command
      .add_option(
          "--before", options->before,
          "What an earlier run wrote with --json: regions of the same name are compared, and the sum\nof "
          "their diameters in slices")
      ->type_name("FILE");
  command
      .add_option("--report", options->report,
                  "A DICOM structured report (TID 1500) about the segments of a DICOM segmentation")
      ->type_name("FILE.dcm");
  command
      .add_option("--key-images", options->key_images,
                  "A DICOM key object selection: of each region the image in which it is largest")
      ->type_name("FILE.dcm");
  command
      .add_option("--presentation", options->presentation,
                  "A DICOM presentation state of the key images: the study's window, and outlines")
      ->type_name("FILE.dcm");
  command.add_option("--note", options->note, "What the key object selection says of its images")
      ->capture_default_str()
      ->type_name("TEXT");
  command.add_option("--csv", options->csv, "A table, a line for each region and image")
      ->type_name("FILE.csv");
}

}  // namespace tidemark::cli
