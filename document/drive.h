// The drive of a case's level set: speed functions with all that they are made from, walls and anchors.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/volume.h"
#include "document/case_image.h"
#include "solver/parameters.h"
#include "solver/speed/constraints.h"
#include "solver/speed/speed_function.h"
#include "solver/speed/speed_setting.h"
#include "solver/speed/strokes.h"

namespace tidemark::document {

// A map of D or of a probability that was made elsewhere. One that a recipe or a session names has no volume
// until its file is read.
struct SpeedMap {
  std::string name;
  std::string checksum;
  std::shared_ptr<const Volume> volume;  // on the case's grid
  std::filesystem::path path;            // where it is found again; empty: not known
  std::string frame_of_reference_uid = {};
};

// A value: parts are shared, and never change.
struct Drive {
  solver::SpeedSetting setting;
  std::vector<std::shared_ptr<const CaseImage>> images;
  std::shared_ptr<const solver::Strokes> strokes;          // null: none
  std::shared_ptr<const SpeedMap> map;                     // null: none
  std::shared_ptr<const solver::Constraints> constraints;  // null: none

  // Parts are compared by their address.
  bool operator==(const Drive&) const = default;
};

// The drive, and of null what executors do without any; and the other way round.
[[nodiscard]] inline Drive value_of(const std::shared_ptr<const Drive>& drive) {
  return drive == nullptr ? Drive() : *drive;
}
[[nodiscard]] std::shared_ptr<const Drive> shared(const Drive& drive);
// Of strokes, walls and anchors in memory.
[[nodiscard]] std::int64_t bytes_of(const Drive& drive);
// What drives and holds a level set, without all that it is made from.
struct DriveSummary {
  solver::SpeedSetting setting;
  bool has_walls = false;
  bool has_anchors = false;

  bool operator==(const DriveSummary&) const = default;
};
[[nodiscard]] DriveSummary summary_of(const Drive& drive);
// Whether executors are as without any drive: the tent alone, and nothing that holds the surface.
[[nodiscard]] bool is_plain(const Drive& drive);
// Whether a tent takes part: T and epsilon count then.
[[nodiscard]] bool uses_tent(const Drive& drive);
// Whether further images take part: a function learns from several.
[[nodiscard]] bool uses_images(const solver::SpeedSetting& setting);
// Whether both make the same speed function of a source: not what holds the surface, but all else.
[[nodiscard]] bool same_speed(const Drive& a, const Drive& b);
// Whether phi is the same with these constraints at once as with `earlier` ones first and then these.
[[nodiscard]] bool cover(const Drive& drive, const Drive& earlier);
// In English, for the command line: "tent", "the least of examples and edges", "examples, walls".
[[nodiscard]] std::string describe(const Drive& drive);

// The speed function; null: the tent alone. `source` is the volume as the level set sees it. Fails
// (ErrorKind::usage) saying what is missing, (ErrorKind::cancelled).
Result<std::shared_ptr<const solver::SpeedFunction>> make_speed(const Drive& drive,
                                                                std::shared_ptr<const Volume> source,
                                                                const solver::Parameters& parameters,
                                                                const Progress& progress = {});

}  // namespace tidemark::document
