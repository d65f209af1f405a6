// A button with a title and a sentence below it, and a picture at its left if it has one.
#pragma once

#include <QAbstractButton>
#include <QPixmap>

#include "ui/look/colour.h"

namespace tidemark::ui {

class CardButton : public QAbstractButton {
  Q_OBJECT
 public:
  CardButton(const QString& title, const QString& sentence, QWidget* parent = nullptr);

  // Makes it stand out among its neighbours, as the one to try first.
  void set_emphasised(bool emphasised);
  // Whose pixels are square; null: none.
  void set_picture(const QImage& picture);
  [[nodiscard]] bool has_picture() const { return !picture_.isNull(); }
  // The sentence stays on one line and loses its middle where it is too long (paths).
  void set_one_line(bool one_line);

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;
  [[nodiscard]] bool hasHeightForWidth() const override { return !one_line_; }
  [[nodiscard]] int heightForWidth(int width) const override;

 protected:
  void paintEvent(QPaintEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  bool event(QEvent* event) override;

 private:
  [[nodiscard]] QFont title_font() const;
  void paint_frame(QPainter& painter) const;
  void paint_picture(QPainter& painter) const;
  [[nodiscard]] int text_left() const;

  QString sentence_;
  QPixmap picture_;
  bool hovered_ = false;
  bool emphasised_ = false;
  bool one_line_ = false;
};

}  // namespace tidemark::ui
