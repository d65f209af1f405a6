// A ball in a CT, for tests that work on a study.
#pragma once

#include <memory>

#include "document/session_contents.h"
#include "engine/study_loader.h"

namespace tidemark::test {

// 100 HU in a ball of 12 mm radius, 0 HU around it, with some noise; voxels of 1 x 1 x 2 mm.
inline constexpr double kBallRadius = 12.0;
std::shared_ptr<const engine::LoadedStudy> ball_study();
// The same with parameters that no executor takes: a case of it gives up.
std::shared_ptr<const engine::LoadedStudy> hopeless_study();
// A session of it whose surface a map drives. The map's file is missing, and nothing drives the surface.
std::shared_ptr<const document::SessionContents> ball_without_its_map();

}  // namespace tidemark::test
