// The controls of slices.
#pragma once

#include "ui/panels/case_widget.h"

class QCheckBox;
class QComboBox;

namespace tidemark::ui {

class Form;
class SliderNumber;

class SliceControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit SliceControls(QWidget* parent = nullptr);

 protected:
  void refresh() override;

 private:
  void add_picture(Form& form);
  void add_overlays(Form& form);

  QComboBox* voxels_;
  QComboBox* side_;
  QComboBox* term_;
  QCheckBox* outline_;
  QCheckBox* contours_;
  SliderNumber* line_;
  SliderNumber* labels_;
  QCheckBox* crosshair_;
  QCheckBox* patient_;
};

}  // namespace tidemark::ui
