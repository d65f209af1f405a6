// A step of the passes as a card: what it is called, the paper's figure, pictures, and a sentence.
#pragma once

#include <QFrame>
#include <QString>

class QGridLayout;
class QLabel;
class QVBoxLayout;

namespace tidemark::ui {

class PassCard : public QFrame {
  Q_OBJECT
 public:
  static constexpr int kWidth = 288;  // pixels of the unscaled screen

  PassCard(const QString& title, const QString& figure, const QString& sentence, QWidget* parent = nullptr);

  void add(QWidget* widget);
  void add(QLayout* layout);
  QLabel* add_line();  // of text that changes

 private:
  QVBoxLayout* column_;
};

// Cards below each other, in as many columns as there is room for.
class CardColumns : public QWidget {
  Q_OBJECT
 public:
  explicit CardColumns(QWidget* parent = nullptr);

  void add(PassCard* card);
  [[nodiscard]] int columns() const { return columns_; }

 protected:
  void resizeEvent(QResizeEvent* event) override;

 private:
  void arrange();

  QGridLayout* grid_;
  QList<PassCard*> cards_;
  int columns_ = 0;
};

}  // namespace tidemark::ui
