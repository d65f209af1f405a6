#include "ui/panels/slice_controls.h"

#include <QCheckBox>
#include <QComboBox>

#include "ui/widgets/form.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {

SliceControls::SliceControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Slices"));
  add_picture(form);
  add_overlays(form);
}

void SliceControls::add_picture(Form& form) {
  voxels_ =
      form.choice(tr("Voxels"), tr("Between voxels values are interpolated, or each voxel is a square."));
  voxels_->addItems({tr("Smooth"), tr("Squares")});
  connect(voxels_, &QComboBox::activated, this, [this](int index) {
    change_display([=](engine::DisplaySettings& settings) { settings.nearest = index == 1; });
  });
  side_ = form.choice(tr("Sides"), tr("Radiological: the patient's right is on the left of the screen. "
                                      "Neurological: on the right."));
  side_->addItems({tr("Radiological"), tr("Neurological")});
  connect(side_, &QComboBox::activated, this, [this](int index) {
    change_display([=](engine::DisplaySettings& settings) { settings.radiological = index == 0; });
  });
  term_ = form.choice(tr("Speed map"),
                      tr("Which part of the speed the map shows, or how much the examples leave in doubt."));
  term_->addItem(tr("Total"), static_cast<int>(renderer::SpeedTerm::total));
  term_->addItem(tr("Data"), static_cast<int>(renderer::SpeedTerm::data));
  term_->addItem(tr("Curvature"), static_cast<int>(renderer::SpeedTerm::curvature));
  term_->addItem(tr("Rescaling"), static_cast<int>(renderer::SpeedTerm::rescaling));
  term_->addItem(tr("Doubt"), static_cast<int>(renderer::SpeedTerm::doubt));
  connect(term_, &QComboBox::activated, this, [this] {
    const auto term = static_cast<renderer::SpeedTerm>(term_->currentData().toInt());
    change_display([=](engine::DisplaySettings& settings) { settings.speed_term = term; });
  });
}

void SliceControls::add_overlays(Form& form) {
  labels_ = form.slider(tr("Labels"), tr("How opaque labels are."));
  labels_->set_decimals(0);
  labels_->set_range(0.0, 100.0);
  labels_->set_unit(QStringLiteral("%"));
  connect(labels_, &SliderNumber::edited, this, [this](double value) {
    change_display([=](engine::DisplaySettings& settings) { settings.label_opacity = value / 100.0; });
  });
  line_ = form.slider(tr("Line width"), tr("Of the surface's outline."));
  line_->set_decimals(1);
  line_->set_range(0.5, 6.0);
  line_->set_unit(tr("px"));
  connect(line_, &SliderNumber::edited, this, [this](double value) {
    change_display([=](engine::DisplaySettings& settings) { settings.line_pixels = value; });
  });
  const auto add_check = [&](const QString& text, const QString& tip,
                             bool engine::DisplaySettings::*setting) {
    QCheckBox* check = form.check(text, tip);
    connect(check, &QCheckBox::clicked, this, [this, setting](bool on) {
      change_display([=](engine::DisplaySettings& settings) { settings.*setting = on; });
    });
    return check;
  };
  outline_ =
      add_check(tr("Outline of the surface"), tr("The yellow line."), &engine::DisplaySettings::outline);
  contours_ =
      add_check(tr("Contours of φ"),
                tr("Lines where φ is -2, -1, 1 and 2: how wide the narrow band is, and whether φ is a "
                   "distance in it. Blue outside, orange inside."),
                &engine::DisplaySettings::contours);
  crosshair_ = add_check(tr("Crosshair"), tr("Shows the point that all slices go through."),
                         &engine::DisplaySettings::crosshair);
  patient_ =
      add_check(tr("Patient's name and dates"), tr("In the corners; off for teaching and screenshots."),
                &engine::DisplaySettings::patient_text);
}

void SliceControls::refresh() {
  const engine::DisplaySettings& settings = proxy()->display().settings();
  voxels_->setCurrentIndex(settings.nearest ? 1 : 0);
  side_->setCurrentIndex(settings.radiological ? 0 : 1);
  term_->setCurrentIndex(term_->findData(static_cast<int>(settings.speed_term)));
  labels_->set_value(100.0 * settings.label_opacity);
  line_->set_value(settings.line_pixels);
  line_->setEnabled(settings.outline);
  outline_->setChecked(settings.outline);
  contours_->setChecked(settings.contours);
  crosshair_->setChecked(settings.crosshair);
  patient_->setChecked(settings.patient_text);
}

}  // namespace tidemark::ui
