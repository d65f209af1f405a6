// The surface of a view whose picture is a texture of the engine's: the only place of the user interface that
// knows OpenGL.
#pragma once

#include <QOpenGLTextureBlitter>
#include <QOpenGLWidget>
#include <functional>

#include "engine/picture_feed.h"

namespace tidemark::ui {

// Lies over its whole parent, shows the feed's newest picture, and has the parent paint over it. The mouse
// and the keyboard stay the parent's. Waits for nothing: a picture is finished when it arrives.
class PictureSurface : public QOpenGLWidget {
  Q_OBJECT
 public:
  using Paint = std::function<void(QPainter&)>;
  PictureSurface(const engine::PictureFeed& feed, Paint paint_over, QWidget* parent);
  ~PictureSurface() override;

  // The picture with something else over it; waits for the GPU.
  [[nodiscard]] QImage grab(const Paint& paint_over);
  // How often a context was prepared: more than once when it was lost on the way.
  [[nodiscard]] int times_initialised() const { return times_initialised_; }

 protected:
  void initializeGL() override;
  void paintGL() override;

 private:
  void let_go();
  void show_texture();

  const engine::PictureFeed& feed_;
  Paint paint_over_;
  QOpenGLTextureBlitter blitter_;
  int times_initialised_ = 0;
};

// To be called before a window is shown in which there may be surfaces later: Qt makes a shown window anew
// when the first OpenGL widget comes into it, and it flickers.
void expect_surfaces(QWidget& window);

}  // namespace tidemark::ui
