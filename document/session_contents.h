// The contents of a session file as values, for writing on any thread while the case goes on.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/bit_mask.h"
#include "document/case.h"
#include "document/saved_history.h"

namespace tidemark::document {

// The volume's voxels are not part of it: the origin finds them again, or makes them again (phantoms).
struct SessionContents {
  StudyOrigin origin;
  Geometry geometry;                          // of the volume
  Recipe recipe;                              // with it, parameters, step number and smoothing
  std::shared_ptr<const Drive> wanted_drive;  // beside the recipe, see LevelSet::wanted_drive()
  std::shared_ptr<const solver::Field> phi;
  std::vector<Label> labels;
  std::shared_ptr<const PagedBytes> label_voxels;  // null: no voxel has a label
  std::shared_ptr<const BitMask> truth;  // the known answer, where it is not the study's own; null: none
  Curve curve;
  std::string view_state;
  SavedHistory history;  // empty: only the present state is known
  // Further images of the case, whether or not the speed function uses them. As read from a file they have no
  // voxels, and neither have the images and maps of drives: see find_images().
  std::vector<std::shared_ptr<const CaseImage>> images;
};

// The case's present contents, taken on its thread. A checkpoint of its level set.
Result<SessionContents> snapshot_of(Case& document);
// Closes the open change, writes the case, and marks it as saved.
Status save_session(Case& document, const std::filesystem::path& file);

// The comparison of a volume with the saved one.
enum class VolumeMatch {
  same,
  other_voxels,  // on the same grid: ask before going on with it
  other_grid,    // nothing fits
};
VolumeMatch match(const SessionContents& contents, const Volume& volume);

// A case as it was saved. Fails (ErrorKind::input) when the volume has another grid.
Result<std::unique_ptr<Case>> restore_case(const SessionContents& contents,
                                           std::shared_ptr<const Volume> volume, solver::ExecutorKind kind,
                                           const solver::ExecutorOptions& options);

}  // namespace tidemark::document
