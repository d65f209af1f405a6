// Response times of a desktop to a stroke: forest, speed maps, motion, and the thread of its widgets.
#pragma once

#include "engine/engine.h"
#include "studies.h"

namespace tidemark {

// `images` further images take part, each as large as the study. Needs a QGuiApplication.
Status measure_response(engine::Engine& engine, const Study& study, int images);

}  // namespace tidemark
