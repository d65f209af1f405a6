// A buffer of a page as a picture: a square a texel, coloured by its value.
#pragma once

#include <QColor>
#include <QFont>
#include <QString>
#include <QWidget>
#include <functional>
#include <vector>

namespace tidemark::ui {

class TexelPicture : public QWidget {
  Q_OBJECT
 public:
  struct Content {
    int columns = 0;
    int rows = 0;
    std::vector<float> values;  // x fastest; not a number: no texel
    bool names_range = true;
    double range = 1.0;             // of the colours: -range to range
    bool is_of_substreams = false;  // values are places in kSubstreamColours
    int border = 0;                 // texels of the neighbours on each side
    bool zero_line = false;         // between texels on the two sides of the surface
    // "voxel 51, 37, 41"
    std::function<QString(int x, int y)> place;
  };

  // `side`: of the picture, in pixels of the unscaled screen. `name` stands below it.
  TexelPicture(const QString& name, int side, QWidget* parent = nullptr);

  void show_content(Content content);
  void clear();
  [[nodiscard]] const Content& content() const { return content_; }

  [[nodiscard]] QSize sizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

 private:
  [[nodiscard]] float value(int x, int y) const {
    return content_.values[static_cast<std::size_t>(x + content_.columns * y)];
  }
  [[nodiscard]] QRect cell(int x, int y) const;
  [[nodiscard]] QColor colour_of(float value) const;
  [[nodiscard]] bool is_border(int x, int y) const;
  void paint_zero_line(QPainter& painter) const;
  [[nodiscard]] QString range_text() const;
  [[nodiscard]] bool is_narrow() const { return side_ < 80; }  // its range stands below its name

  QString name_;
  int side_;
  Content content_;
};

// Of words beside and below pictures.
QFont caption_font(QFont font);

// A round number that is not below the largest size of the values: 1, 2 or 5 times a power of ten.
double round_range(const std::vector<float>& values);

}  // namespace tidemark::ui
