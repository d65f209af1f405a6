// Sentences above the cases that stay until they are dismissed.
#pragma once

#include <QFrame>

class QLabel;
class QStackedLayout;

namespace tidemark {

class MessageBar : public QFrame {
  Q_OBJECT
 public:
  explicit MessageBar(QWidget* parent = nullptr);

  void show_text(const QString& text);
  // Takes the widget; it goes when it is dismissed or another message comes.
  void show_widget(QWidget* widget);
  void dismiss();
  [[nodiscard]] QString text() const;

 private:
  QWidget* line_;
  QLabel* text_;
  QWidget* shown_ = nullptr;
};

}  // namespace tidemark
