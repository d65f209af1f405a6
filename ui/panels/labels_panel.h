// The panel Labels: the segments so far.
#pragma once

#include "ui/panels/panel.h"

class QCheckBox;
class QLabel;
class QModelIndex;
class QPushButton;
class QTableView;
class QToolButton;

namespace tidemark::ui {

class LabelPaintControls;
class LabelToolControls;
class LabelsModel;
class MeaningPicker;
class SliderNumber;

class LabelsPanel : public Panel {
  Q_OBJECT
 public:
  explicit LabelsPanel(QWidget* parent = nullptr);

  // Compares the surface with the chosen label.
  void set_compare_action(QAction* action);

 protected:
  void attach() override;
  void refresh() override;

 private:
  QWidget* make_table();
  QWidget* make_table_buttons();
  QWidget* make_actions();
  void choose(std::uint8_t label);
  void add_label();
  void accept_surface();
  void show_acceptance();
  [[nodiscard]] QString new_name() const;
  void choose_colour(const QModelIndex& index);
  void show_buttons();
  [[nodiscard]] const document::Label* chosen() const;  // the first of them
  [[nodiscard]] std::vector<std::uint8_t> all_chosen() const;

  LabelsModel* model_;
  QTableView* table_;
  QToolButton* remove_;
  LabelPaintControls* painting_;
  MeaningPicker* meaning_;
  QPushButton* accept_;
  QCheckBox* take_all_;
  QLabel* accepted_;  // the outcome of the last acceptance
  QPushButton* begin_;
  QPushButton* refine_;
  QPushButton* compare_;
  SliderNumber* within_;
  SliderNumber* opacity_;
  LabelToolControls* tools_;
  QMetaObject::Connection choices_;  // made in the views of the case
  bool choose_new_ = false;          // a label was added here: it becomes the chosen one
};

}  // namespace tidemark::ui
