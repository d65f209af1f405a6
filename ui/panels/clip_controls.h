// The clip plane (paper section 6.2) by numbers; 3D views drag it.
#pragma once

#include "ui/panels/case_widget.h"

class QCheckBox;
class QPushButton;

namespace tidemark::ui {

class Form;
class SliderNumber;

class ClipControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit ClipControls(QWidget* parent = nullptr);

 protected:
  void refresh() override;

 private:
  QWidget* make_orientations();
  void add_effects(Form& form);
  // Lays the plane across that direction, through the crosshair, and hides the viewer's side.
  void lay_across(glm::dvec3 direction);
  void flip();
  [[nodiscard]] glm::dvec3 towards_viewer() const;

  QCheckBox* on_;
  QWidget* orientations_;
  SliderNumber* distance_;
  QPushButton* flip_;
  QCheckBox* source_;
  QCheckBox* surface_;
  QCheckBox* picture_;
};

}  // namespace tidemark::ui
