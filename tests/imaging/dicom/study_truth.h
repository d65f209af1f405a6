// The findings of other readers on the real studies (truth.json beside them), against what was loaded.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/volume.h"
#include "imaging/series.h"

namespace tidemark::test {

// A series with its volume where it can be loaded.
struct Loaded {
  const imaging::Series* series = nullptr;
  Volume volume;
};

// The differences between a study of truth.json and its loaded volumes, one short line each. `folder` is the
// study's.
[[nodiscard]] std::vector<std::string> differences(const nlohmann::json& study,
                                                   const std::filesystem::path& folder,
                                                   const std::vector<Loaded>& loaded);

// "L" or "R" and so on: to which side of the patient each axis runs.
[[nodiscard]] std::string axis_letters(const Geometry& grid);

}  // namespace tidemark::test
