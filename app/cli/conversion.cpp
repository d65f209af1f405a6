#include "app/cli/conversion.h"

#include <algorithm>
#include <cmath>

#include "document/segment_meshes.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "solver/distance_transform.h"

namespace tidemark::cli {
namespace {

namespace fs = std::filesystem;

bool holds_only_zero_and_one(const Volume& volume) {
  const std::int64_t count = volume.geometry.voxel_count();
  for (std::int64_t offset = 0; offset < count; ++offset) {
    const float value = volume.value(offset);
    if (value != 0.0F && value != 1.0F) return false;
  }
  return true;
}

// As int16 where that holds all of them: labels stay whole numbers in every format.
Volume::Voxels as_stored(std::vector<float> values) {
  const bool fits = std::all_of(values.begin(), values.end(), [](float value) {
    return value == std::floor(value) && value >= -32768.0F && value <= 32767.0F;
  });
  if (!fits) return values;
  return std::vector<std::int16_t>(values.begin(), values.end());
}

}  // namespace

StudyInput ConversionOptions::input() const {
  StudyInput input = study;
  if (!source.empty()) input.series.clear();
  return input;
}

StudyInput ConversionOptions::source_study() const {
  StudyInput study_of_source = study;
  study_of_source.path = source;
  return study_of_source;
}

Result<Conversion> Conversion::load(ConversionOptions options, const Progress& progress) {
  Conversion conversion(std::move(options));
  TIDEMARK_TRY(conversion.load_source(progress));
  const bool is_result = imaging::result_form_of(conversion.options_.study.path).has_value();
  TIDEMARK_TRY(is_result ? conversion.load_result(progress) : conversion.load_volume(progress));
  const std::size_t given = conversion.options_.labels.size();
  if (given > conversion.segments_.list.size()) {
    return fail(ErrorKind::usage, "--label was given {} times for {} segments", given,
                conversion.segments_.list.size());
  }
  for (std::size_t n = 0; n < given; ++n) conversion.options_.labels[n].apply(conversion.segments_.list[n]);
  return conversion;
}

Status Conversion::load_source(const Progress& progress) {
  if (options_.source.empty()) return {};
  const auto chosen = find_study(options_.source_study(), progress);
  if (!chosen) return pass_on(chosen);
  grid_ = chosen->series.geometry;
  frame_of_reference_uid_ = chosen->series.frame_of_reference_uid;
  source_files_ = imaging::dicom_files_of(chosen->series);
  source_archive_ = chosen->series.archive;
  return {};
}

Status Conversion::load_result(const Progress& progress) {
  if (options_.kind == InputKind::level_set) {
    return fail(ErrorKind::usage, "{}: holds segments, not a level set", options_.study.path);
  }
  if (progress.cancelled()) return cancelled_error();
  auto segments = imaging::read_result(options_.study.path, grid_ ? &*grid_ : nullptr);
  if (!segments) return pass_on(segments);
  segments_ = std::move(*segments);
  if (auto remark = imaging::frame_remark(segments_.frames_of_reference, frame_of_reference_uid_))
    segments_.changes.push_back(std::move(*remark));
  return {};
}

Status Conversion::load_volume(const Progress& progress) {
  auto loaded = load_study(options_.input(), progress);
  if (!loaded) return pass_on(loaded);
  Volume& volume = loaded->volume;
  if (grid_) {
    auto values = imaging::onto_grid(volume, *grid_, options_.study.path);
    if (!values) return pass_on(values);
    volume.geometry = *grid_;
    volume.voxels = as_stored(std::move(*values));
    volume.slope = 1.0;
    volume.intercept = 0.0;
  }
  volume_ = std::move(volume);
  segments_.geometry = volume_->geometry;
  segments_.changes = volume_->changes;
  return split();
}

// The volume as segments, if it is a mask or a label map.
Status Conversion::split() {
  const bool is_mask = options_.kind == InputKind::mask ||
                       (options_.kind == InputKind::volume && holds_only_zero_and_one(*volume_));
  if (options_.kind == InputKind::volume && !is_mask) return {};
  std::vector<float> values = volume_->values();
  if (options_.kind == InputKind::labels) {
    auto labels = imaging::segments_of_numbers(segments_.geometry, values, options_.study.path);
    if (!labels) return pass_on(labels);
    segments_.list = std::move(labels->list);
    return {};
  }
  std::vector<std::uint8_t> inside(values.size());
  const bool is_phi = options_.kind == InputKind::level_set;
  std::transform(values.begin(), values.end(), inside.begin(),
                 [&](float value) { return std::uint8_t(is_phi ? value > 0.0F : value != 0.0F); });
  imaging::Segment segment;
  segment.name = "Segment";
  segment.slices = imaging::slices_of(segments_.geometry, inside);
  if (is_phi) {
    auto phi = std::make_shared<Volume>();
    phi->geometry = segments_.geometry;
    phi->voxels = std::move(values);
    segment.phi = std::move(phi);
  }
  segments_.list.push_back(std::move(segment));
  return {};
}

const char* Conversion::scalar_name() const {
  return volume_ ? volume_->scalar_name() : "uint8";
}

Status Conversion::require_segments() const {
  if (!is_plain()) return {};
  return fail(ErrorKind::usage,
              "{}: is no mask (it holds values other than 0 and 1), so it has no surface and no segments; "
              "--mask takes "
              "every voxel that is not 0 as inside, --labels each number as a segment",
              options_.study.path);
}

// The volume itself, or its inside: 1, or the number of the segment.
Status Conversion::write_values(const fs::path& file) {
  if (!geometry().oriented && !imaging::can_leave_sides_open(file, geometry())) {
    segments_.changes.emplace_back(
        "the output names sides of the patient, which nobody knows of the input; a .nrrd file names none");
  }
  if (volume_ && options_.kind != InputKind::mask) return imaging::write_volume_file(*volume_, file);
  if (options_.kind == InputKind::mask) return imaging::write_mask_file(imaging::union_of(segments_), file);
  auto map = imaging::label_map_of(segments_);
  if (!map) return pass_on(map);
  if (map->overlaps > 0) {
    segments_.changes.push_back(
        fmt::format("{} voxels are in several segments and have the number of the last one", map->overlaps));
  }
  return imaging::write_mask_file({geometry(), std::move(map->voxels)}, file);
}

Status Conversion::write_surface(const fs::path& file) {
  if (!mesh_) {
    const auto& phi = segments_.list.front().phi;
    auto surface = phi ? imaging::extract_surface(*phi) : document::mesh_of(imaging::union_of(segments_));
    if (!surface) return pass_on(surface);
    mesh_ = std::move(*surface);
  }
  return imaging::write_mesh(*mesh_, file);
}

Status Conversion::write(const fs::path& file, FileForm form, const Progress& progress) {
  if (form == FileForm::volume) return write_values(file);
  TIDEMARK_TRY(require_segments());
  if (form == FileForm::mesh) return write_surface(file);
  if (form == FileForm::segmentation)
    return imaging::write_segmentation(segments_, source_files_, file, progress);
  if (const auto& phi = segments_.list.front().phi) {
    const auto [low, high] = phi->range();
    return imaging::write_level_set(*phi, std::max(std::abs(low), std::abs(high)), file);
  }
  const double band = document::surface_band(geometry());
  return imaging::write_level_set(solver::distance_transform(imaging::union_of(segments_), band).to_volume(),
                                  band, file);
}

Status Conversion::write_each(const fs::path& like, const Progress& progress, Outputs& outputs) {
  TIDEMARK_TRY(require_segments());
  std::vector<std::string> names;
  for (const imaging::Segment& segment : segments_.list) names.push_back(segment.name);
  each_ = document::mesh_files(names, like);
  for (const fs::path& file : each_) {
    TIDEMARK_TRY(outputs.announce("--out-each", file, {FileForm::mesh}));
  }
  for (std::size_t n = 0; n < each_.size(); ++n) {
    if (progress.cancelled()) return cancelled_error();
    const auto mesh = document::mesh_of(geometry(), segments_.list[n]);
    if (!mesh) return pass_on(mesh);
    TIDEMARK_TRY(
        outputs.stage(each_[n], [&](const fs::path& name) { return imaging::write_mesh(*mesh, name); }));
  }
  return {};
}

Status Conversion::write_contours(const fs::path& file, const Progress& progress) {
  TIDEMARK_TRY(require_segments());
  return imaging::write_structure_set(segments_, source_files_, file, progress);
}

}  // namespace tidemark::cli
