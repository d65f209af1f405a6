// Further images of a case, in colour over a slice.
#pragma once

#include <QImage>
#include <QList>
#include <QSize>
#include <vector>

#include "engine/shown_image.h"
#include "ui/views/view_geometry.h"

namespace tidemark::ui {

// Keeps the pictures until slice, images or size change.
class ImageOverlay {
 public:
  // One of each visible image that the slice meets, all as large as the view; transparent where the image is
  // not. The images lie over one another in this order.
  const QList<QImage>& pictures(const std::vector<engine::ShownImage>& images,
                                const renderer::SliceView& slice, const SliceScreen& screen, QSize size);

 private:
  std::vector<engine::ShownImage> images_;
  renderer::SliceView slice_;
  QSize size_;
  QList<QImage> pictures_;
};

// 0xRRGGBB of a value that is `part` of the way through its window, 0 to 1.
[[nodiscard]] QRgb colour_of(engine::ImageColours colours, double part);

}  // namespace tidemark::ui
