// The controls of the 3D view: surface and source.
#pragma once

#include "ui/panels/case_widget.h"

class QCheckBox;
class QComboBox;

namespace tidemark::ui {

class ColourButton;
class Form;
class SliderNumber;

class SurfaceControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit SurfaceControls(QWidget* parent = nullptr);

 protected:
  void refresh() override;

 private:
  void add_surface(Form& form);
  void add_source(Form& form);

  QComboBox* mode_;
  QCheckBox* surface_;
  QComboBox* colouring_;
  ColourButton* colour_;
  SliderNumber* opacity_;
  SliderNumber* occlusion_;
  QCheckBox* source_;
  QComboBox* region_;
  QCheckBox* cube_;
  QCheckBox* box_;
};

}  // namespace tidemark::ui
