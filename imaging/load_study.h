// The one way into the program: a DICOM folder, a DICOM file, a DICOMDIR, a volume file, a picture or a zip
// archive of these, by its path.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/volume.h"
#include "imaging/audit/event.h"
#include "imaging/series.h"

namespace tidemark::imaging {

// Lists the series under `path` (a folder is searched recursively). Fails (ErrorKind::input) when the path
// does not exist or holds nothing that looks like an image; a series that cannot be loaded is listed with
// its reason. Pictures in a folder count where it holds nothing else: beside a study they are previews of it.
// The policy is for slices that make no regular grid.
Result<Catalogue> find_series(const std::filesystem::path& path, const Progress& progress = {},
                              const GridPolicy& policy = {});

// The same series on the grid that another policy makes.
[[nodiscard]] Series by_policy(Series series, const GridPolicy& policy);
// The series of that UID (any, where it is empty) that could be loaded if gaps were filled; null where there
// is none, or one can be loaded without that.
[[nodiscard]] const Series* find_fillable(const Catalogue& catalogue, const std::string& uid);

// The series of that UID, whether they can be loaded or not. An empty one means all; but where there is any
// of several images, one of a single image (a scout) is only meant by its UID.
[[nodiscard]] std::vector<const Series*> meant_series(const Catalogue& catalogue, const std::string& uid);

// The series `uid` out of find_series(path); an empty uid takes the only loadable one of meant_series(), or
// the one with the most voxels. The UID of a series that holds several volumes, without the number of one of
// them, takes the largest. Fails (ErrorKind::input) with the reason why none can be loaded, or with the UIDs
// to choose from.
struct ChosenSeries {
  Series series;
  std::vector<std::string> remarks;  // about the choice, for the user
};
Result<ChosenSeries> choose_series(const Catalogue& catalogue, const std::string& uid,
                                   const std::filesystem::path& path);

// The reason why the series under the path cannot be loaded: one line that begins with the path and names no
// file twice.
[[nodiscard]] std::string reason_under(const std::filesystem::path& path, const Series& series);

// Loads the series that choose_series() takes; Volume::changes has a sentence where there were others. The
// volume is finite everywhere. Fails (ErrorKind::input) naming the file and the field at fault.
Result<Volume> load_volume(const std::filesystem::path& path, const std::string& uid = {},
                           const Progress& progress = {}, const GridPolicy& policy = {});

// The same with the series that it was made of.
struct LoadedSeries {
  Series series;
  Volume volume;
};
Result<LoadedSeries> load_with_series(const std::filesystem::path& path, const std::string& uid = {},
                                      const Progress& progress = {}, const GridPolicy& policy = {});

// The series' files in slice order when it is a DICOM series; none of a volume file.
[[nodiscard]] std::vector<std::filesystem::path> dicom_files_of(const Series& series);

// Whose images they are, for audit messages; nobody's of a volume file.
[[nodiscard]] AuditedStudy audited_study(const Series& series);

// The same of a loadable series that find_series() gave. Audited (AuditEvent::Kind::accessed) where it is
// DICOM.
Result<Volume> load_series(const Series& series, const Progress& progress = {});
// The remarks come first in Volume::changes.
Result<Volume> load_series(const ChosenSeries& chosen, const Progress& progress = {});

// The slice `k` of a loadable series, on its place in the patient: of a DICOM series only the files that make
// it are read. A volume file is read whole.
Result<Volume> load_slice(const Series& series, std::int64_t k, const Progress& progress = {});

// Loads a mask: every voxel that is not 0 is inside.
Result<Mask> load_mask(const std::filesystem::path& path, const Progress& progress = {});

}  // namespace tidemark::imaging
