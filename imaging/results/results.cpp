#include "imaging/results/results.h"

#include <algorithm>

#include "imaging/load_study.h"
#include "imaging/onto_grid.h"

namespace tidemark::imaging {

Result<Segments> read_result(const std::filesystem::path& file, const Geometry* grid) {
  const auto form = result_form_of(file);
  if (form == ResultForm::segmentation) return read_segmentation(file, grid);
  if (form == ResultForm::structure_set && grid != nullptr) return read_structure_set(file, *grid);
  if (form == ResultForm::structure_set) {
    return fail(ErrorKind::input,
                "{}: an RT structure set has no voxels of its own: it needs the study it was made of",
                file.string());
  }
  return fail(ErrorKind::input, "{}: is neither a DICOM segmentation nor an RT structure set", file.string());
}

std::optional<std::string> frame_remark(std::span<const std::string> named, const std::string& of_study) {
  const auto differs = [&](const std::string& frame) { return !frame.empty() && frame != of_study; };
  if (of_study.empty() || std::none_of(named.begin(), named.end(), differs)) return std::nullopt;
  return "it names another frame of reference than the study: its places may not be the study's";
}

Result<LoadedMask> load_any_mask(const std::filesystem::path& file, const Geometry* grid,
                                 const Progress& progress) {
  if (result_form_of(file)) {
    auto segments = read_result(file, grid);
    if (!segments) return pass_on(segments);
    return LoadedMask{union_of(*segments), std::move(segments->changes),
                      std::move(segments->frames_of_reference)};
  }
  auto mask = load_mask(file, progress);
  if (mask && grid != nullptr) mask = onto_grid(std::move(*mask), *grid, file.string());
  if (!mask) return pass_on(mask);
  return LoadedMask{std::move(*mask), {}};
}

}  // namespace tidemark::imaging
