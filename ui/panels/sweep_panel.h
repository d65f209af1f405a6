// The panel Sweep: many runs from the case's start side by side, to look at and to take one.
#pragma once

#include <optional>

#include "document/sweep_axis.h"
#include "ui/panels/panel.h"
#include "ui/panels/per_case.h"

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
  struct Axes {
    std::optional<document::SweepAxis> across;
    std::optional<document::SweepAxis> down;
  };

  QWidget* make_axes();
  QWidget* make_run();
  QWidget* make_outcome();
  void show_axes();
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
  PerCase<Axes> axes_;                 // of sweeps that were shown before
};

}  // namespace tidemark::ui
