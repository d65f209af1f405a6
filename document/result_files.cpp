#include "document/result_files.h"

#include <algorithm>

#include "document/label_segments.h"
#include "document/measure_codes.h"
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "solver/inside_region.h"

namespace tidemark::document {
namespace {

Result<imaging::Segments> surface_segments(const SessionContents& contents) {
  imaging::Segments segments =
      imaging::segments_of(solver::inside_region(*contents.phi), contents.geometry, kSurfaceSegment);
  if (segments.list.front().slices.empty()) {
    return fail(ErrorKind::usage, "nothing is inside the surface");
  }
  segments.list.front().phi = std::make_shared<const Volume>(contents.phi->to_volume());
  return segments;
}

}  // namespace

Result<imaging::Segments> result_segments(const SessionContents& contents, ResultContent content) {
  if (content == ResultContent::surface) return surface_segments(contents);
  std::vector<Label> wanted = contents.labels;
  if (content == ResultContent::visible_labels) {
    std::erase_if(wanted, [](const Label& label) { return !label.visible; });
  }
  const PagedBytes none(contents.geometry.size);
  imaging::Segments segments =
      segments_of(contents.geometry, wanted, contents.label_voxels ? *contents.label_voxels : none);
  std::erase_if(segments.list, [](const imaging::Segment& segment) { return segment.slices.empty(); });
  if (segments.list.empty()) return fail(ErrorKind::usage, "no voxel has one of these labels");
  return segments;
}

Status write_result(const imaging::Segments& segments, imaging::ResultForm form, imaging::SourceFiles source,
                    const std::filesystem::path& file, const Progress& progress) {
  return form == imaging::ResultForm::segmentation
             ? imaging::write_segmentation(segments, source, file, progress)
             : imaging::write_structure_set(segments, source, file, progress);
}

Status write_measurements(const imaging::Segments& segments, const std::shared_ptr<const Volume>& volume,
                          const std::filesystem::path& segmentation, const std::filesystem::path& file,
                          const Progress& progress) {
  std::vector<imaging::ReportedSegment> reported;
  for (std::size_t n = 0; n < segments.list.size(); ++n) {
    if (progress.cancelled()) return cancelled_error();
    progress(static_cast<double>(n) / static_cast<double>(segments.list.size()), "measuring");
    const auto measures = measure(imaging::region_of(segments.list[n], segments.geometry), segments.geometry,
                                  {{volume->description, volume}});
    if (!measures) return pass_on(measures);
    reported.push_back({n, coded(*measures, volume->modality)});
  }
  return imaging::write_measurement_report(segmentation, reported, volume->modality, file);
}

Result<imaging::Segments> read_labels(const std::filesystem::path& file, const Geometry* grid,
                                      const Progress& progress) {
  progress(0.0, "reading labels");
  if (imaging::result_form_of(file)) return imaging::read_result(file, grid);
  const auto volume = imaging::load_volume(file, {}, progress);
  if (!volume) return pass_on(volume);
  const auto values = grid != nullptr ? imaging::onto_grid(*volume, *grid, file.string())
                                      : Result<std::vector<float>>(volume->values());
  if (!values) return pass_on(values);
  auto segments =
      imaging::segments_of_numbers(grid != nullptr ? *grid : volume->geometry, *values, file.string());
  if (segments) segments->changes = volume->changes;
  return segments;
}

}  // namespace tidemark::document
