// A ball in a CT, for tests that work on a study.
#pragma once

#include <memory>

#include "engine/study_loader.h"

namespace tidemark::test {

// 100 HU in a ball of 12 mm radius, 0 HU around it, with some noise; voxels of 1 x 1 x 2 mm.
inline constexpr double kBallRadius = 12.0;
std::shared_ptr<const engine::LoadedStudy> ball_study();

}  // namespace tidemark::test
