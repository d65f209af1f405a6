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
  // Title and sentence stay on a line each, and are cut where they are too long, the sentence in its middle
  // (paths). Else both are wrapped, and the card is never narrower than their longest word.
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
  [[nodiscard]] int title_height(int room) const;

  QString sentence_;
  QPixmap picture_;
  bool hovered_ = false;
  bool emphasised_ = false;
  bool one_line_ = false;
};

}  // namespace tidemark::ui
