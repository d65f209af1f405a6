// Further images of a case, in colour over a slice, sampled away from the thread of the user interface.
#pragma once

#include <QImage>
#include <QObject>
#include <QSize>
#include <memory>
#include <optional>
#include <vector>

#include "engine/background_job.h"
#include "engine/shown_image.h"
#include "ui/views/view_geometry.h"

namespace tidemark::ui {

// The newest question wins; the one that is being answered is answered to its end, so that the images follow
// a slice that moves on and on. Answers come in the order of their questions.
class ImageOverlay : public QObject {
  Q_OBJECT
 public:
  explicit ImageOverlay(QObject* parent = nullptr) : QObject(parent) {}
  ~ImageOverlay() override;

  // All visible images that a slice meets, over one another in their order, to be stretched over the view;
  // transparent where they are not.
  struct Drawn {
    renderer::SliceView slice;  // whose orientation, place, zoom and pan are meant
    QSize size;
    QImage picture;                                    // null: no image meets the slice
    std::shared_ptr<const renderer::ImagesOver> over;  // the same for the renderer
  };
  // What changes only the look of the slice asks for nothing.
  void ask(const std::vector<engine::ShownImage>& images, const renderer::SliceView& slice,
           const SliceScreen& screen, QSize size);
  // None while nothing is there yet, or no image is visible.
  [[nodiscard]] const std::optional<Drawn>& newest() const { return newest_; }

 signals:
  void arrived();

 private:
  struct Question {
    std::vector<engine::ShownImage> images;  // the visible ones
    Geometry grid;                           // of the samples
    QSize size;

    bool operator==(const Question&) const = default;
  };
  void start();
  void forget();
  void take(const Question& question, Drawn drawn);

  Question question_;
  renderer::SliceView slice_;  // of the question
  std::optional<Drawn> newest_;
  std::shared_ptr<engine::BackgroundJob> job_;  // while one runs
};

// 0xRRGGBB of a value that is `part` of the way through its window, 0 to 1.
[[nodiscard]] QRgb colour_of(engine::ImageColours colours, double part);

}  // namespace tidemark::ui
