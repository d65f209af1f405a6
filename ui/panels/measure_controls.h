// The measures of the surface or of a label: diameters, form, and the values of all images inside.
#pragma once

#include <QPointer>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/region_meter.h"
#include "ui/panels/case_widget.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QPushButton;

namespace tidemark::ui {

class FigureTable;
class WorkLine;

// They are found when asked for, and stay with the case until it changes or another region is chosen.
class MeasureControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit MeasureControls(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  [[nodiscard]] engine::RegionMeter* meter() const;          // null without a case
  [[nodiscard]] const document::Measures* measures() const;  // null: there are none
  void measure();
  void show_measures();
  void fill_values();
  void fill_regions(const std::vector<std::pair<QString, std::uint8_t>>& regions);  // names and labels
  void draw_lines();
  void show_work();
  void end_work(const QString& said);  // empty: nothing has to be said
  void show_buttons();

  QPointer<engine::RegionMeter> shown_;
  QFormLayout* rows_;
  QWidget* results_;  // all that was measured
  QFormLayout* result_rows_;
  QComboBox* region_;
  QPushButton* measure_;
  WorkLine* work_;
  QLabel* longest_;
  QLabel* in_slice_;
  QLabel* reach_;
  QLabel* area_;
  QLabel* sphericity_;
  QComboBox* image_;
  FigureTable* values_;
  QPushButton* lines_;
};

}  // namespace tidemark::ui
