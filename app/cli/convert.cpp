// tidemark-cli convert: a volume or a mask to another format.
#include <algorithm>
#include <memory>

#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "app/cli/report.h"
#include "imaging/files/volume_file.h"
#include "imaging/study.h"
#include "imaging/surface/surface.h"
#include "solver/distance_transform.h"

namespace tidemark::cli {
namespace {

constexpr const char* kSummary = "Writes a volume or mask in other formats";
constexpr const char* kDescription =
    "Writes INPUT in other formats. A volume keeps its values (HU for CT), grid and place in the patient "
    "(mm).\n"
    "A mask, which is a volume of 0 and 1 or one read with --mask, can also become a surface in patient mm\n"
    "(LPS).";

constexpr const char* kExamples =
    "  tidemark-cli convert study/ --out study.nii.gz                    a DICOM series to NIfTI\n"
    "  tidemark-cli convert brain.nrrd --out brain.mha --out brain.nii   several formats at once\n"
    "  tidemark-cli convert labels.nii.gz --mask --out surface.stl       all labels as one surface\n";

struct ConvertOptions {
  std::string input;
  std::string series;
  std::vector<std::string> out;
  bool as_mask = false;
};

bool holds_only_zero_and_one(const Volume& volume) {
  const std::int64_t count = volume.geometry.voxel_count();
  for (std::int64_t offset = 0; offset < count; ++offset) {
    const float value = volume.value(offset);
    if (value != 0.0F && value != 1.0F) return false;
  }
  return true;
}

Mask mask_of(const Volume& volume) {
  Mask mask{volume.geometry,
            std::vector<std::uint8_t>(static_cast<std::size_t>(volume.geometry.voxel_count()))};
  for (std::size_t offset = 0; offset < mask.voxels.size(); ++offset) {
    mask.voxels[offset] = volume.value(static_cast<std::int64_t>(offset)) != 0.0F ? 1 : 0;
  }
  return mask;
}

// Wide enough for the surface to see its neighbours along the axis with the thickest voxels.
double surface_band(const Geometry& geometry) {
  const glm::dvec3 h = geometry.spacing_mm;
  return std::max(2.5, 2.0 * std::max({h.x, h.y, h.z}) / std::min({h.x, h.y, h.z}));
}

Result<Mesh> surface_of(const Mask& mask) {
  return extract_surface(distance_transform(mask, surface_band(mask.geometry)).to_volume());
}

Status check(const ConvertOptions& options, Outputs& outputs) {
  for (const std::string& file : options.out) {
    if (Status good = outputs.announce("--out", file, {FileForm::volume, FileForm::mesh}); !good) return good;
  }
  return outputs.spare(options.input);
}

Status write_all(const ConvertOptions& options, const Volume& volume, Outputs& outputs, Console& console) {
  const bool wants_surface = std::any_of(options.out.begin(), options.out.end(),
                                         [](const std::string& f) { return form_of(f) == FileForm::mesh; });
  std::optional<Mask> mask;
  std::optional<Mesh> mesh;
  if (options.as_mask || wants_surface) mask = mask_of(volume);
  if (wants_surface) {
    if (!options.as_mask && !holds_only_zero_and_one(volume)) {
      return fail(
          ErrorKind::usage,
          "{}: is no mask (it holds values other than 0 and 1), so it has no surface; --mask takes every "
          "voxel that is not 0 as inside",
          options.input);
    }
    auto surface = surface_of(*mask);
    if (!surface) return pass_on(surface);
    mesh = std::move(*surface);
  }
  for (const std::string& file : options.out) {
    if (console.interrupted()) return cancelled_error();
    const auto write = [&](const std::filesystem::path& name) {
      if (form_of(file) == FileForm::mesh) return write_mesh(*mesh, name);
      return options.as_mask ? write_mask_file(*mask, name) : write_volume_file(volume, name);
    };
    if (Status staged = outputs.stage(file, write); !staged) return staged;
  }
  if (mesh) {
    console.say("Surface    {} triangles, {:.3f} ml, {:.1f} mm^2", mesh->triangles.size(),
                mesh_volume_ml(*mesh), mesh_area_mm2(*mesh));
  }
  return {};
}

Status run(Program& program, const ConvertOptions& options) {
  Console& console = program.console;
  Outputs outputs;
  if (Status good = check(options, outputs); !good) return good;
  const auto volume = load_volume(options.input, options.series, console.progress());
  if (!volume) return tl::unexpected<Error>(volume.error());
  if (Status written = write_all(options, *volume, outputs, console); !written) return written;
  if (console.interrupted()) return cancelled_error();
  if (Status done = outputs.commit(); !done) return done;
  for (const std::string& change : volume->changes) console.say("Changed    {}", change);
  for (const std::string& file : options.out) console.say("Wrote      {}", file);

  Json object = grid_json(volume->geometry);
  object["scalar"] = volume->scalar_name();
  object["changes"] = volume->changes;
  object["out"] = options.out;
  console.result(object);
  return {};
}

}  // namespace

void add_convert(CLI::App& app, Program& program) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App& command = add_command(app, program, {"convert", kSummary, kDescription, kExamples},
                                  [&program, options] { return run(program, *options); });
  command.add_option("INPUT", options->input, "A DICOM folder or file, or a volume file")
      ->required()
      ->type_name("");
  command
      .add_option("--out", options->out,
                  ".nii .nii.gz .nrrd .mha: a volume or mask;\n.stl .ply .obj: the surface of a mask; may be "
                  "repeated")
      ->required()
      ->allow_extra_args(false)
      ->type_name("FILE");
  command.add_option("--series", options->series, "The series to load when INPUT holds several (see info)")
      ->type_name("UID");
  command.add_flag("--mask", options->as_mask, "INPUT is a mask: every voxel that is not 0 is inside");
}

}  // namespace tidemark::cli
