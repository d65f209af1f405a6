// tidemark-cli convert: a volume, a mask, labels or a level set to another format.
#include <algorithm>
#include <memory>

#include "app/cli/conversion.h"
#include "app/cli/program.h"
#include "app/cli/report.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kConvert{
    "convert", "Writes a volume, mask or level set in other formats",
    "Writes INPUT in other formats. A volume keeps its values (HU for CT), grid and place in the patient "
    "(mm).\n"
    "A mask, which is a volume of 0 and 1 or one read with --mask, can also become a surface in patient mm\n"
    "(LPS), a DICOM segmentation, an RT structure set or an OpenVDB level set; so can labels, a saved level\n"
    "set, and what DICOM segmentations and RT structure sets hold. Overlapping segments become one volume "
    "of\n"
    "numbers with the later one on top.",
    "  tidemark-cli convert study/ --out study.nii.gz                    a DICOM series to NIfTI\n"
    "  tidemark-cli convert brain.nrrd --out brain.mha --out brain.nii   several formats at once\n"
    "  tidemark-cli convert labels.nii.gz --mask --out surface.stl       all labels as one surface\n"
    "  tidemark-cli convert labels.nii.gz --labels --out-each organs.stl a surface for each label\n"
    "  tidemark-cli convert labels.nii.gz --labels --source study/ --label Liver,liver --label Mass,tumour "
    "\\\n"
    "      --out seg.dcm --rtstruct contours.dcm                         for a PACS and a planning system\n"
    "  tidemark-cli convert contours.dcm --source study/ --out labels.nii.gz\n"};

struct ConvertOptions {
  ConversionOptions conversion;
  bool as_mask = false, as_labels = false, as_phi = false;
  std::vector<std::string> out;
  std::string rtstruct, each;
};

Status check(const ConvertOptions& options, Outputs& outputs, const Progress& progress) {
  if (int{options.as_mask} + int{options.as_labels} + int{options.as_phi} > 1) {
    return fail(ErrorKind::usage, "only one of --mask, --labels and --phi can be given");
  }
  if (options.out.empty() && options.rtstruct.empty() && options.each.empty()) {
    return fail(ErrorKind::usage, "--out, --out-each or --rtstruct is needed");
  }
  if (!options.each.empty() && !imaging::is_writable_mesh_file(options.each)) {
    return fail(ErrorKind::usage, "--out-each {}: the name must end in one of .stl .ply .obj", options.each);
  }
  for (const std::string& file : options.out) {
    Status good = outputs.announce(
        "--out", file, {FileForm::volume, FileForm::mesh, FileForm::segmentation, FileForm::level_set});
    if (!good) return good;
  }
  if (!options.rtstruct.empty()) {
    TIDEMARK_TRY(outputs.announce_dicom("--rtstruct", options.rtstruct));
  }
  if (!options.conversion.source.empty()) {
    TIDEMARK_TRY(spare_study(outputs, options.conversion.source_study(), progress));
  }
  return spare_study(outputs, options.conversion.input(), progress);
}

Status write_all(const ConvertOptions& options, Conversion& conversion, Outputs& outputs, Console& console) {
  for (const std::string& file : options.out) {
    if (console.interrupted()) return cancelled_error();
    const auto write = [&](const std::filesystem::path& name) {
      return conversion.write(name, form_of(file), console.progress());
    };
    TIDEMARK_TRY(outputs.stage(file, write));
  }
  if (!options.each.empty()) {
    TIDEMARK_TRY(conversion.write_each(options.each, console.progress(), outputs));
  }
  if (options.rtstruct.empty()) return {};
  return outputs.stage(options.rtstruct, [&](const std::filesystem::path& name) {
    return conversion.write_contours(name, console.progress());
  });
}

