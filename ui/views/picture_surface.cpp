#include "ui/views/picture_surface.h"

#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLPaintDevice>
#include <QPainter>
#include <utility>

#include "engine/view_textures.h"

namespace tidemark::ui {

PictureSurface::PictureSurface(const engine::PictureFeed& feed, Paint paint_over, QWidget* parent)
    : QOpenGLWidget(parent), feed_(feed), paint_over_(std::move(paint_over)) {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setVersion(3, 3);
  format.setSamples(4);  // lines over the picture are smooth only so
  setFormat(format);
  setAttribute(Qt::WA_TransparentForMouseEvents);
  setFocusPolicy(Qt::NoFocus);
  setGeometry(parent->rect());
}

PictureSurface::~PictureSurface() {
  if (context() != nullptr) context()->disconnect(this);  // it goes after this, and tells of it
  let_go();
}

void PictureSurface::initializeGL() {
  ++times_initialised_;
  blitter_.create();
  connect(context(), &QOpenGLContext::aboutToBeDestroyed, this, &PictureSurface::let_go,
          Qt::UniqueConnection);
}

void PictureSurface::let_go() {
  if (!blitter_.isCreated()) return;
  makeCurrent();
  blitter_.destroy();
  doneCurrent();
}

void PictureSurface::paintGL() {
  QOpenGLFunctions& gl = *context()->functions();
  gl.glClearColor(0.07F, 0.08F, 0.1F, 1.0F);
  gl.glClear(GL_COLOR_BUFFER_BIT);
  if (feed_.shown().texture) show_texture();
  // Not by QPainter(this), which paints elsewhere while QWidget::grab() is at work.
  QOpenGLPaintDevice device(size() * devicePixelRatioF());
  device.setDevicePixelRatio(devicePixelRatioF());
  QPainter painter(&device);
  paint_over_(painter);
}

void PictureSurface::show_texture() {
  const engine::PictureTexture& texture = *feed_.shown().texture;
  QOpenGLExtraFunctions& gl = *context()->extraFunctions();
  gl.glDisable(GL_BLEND);
  const QRect all(QPoint(0, 0), size() * devicePixelRatioF());
  blitter_.bind();
  blitter_.blit(texture.id(), QOpenGLTextureBlitter::targetTransform(all, all),
                QOpenGLTextureBlitter::OriginBottomLeft);
  blitter_.release();
  // Behind this fence the engine may draw into the texture, once the feed has dropped it.
  void* before = texture.read_until(gl.glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
  gl.glFlush();
  if (before) gl.glDeleteSync(static_cast<GLsync>(before));
}

QImage PictureSurface::grab(const Paint& paint_over) {
  const Paint usual = std::exchange(paint_over_, paint_over);
  QImage image = grabFramebuffer().convertToFormat(QImage::Format_RGB32);
  paint_over_ = usual;
  image.setDevicePixelRatio(devicePixelRatioF());
  return image;
}

void expect_surfaces(QWidget& window) {
  auto* first = new QOpenGLWidget(&window);
  first->setFixedSize(0, 0);
  first->hide();
}

}  // namespace tidemark::ui
