// The last volume renderings: the next one of the same view keeps the pixels whose rays pass no changed page
// of phi.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/host/host_scene.h"
#include "renderer/picture.h"
#include "renderer/views.h"

namespace tidemark::renderer {

class LastPictures {
 public:
  struct Drawn {
    VolumeView view;  // resolved()
    PictureSize size;
    std::uint64_t phi = 0;  // PhiPages::revision()
    Picture picture;
  };

  // Whether the picture is one to keep: no larger than a screen, and showing phi alone of what may change. A
  // map's pages change by themselves.
  [[nodiscard]] static bool can_keep(const HostScene& scene, const VolumeView& view, PictureSize size);

  // The last one of a view that can be kept; null: none.
  [[nodiscard]] const Drawn* of(const VolumeView& view, PictureSize size) const;
  void keep(Drawn drawn);

 private:
  std::vector<Drawn> drawn_;  // the newest last
};

// For each pixel whether a page that has changed since `drawn` may show in it.
[[nodiscard]] std::vector<std::uint8_t> changed_pixels(const HostScene& scene,
                                                       const LastPictures::Drawn& drawn);

}  // namespace tidemark::renderer
