#include "document/session_contents.h"

#include <algorithm>
#include <utility>

#include "document/checksum.h"
#include "document/session_file.h"

namespace tidemark::document {
namespace {

bool fits_grid(const Geometry& a, const Geometry& b) {
  constexpr double kTolerance = 0.1;  // of the smallest spacing
  const glm::dvec3 spacing = a.spacing_mm;
  return a.size == b.size && same_grid(a, b, kTolerance * std::min({spacing.x, spacing.y, spacing.z}));
}

}  // namespace

Result<SessionContents> snapshot_of(Case& document) {
  auto phi = document.level_set().checkpoint();
  if (!phi) return pass_on(phi);
  SessionContents contents;
  contents.origin = document.origin();
  contents.geometry = document.volume()->geometry;
  contents.recipe = document.level_set().recipe();
  contents.wanted_drive = document.level_set().wanted_drive();
  RecipeSource& source = contents.recipe.source;
  source.series_uid = contents.origin.series_uid;
  source.checksum = contents.origin.checksum;
  source.policy = contents.origin.policy;
  contents.phi = std::move(*phi);
  contents.labels = document.labels().list();
  if (const PagedBytes& voxels = document.labels().voxels(); !voxels.empty())
    contents.label_voxels = std::make_shared<const PagedBytes>(voxels);
  contents.curve = document.level_set().curve();
  contents.view_state = document.view_state;
  contents.history = document.level_set().saved_history();
  return contents;
}

VolumeMatch match(const SessionContents& contents, const Volume& volume) {
  if (!fits_grid(contents.geometry, volume.geometry)) return VolumeMatch::other_grid;
  return contents.origin.checksum == checksum_of(volume) ? VolumeMatch::same : VolumeMatch::other_voxels;
}

Result<std::unique_ptr<Case>> restore_case(const SessionContents& contents,
                                           std::shared_ptr<const Volume> volume, solver::ExecutorKind kind,
                                           const solver::ExecutorOptions& options) {
  if (!fits_grid(contents.geometry, volume->geometry)) {
    const Index3 then = contents.geometry.size;
    const Index3 now = volume->geometry.size;
    return fail(
        ErrorKind::input,
        "the session was saved for a grid of {} x {} x {} voxels that is not the volume's of {} x {} x {}",
        then.x, then.y, then.z, now.x, now.y, now.z);
  }
  auto made =
      Case::create(std::move(volume), contents.origin, contents.recipe.final_parameters(), kind, options);
  if (!made) return made;
  Case& document = **made;
  Status restored =
      document.level_set().resume_from(contents.recipe, contents.phi, contents.curve, contents.wanted_drive);
  if (!restored) return pass_on(restored);
  const PagedBytes none(contents.geometry.size);
  restored = document.labels().assign(contents.labels, contents.label_voxels ? *contents.label_voxels : none);
  if (!restored) return pass_on(restored);
  document.view_state = contents.view_state;
  if (!contents.history.empty()) document.level_set().restore_history(contents.history);
  document.mark_saved();
  return made;
}

Status save_session(Case& document, const std::filesystem::path& file) {
  TIDEMARK_TRY(document.level_set().end_run());
  const auto contents = snapshot_of(document);
  if (!contents) return pass_on(contents);
  TIDEMARK_TRY(write_session(*contents, file));
  document.mark_saved();
  return {};
}

}  // namespace tidemark::document
