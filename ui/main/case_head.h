// The line that names the case that is seen or acted on: its mark, the patient and the series, and in what it
// differs from linked cases.
#pragma once

#include <QIcon>
#include <QPointer>
#include <QWidget>

class QLabel;

namespace tidemark::ui {

class CaseWindow;
class ElidedLabel;

// A case's mark: its number on its colour.
QIcon case_mark(int number);

// Stands above a case's views and above every panel that acts on the case, with the same mark in the same
// colour. The patient is left out while the views leave it out.
class CaseHead : public QWidget {
  Q_OBJECT
 public:
  explicit CaseHead(QWidget* parent = nullptr);

  // Null: no case, and nothing is shown.
  void set_case(CaseWindow* window);
  [[nodiscard]] QString text() const;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  void refresh();
  void refresh_text();

  QPointer<CaseWindow> window_;
  QLabel* mark_ = nullptr;
  ElidedLabel* text_ = nullptr;
  QLabel* difference_ = nullptr;
  QLabel* chain_ = nullptr;
};

}  // namespace tidemark::ui
