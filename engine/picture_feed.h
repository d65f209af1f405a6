// The pictures of one view, as they come.
#pragma once

#include <QImage>
#include <QObject>
#include <cstdint>
#include <memory>
#include <variant>

#include "document/labels.h"
#include "renderer/picture.h"
#include "renderer/views.h"

namespace tidemark::engine {

class CaseRunner;
class CaseProxy;
class PictureTexture;
struct ViewSlot;

using AnyView = std::variant<renderer::SliceView, renderer::VolumeView>;

// A picture on the screen, with its description.
struct ShownPicture {
  // One of the two: a texture only where OpenGL draws and Engine::pictures() says so. Neither before the
  // first picture. May be smaller than the view while something moves: to be shown enlarged.
  QImage image;
  std::shared_ptr<const PictureTexture> texture;
  AnyView view;
  renderer::PictureSize size;  // of the view, in physical pixels
  std::int64_t step = 0;       // of the level set
  bool finished = false;       // no better one will come
  std::uint64_t number = 0;    // counts the pictures of this view
  double painted = 1.0;        // renderer::Picture::painted
};

// Asks for pictures of a view, and delivers the newest. The picture follows the level set by itself: a new
// request is needed only when the view changes.
class PictureFeed : public QObject {
  Q_OBJECT
 public:
  explicit PictureFeed(CaseProxy& proxy, QObject* parent = nullptr);
  ~PictureFeed() override;

  // `size` in physical pixels. `labels` are shown in place of the case's; null: those. The newest request
  // wins; one that is like the last asks for nothing.
  void request(const AnyView& view, renderer::PictureSize size,
               const std::shared_ptr<const document::Labels>& labels = nullptr);
  // Nobody sees the view: nothing is drawn until the next request, and what was shown last stays.
  void withdraw();
  [[nodiscard]] const ShownPicture& shown() const { return shown_; }

 signals:
  void arrived();

 private:
  void take();

  std::shared_ptr<CaseRunner> runner_;
  std::shared_ptr<ViewSlot> slot_;
  ShownPicture shown_;
};

}  // namespace tidemark::engine
