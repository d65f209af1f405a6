// Volume renderings by the processor: the counterpart of resources/shaders/render/volume.frag.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "core/thread_pool.h"
#include "renderer/host/host_scene.h"
#include "renderer/renderer.h"

namespace tidemark::renderer {

// Draws a view that is resolved() over a picture, at the pixels where `wanted` is not 0; all when it is
// empty. Fails (ErrorKind::cancelled) on a request to stop, with the picture half painted. The pixels do not
// depend on the number of threads.
Status paint_volume(HostScene& scene, const VolumeView& view, Picture& picture,
                    std::span<const std::uint8_t> wanted, ThreadPool& threads, const Progress& progress);

// The first thing at a place of the picture, in pixels from its top left; none when nothing is seen.
std::optional<Hit> pick_volume(HostScene& scene, const VolumeView& view, PictureSize size, glm::dvec2 pixel,
                               ThreadPool& threads);

}  // namespace tidemark::renderer
