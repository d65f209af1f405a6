// The panel "Passes": what the stream executor makes of one page in the next step.
#pragma once

#include "ui/panels/case_widget.h"

class QAction;
class QComboBox;
class QLabel;
class QPushButton;
class QScrollArea;
class QToolButton;

namespace tidemark::ui {

class PassCards;

class PassesPanel : public CaseWidget {
  Q_OBJECT
 public:
  explicit PassesPanel(QWidget* parent = nullptr);

  void set_actions(QAction* play, QAction* step);
  [[nodiscard]] PassCards& cards() { return *cards_; }

 protected:
  void attach() override;
  void refresh() override;
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  void show_passes();
  [[nodiscard]] QString status() const;

  QComboBox* follow_;
  QToolButton* play_;
  QToolButton* step_;
  QLabel* status_;
  QPushButton* use_stream_;
  QScrollArea* scroll_;
  PassCards* cards_;
  QPointer<engine::CaseProxy> watched_;
  QMetaObject::Connection changed_;
};

}  // namespace tidemark::ui
