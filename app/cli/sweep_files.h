// The results of a sweep as files: a table and a picture.
#pragma once

#include <string>

#include "app/cli/console.h"
#include "document/sweep.h"
#include "renderer/picture.h"

namespace tidemark::cli {

// A line a run, after one with the names: the axes, steps, converged, outcome, volume_ml, voxels_inside, dice
// (empty without a truth) and problem. Numbers have as many digits as they need.
[[nodiscard]] std::string sweep_table(const document::Sweep& sweep);

// The same for programs: {"axes": [..], "runs": [..]}.
[[nodiscard]] Json sweep_json(const document::Sweep& sweep);

// One slice of every run in a matrix, with volume and Dice as numbers and colours, and the agreement of all
// runs below. `source` is the volume as the runs saw it.
[[nodiscard]] renderer::Picture sweep_sheet(const document::Sweep& sweep, const Volume& source);

}  // namespace tidemark::cli
