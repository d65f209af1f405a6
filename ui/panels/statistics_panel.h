// The panel Statistics: figures of the surface, the labels and the measurements, for reading and for reports.
#pragma once

#include "ui/panels/panel.h"

class QAction;
class QLabel;
class QPushButton;

namespace tidemark::ui {

class FigureTable;
struct RegionRow;

class StatisticsPanel : public Panel {
  Q_OBJECT
 public:
  explicit StatisticsPanel(QWidget* parent = nullptr);

  void set_export_action(QAction* action);
  void copy() const;  // to the clipboard

 protected:
  void attach() override;
  void refresh() override;

 private:
  QWidget* make_surface();
  QWidget* make_tables();
  QWidget* make_buttons();
  void show_surface(const std::vector<RegionRow>& rows);
  void show_labels(const std::vector<RegionRow>& rows);
  void show_measurements(const std::vector<engine::Measurement>& measurements);
  void remove_measurements();  // those that are selected

  QLabel* volume_;
  QLabel* area_;
  QLabel* voxels_;
  QLabel* mean_;
  QLabel* deviation_;
  QLabel* labels_title_;
  FigureTable* labels_;
  QLabel* measurements_title_;
  FigureTable* measured_;
  QPushButton* remove_;
  QPushButton* export_;
};

}  // namespace tidemark::ui
