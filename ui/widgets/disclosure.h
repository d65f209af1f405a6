// A part of a panel that folds away behind a line "Details".
#pragma once

#include <QToolButton>
#include <QWidget>

namespace tidemark::ui {

class Disclosure : public QWidget {
  Q_OBJECT
 public:
  // `what`: for those who hear it ("Details of the evolution"). Closed until the user opens it, which is
  // remembered in the settings under `key`.
  Disclosure(const QString& what, const QString& key, QWidget* parent = nullptr);

  // In place of "Details".
  void set_title(const QString& title);
  // To be filled by a Form.
  [[nodiscard]] QWidget* content() const { return content_; }
  [[nodiscard]] bool is_open() const { return button_->isChecked(); }
  void set_open(bool open);  // not remembered

 signals:
  void toggled(bool open);

 private:
  QToolButton* button_;
  QWidget* content_;
};

}  // namespace tidemark::ui
