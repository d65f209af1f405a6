// The panel Sweep: many runs from the case's start side by side, to look at and to take one.
#pragma once

#include "ui/panels/panel.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace tidemark::engine {
class CaseSweep;
}

namespace tidemark::ui {

class SweepAxisChoice;
class SweepMatrix;

class SweepPanel : public Panel {
  Q_OBJECT
 public:
  explicit SweepPanel(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  QWidget* make_axes();
  QWidget* make_run();
  QWidget* make_outcome();
  void suggest_axes();
  void start_or_cancel();
  void show_sweep();  // how far it is, or what it has led to
  void show_taken();
  void look_at(QPoint cell);
  void say(const QString& problem);
  [[nodiscard]] engine::CaseSweep* sweep() const;  // null: there is no case

  SweepAxisChoice* across_;
  SweepAxisChoice* down_;
  QPushButton* run_;
  QProgressBar* progress_;
  QLabel* problem_;
  QWidget* outcome_;
  QComboBox* colours_;
  SweepMatrix* matrix_;
  QLabel* figures_;
  QCheckBox* agreement_;
  QCheckBox* spread_;
  QPointer<engine::CaseSweep> shown_;  // to which this is connected
};

}  // namespace tidemark::ui
