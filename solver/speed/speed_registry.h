// The registry of speed functions: where the command line, the panel, recipes and sessions read which there
// are, what each needs, and its numbers.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "core/progress.h"
#include "solver/parameters.h"
#include "solver/speed/speed_function.h"
#include "solver/speed/speed_setting.h"
#include "solver/speed/strokes.h"

namespace tidemark::solver {

// A word for one of the numbers of a parameter.
struct SpeedChoice {
  const char* name;   // on the command line
  const char* title;  // for people, in English
};

// A number of a speed function.
struct SpeedParameter {
  const char* name;   // in files and on the command line
  const char* title;  // for people, in English
  const char* text;   // what it does, one sentence
  const char* unit;   // "mm", or empty
  double low;
  double high;
  double initial;
  std::vector<SpeedChoice> choices = {};  // of the whole numbers from `low` to `high`; none: any number
};

// What speed functions are made from. All volumes are on one grid.
struct SpeedInputs {
  std::shared_ptr<const Volume> source;               // the level set's source, perhaps smoothed
  std::vector<std::shared_ptr<const Volume>> images;  // further images of the case, resampled
  Parameters parameters;                              // for the tent
  std::shared_ptr<const Strokes> strokes;             // for `examples`; may be null
  std::shared_ptr<const Volume> map;                  // for `image`: D, or a probability; may be null
};

struct SpeedKind {
  const char* name;   // in files and on the command line
  const char* title;  // for people, in English
  const char* text;   // what drives the surface then, one sentence
  bool needs_strokes = false;
  bool uses_images = false;  // further images of the case take part
  bool needs_map = false;
  bool follows_surface = false;  // D depends on it (SpeedFunction::follows_surface)
  std::vector<SpeedParameter> parameters = {};
  // `values` has every parameter. Fails (ErrorKind::usage) saying what is missing, (ErrorKind::cancelled).
  Result<std::shared_ptr<const SpeedFunction>> (*make)(const SpeedInputs& inputs,
                                                       const std::map<std::string, double>& values,
                                                       const Progress& progress) = nullptr;
  bool cached = true;  // make_speed() puts a CachedSpeed before it: not worth it for D(I) of one voxel
};

const std::vector<SpeedKind>& speed_kinds();
// Null: there is none of that name.
const SpeedKind* speed_kind(std::string_view name);
// Whether one of the setting's functions has a property: &SpeedKind::uses_images.
[[nodiscard]] bool any_has(const SpeedSetting& setting, bool SpeedKind::*property);

// Fails (ErrorKind::usage) naming the function and the number: an unknown one, or one outside of its range.
Status check(const SpeedSetting& setting);

// The function of a setting. Null when the setting is the tent alone: executors make that one themselves.
Result<std::shared_ptr<const SpeedFunction>> make_speed(const SpeedSetting& setting,
                                                        const SpeedInputs& inputs,
                                                        const Progress& progress = {});

// The function that was made of a setting, with T and epsilon of other parameters in its tents; what else it
// consists of stays, with all that it has learned and cached. Fails as make_speed().
Result<std::shared_ptr<const SpeedFunction>> with_tents(std::shared_ptr<const SpeedFunction> function,
                                                        const std::shared_ptr<const Volume>& source,
                                                        const Parameters& parameters);

}  // namespace tidemark::solver
