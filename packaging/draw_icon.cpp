// draw_icon IN.svg SIDE OUT.png: the application's icon in the sizes that desktops ask for, made with the
// build.
#include <QImage>
#include <QPainter>
#include <QSvgRenderer>
#include <cstdio>

int main(int argc, char** argv) {
  const int side = argc == 4 ? QByteArray(argv[2]).toInt() : 0;
  if (side <= 0) {
    std::fprintf(stderr, "usage: draw_icon IN.svg SIDE OUT.png\n");
    return 2;
  }
  QSvgRenderer drawing(QString::fromLocal8Bit(argv[1]));
  QImage image(side, side, QImage::Format_ARGB32);
  image.fill(Qt::transparent);
  QPainter painter(&image);
  drawing.render(&painter);
  painter.end();
  if (drawing.isValid() && image.save(QString::fromLocal8Bit(argv[3]))) return 0;
  std::fprintf(stderr, "draw_icon: cannot draw %s into %s\n", argv[1], argv[3]);
  return 1;
}
