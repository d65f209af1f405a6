#include "ui/panels/clip_controls.h"

#include <QCheckBox>
#include <QGridLayout>
#include <QPushButton>
#include <QToolButton>
#include <glm/geometric.hpp>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {
namespace {

QToolButton* make_button(const QString& text, QStringView picture, const QString& tip) {
  auto* button = new QToolButton;
  button->setText(text);
  button->setIcon(icon(picture));
  button->setIconSize({kIconSmall, kIconSmall});
  button->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  button->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  button->setFocusPolicy(Qt::StrongFocus);
  button->setToolTip(tip);
  button->setAccessibleName(text);
  return button;
}

// Half of the volume's extent along a direction.
double half_extent_mm(const Geometry& geometry, const glm::dvec3& direction) {
  double extent = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    extent += std::abs(glm::dot(direction, geometry.direction[axis])) * geometry.spacing_mm[axis] *
              static_cast<double>(geometry.size[axis]);
  }
  return extent / 2.0;
}

}  // namespace

ClipControls::ClipControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Clip plane"));
  on_ = form.check(tr("Clip plane in 3D"), tr("Hides everything in front of a plane."));
  connect(on_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.clip_on = on; });
  });
  orientations_ = make_orientations();
  form.wide(orientations_);
  distance_ = form.slider(tr("Distance"), tr("Of the plane from the middle of the study."));
  distance_->set_decimals(1);
  distance_->set_unit(tr("mm"));
  connect(distance_, &SliderNumber::edited, this, [this](double value) {
    if (!proxy()) return;
    const glm::dvec3 middle = renderer::middle_of(proxy()->volume().geometry);
    change_display([&](engine::DisplaySettings& settings) {
      settings.clip.offset_mm = glm::dot(settings.clip.normal, middle) + value;
    });
  });
  flip_ = new QPushButton(tr("Flip"));
  flip_->setToolTip(tr("Hides the other side."));
  form.wide(flip_);
  connect(flip_, &QPushButton::clicked, this, &ClipControls::flip);
  add_effects(form);
}

QWidget* ClipControls::make_orientations() {
  auto* buttons = new QWidget;
  auto* grid = new QGridLayout(buttons);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setSpacing(kSpaceTight);
  const auto add = [&](int place, QToolButton* button, auto direction) {
    grid->addWidget(button, place / 2, place % 2);
    connect(button, &QToolButton::clicked, this, [this, direction] {
      if (proxy()) lay_across(direction());
    });
  };
  add(0,
      make_button(tr("Axial"), u"view-slice-axial",
                  tr("Across the patient's length, through the crosshair.")),
      [] { return glm::dvec3(0.0, 0.0, 1.0); });
  add(1, make_button(tr("Coronal"), u"view-slice-coronal", tr("From side to side, through the crosshair.")),
      [] { return glm::dvec3(0.0, 1.0, 0.0); });
  add(2,
      make_button(tr("Sagittal"), u"view-slice-sagittal", tr("From front to back, through the crosshair.")),
      [] { return glm::dvec3(1.0, 0.0, 0.0); });
  add(3, make_button(tr("Facing me"), u"camera", tr("Across the line of sight, through the crosshair.")),
      [this] { return towards_viewer(); });
  return buttons;
}

void ClipControls::add_effects(Form& form) {
  const auto add = [&](const QString& text, const QString& tip, bool renderer::ClipPlane::*effect) {
    QCheckBox* check = form.check(text, tip);
    connect(check, &QCheckBox::clicked, this, [this, effect](bool on) {
      change_display([=](engine::DisplaySettings& settings) { settings.clip.*effect = on; });
    });
    return check;
  };
  source_ = add(tr("Cuts the source"), tr("Hides the study in front of the plane."),
                &renderer::ClipPlane::clips_source);
  surface_ = add(tr("Cuts the surface"), tr("Hides the surface in front of the plane."),
                 &renderer::ClipPlane::clips_surface);
  picture_ = add(tr("Shows the slice"), tr("Shows the study on the plane, with the surface's cut in yellow."),
                 &renderer::ClipPlane::picture);
}

glm::dvec3 ClipControls::towards_viewer() const {
  const renderer::Camera& camera = proxy()->display().settings().camera;
  return glm::normalize(glm::cross(camera.right(), camera.up()));
}

void ClipControls::lay_across(glm::dvec3 direction) {
  const glm::dvec3 normal = glm::dot(direction, towards_viewer()) < 0.0 ? -direction : direction;
  change_display([&](engine::DisplaySettings& settings) {
    settings.clip_on = true;
    settings.clip.normal = normal;
    settings.clip.offset_mm = glm::dot(normal, settings.cursor_mm);
  });
}

void ClipControls::flip() {
  change_display([](engine::DisplaySettings& settings) {
    settings.clip.normal = -settings.clip.normal;
    settings.clip.offset_mm = -settings.clip.offset_mm;
  });
}

void ClipControls::refresh() {
  const engine::DisplaySettings& settings = proxy()->display().settings();
  const renderer::ClipPlane& clip = settings.clip;
  const Geometry& geometry = proxy()->volume().geometry;
  const double most = half_extent_mm(geometry, clip.normal);
  on_->setChecked(settings.clip_on);
  distance_->set_range(-most, most, -4.0 * most, 4.0 * most);
  distance_->set_value(clip.offset_mm - glm::dot(clip.normal, renderer::middle_of(geometry)));
  source_->setChecked(clip.clips_source);
  surface_->setChecked(clip.clips_surface);
  picture_->setChecked(clip.picture);
  for (QWidget* part :
       {static_cast<QWidget*>(distance_), static_cast<QWidget*>(flip_), static_cast<QWidget*>(source_),
        static_cast<QWidget*>(surface_), static_cast<QWidget*>(picture_)}) {
    part->setEnabled(settings.clip_on);
  }
}

}  // namespace tidemark::ui
