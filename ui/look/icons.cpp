#include "ui/look/icons.h"

#include <QDir>
#include <QFile>
#include <QGuiApplication>
#include <QIconEngine>
#include <QLoggingCategory>
#include <QPainter>
#include <QPalette>
#include <QPixmap>
#include <QSvgRenderer>
#include <memory>

namespace tidemark::ui {
namespace {

constexpr const char* kFolder = ":/tidemark/icons/";
constexpr const char* kApplication = ":/tidemark/application/tidemark.svg";

QColor colour_of(QIcon::Mode mode) {
  const QPalette palette = QGuiApplication::palette();
  switch (mode) {
    case QIcon::Disabled:
      return palette.color(QPalette::Disabled, QPalette::WindowText);
    case QIcon::Selected:
      return palette.color(QPalette::Active, QPalette::HighlightedText);
    default:
      return palette.color(QPalette::Active, QPalette::WindowText);
  }
}

QPixmap drawn(QSvgRenderer& drawing, const QSize& pixels) {
  QPixmap pixmap(pixels);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  drawing.render(&painter, QRectF(QPointF(), pixels));
  return pixmap;
}

// Draws at each request, so that the next painting after a change of palette has the new colour.
class DrawnIcon : public QIconEngine {
 public:
  DrawnIcon(QString name, std::shared_ptr<QSvgRenderer> drawing)
      : name_(std::move(name)), drawing_(std::move(drawing)) {}

  // `pixels` are the device's.
  QPixmap scaledPixmap(const QSize& pixels, QIcon::Mode mode, QIcon::State /*state*/, qreal scale) override {
    if (pixels.isEmpty()) return {};
    QPixmap pixmap = drawn(*drawing_, pixels);
    QPainter painter(&pixmap);
    painter.setCompositionMode(QPainter::CompositionMode_SourceIn);  // the drawing's opacity, in this colour
    painter.fillRect(pixmap.rect(), colour_of(mode));
    painter.end();
    pixmap.setDevicePixelRatio(scale);
    return pixmap;
  }

  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    return scaledPixmap(size, mode, state, 1.0);
  }

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) override {
    const qreal scale = painter->device()->devicePixelRatioF();
    painter->drawPixmap(rect, scaledPixmap(rect.size() * scale, mode, state, scale));
  }

  [[nodiscard]] QIconEngine* clone() const override { return new DrawnIcon(*this); }
  [[nodiscard]] QString key() const override { return QStringLiteral("tidemark"); }
  QString iconName() override { return name_; }

 private:
  QString name_;
  std::shared_ptr<QSvgRenderer> drawing_;  // shared by an icon's copies
};

}  // namespace

QIcon icon(QStringView name) {
  const QString path = QStringLiteral("%1%2.svg").arg(QLatin1String(kFolder), name);
  if (!QFile::exists(path)) {
    qWarning("There is no icon '%s'", qUtf8Printable(name.toString()));
    return {};
  }
  auto drawing = std::make_shared<QSvgRenderer>(path);
  drawing->setAspectRatioMode(Qt::KeepAspectRatio);
  return QIcon(new DrawnIcon(name.toString(), std::move(drawing)));
}

QStringList icon_names() {
  QStringList names = QDir(QLatin1String(kFolder)).entryList(QDir::Files, QDir::Name);
  for (QString& name : names) name.chop(4);  // ".svg"
  return names;
}

QIcon application_icon() {
  QSvgRenderer drawing(QString::fromLatin1(kApplication));
  QIcon icon;
  for (const int size : {16, 24, 32, 48, 64, 128, 256}) icon.addPixmap(drawn(drawing, {size, size}));
  return icon;
}

}  // namespace tidemark::ui
