// A short evolution that a GPU has to compute as the processor does, before a patient's surface is left to
// it.
#pragma once

#include <memory>

#include "solver/executor.h"

namespace tidemark::solver {

// What both executors of a trial are made on.
std::shared_ptr<const Volume> trial_source();
Parameters trial_parameters();

// Grows a ball over many pages in both, in runs of a few steps, and cuts a part of it away. Fails
// (ErrorKind::capability) when the tables of `tried` break or its mask is not the mask of `trusted`, and says
// after how many steps; else as the executors do.
Status compare_in_trial(Executor& tried, Executor& trusted);

// The trial of `compute` on a device of OpenGL 4.5, against host. A driver that has passed is not tried again
// in this process. Fails (ErrorKind::capability) naming the driver.
Status try_compute(const std::shared_ptr<gpu::Device>& device);

}  // namespace tidemark::solver
