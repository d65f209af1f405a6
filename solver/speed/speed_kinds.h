// The speed functions of this folder, each in a file of its own (NAME_speed.cpp). Private to the registry.
#pragma once

#include "solver/speed/speed_registry.h"

namespace tidemark::solver {

const SpeedKind& tent_kind();
const SpeedKind& regions_kind();
const SpeedKind& edges_kind();
const SpeedKind& examples_kind();
const SpeedKind& image_kind();

}  // namespace tidemark::solver
