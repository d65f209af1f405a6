// Slices by the processor: the counterpart of resources/shaders/render/slice.frag.
#pragma once

#include "core/thread_pool.h"
#include "renderer/host/host_scene.h"

namespace tidemark::renderer {

// Draws a slice with all that lies over it. Fails (ErrorKind::cancelled) on a request to stop. The pixels do
// not depend on the number of threads.
Result<Picture> paint_slice(HostScene& scene, const SliceView& view, PictureSize size, ThreadPool& threads,
                            const Progress& progress);

}  // namespace tidemark::renderer
