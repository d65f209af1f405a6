// The studies that the robot segments, with what a person found in them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/result.h"
#include "core/volume.h"

namespace tidemark {

struct CaseFiles {
  std::string name;
  std::vector<std::string> images;  // the first gives the grid; of a folder its largest series
  std::string label;
  std::vector<int> values = {};  // of the label file that count; none: all above 0
  bool below_zero = false;       // the label file is a level set that is negative inside
  bool many = false;             // small objects in many places: the surface begins wherever D > 0
};

const std::vector<CaseFiles>& robot_cases();

struct RobotCase {
  std::string name;
  bool many = false;
  std::vector<std::shared_ptr<const Volume>> images;  // on one grid
  Mask truth;
};

Result<RobotCase> load_case(const std::filesystem::path& folder, const CaseFiles& files);

}  // namespace tidemark
