// Starts that lie in files.
#pragma once

#include <QString>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.h"
#include "document/start.h"

namespace tidemark::ui {

enum class StartFile { mask, level_set };

struct StartRequest {
  StartFile kind = StartFile::mask;
  std::filesystem::path path;
  Geometry grid;                       // of the study
  std::string frame_of_reference_uid;  // of the study; empty where it is not known
  double band = 2.5;                   // W of the level set that is to begin
  std::optional<double> within_mm;     // of a mask that is refined
  int levels = 1;
};

// A mask (voxels other than 0 are inside), or a saved phi, on the grid of the study; the file's axes may be
// in another order or run the other way. Fails (ErrorKind::input) when the file cannot be read or has other
// voxels.
struct LoadedStart {
  document::Start start;
  QString name;                      // of the file
  std::vector<std::string> remarks;  // on what was read, one sentence each
};
Result<LoadedStart> load_start(const StartRequest& request, const Progress& progress = {});

}  // namespace tidemark::ui