void say(const ConvertOptions& options, const Conversion& conversion, Console& console) {
  for (const std::string& change : conversion.changes()) console.say("Changed    {}", change);
  for (const imaging::Segment& segment : conversion.segments().list) {
    console.say("Segment    {}: {} voxels, {:.3f} ml", segment.name, segment.count(),
                static_cast<double>(segment.count()) * conversion.geometry().voxel_volume_ml());
  }
  if (const auto& mesh = conversion.mesh()) {
    console.say("Surface    {} triangles, {:.3f} ml, {:.1f} mm^2", mesh->triangles.size(),
                imaging::mesh_volume_ml(*mesh), imaging::mesh_area_mm2(*mesh));
  }
  for (const std::string& file : options.out) console.say("Wrote      {}", file);
  for (const auto& file : conversion.each()) console.say("Wrote      {}", file.string());
  if (!options.rtstruct.empty()) console.say("Wrote      {}", options.rtstruct);
  const bool any_dicom = !options.rtstruct.empty() ||
                         std::any_of(options.out.begin(), options.out.end(), [](const std::string& file) {
                           return form_of(file) == FileForm::segmentation;
                         });
  if (any_dicom && !conversion.has_source()) console.say("           {} (--source)", kAnonymousStudy);
}

Json to_json(const ConvertOptions& options, const Conversion& conversion) {
  Json object = grid_json(conversion.geometry());
  object["scalar"] = conversion.scalar_name();
  object["changes"] = conversion.changes();
  object["segments"] = Json::array();
  for (const imaging::Segment& segment : conversion.segments().list) {
    object["segments"].push_back({{"name", segment.name}, {"voxels", segment.count()}});
  }
  object["out"] = options.out;
  for (const auto& file : conversion.each()) object["out_each"].push_back(file.string());
  if (!options.rtstruct.empty()) object["rtstruct"] = options.rtstruct;
  return object;
}

Status run(Program& program, const ConvertOptions& options) {
  Console& console = program.console;
  Outputs outputs;
  TIDEMARK_TRY(check(options, outputs, console.progress()));
  ConversionOptions chosen = options.conversion;
  chosen.kind = options.as_mask     ? InputKind::mask
                : options.as_labels ? InputKind::labels
                : options.as_phi    ? InputKind::level_set
                                    : InputKind::volume;
  auto conversion = Conversion::load(std::move(chosen), console.progress());
  if (!conversion) return pass_on(conversion);
  TIDEMARK_TRY(write_all(options, *conversion, outputs, console));
  TIDEMARK_TRY(outputs.commit(console.progress()));
  say(options, *conversion, console);
  console.result(to_json(options, *conversion));
  return {};
}

void add_options(CLI::App& command, ConvertOptions& options) {
  ConversionOptions& conversion = options.conversion;
  command
      .add_option("INPUT", conversion.study.path,
                  "A DICOM folder, file or DICOMDIR, a volume file, a zip archive of these, a DICOM\n"
                  "segmentation or an RT structure set")
      ->required()
      ->type_name("");
  command
      .add_option(
          "--out", options.out,
          ".nii .nii.gz .nrrd .mha: a volume, mask or labels;\n.stl .ply .obj: the surface;\n.dcm: a DICOM "
          "segmentation (SEG);\n.vdb: an OpenVDB level set, < 0 inside, in patient mm (LPS);\nmay be "
          "repeated")
      ->allow_extra_args(false)
      ->type_name("FILE");
  command
      .add_option("--out-each", options.each,
                  ".stl .ply .obj: the surface of each segment in a file of its own, whose name ends in\nthe "
                  "segment's: organs.stl gives organs-Liver.stl")
      ->type_name("FILE");
  command.add_option("--rtstruct", options.rtstruct, "The contours in each slice as RT structure set")
      ->type_name("FILE.dcm");
  command
      .add_option(
          "--source", conversion.source,
          "The study that INPUT was made of: results are brought onto its grid and belong to its\npatient; "
          "an RT structure set cannot be read without")
      ->type_name("STUDY");
  add_series_options(command, conversion.study, "INPUT, or the study of --source,");
  command.add_flag("--mask", options.as_mask, "INPUT is a mask: every voxel that is not 0 is inside");
  command.add_flag("--labels", options.as_labels,
                   "INPUT holds labels: each number from 1 to 255 is a segment");
  command.add_flag("--phi", options.as_phi, "INPUT is a level set saved with --out-phi of segment");
  add_labels(command, conversion.labels);
}

}  // namespace

void add_convert(CLI::App& app, Program& program) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App& command =
      add_command(app, program, kConvert, [&program, options] { return run(program, *options); });
  add_options(command, *options);
}

}  // namespace tidemark::cli
