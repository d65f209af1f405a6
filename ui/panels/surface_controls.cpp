#include "ui/panels/surface_controls.h"

#include <QCheckBox>
#include <QComboBox>

#include "ui/widgets/colour_button.h"
#include "ui/widgets/form.h"
#include "ui/widgets/slider_number.h"

namespace tidemark::ui {
namespace {

QColor to_colour(const glm::vec4& colour) {
  return QColor::fromRgbF(colour.r, colour.g, colour.b);
}

}  // namespace

SurfaceControls::SurfaceControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("3D"));
  mode_ = form.choice(tr("Drawn by"), tr("A ray for each pixel, or the paper's own way: slices that are "
                                         "reconstructed one after the other."));
  mode_->addItems({tr("Ray casting"), tr("Slices")});
  connect(mode_, &QComboBox::activated, this, [this](int index) {
    change_display([=](engine::DisplaySettings& settings) {
      settings.mode = index == 0 ? renderer::Mode::raycast : renderer::Mode::slices;
    });
  });
  add_surface(form);
  add_source(form);
  cube_ = form.check(tr("Orientation cube"), tr("Shows in a corner how the patient is turned."));
  connect(cube_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.orientation_cube = on; });
  });
  box_ = form.check(tr("Edges of the volume"), tr("Shows how far the study reaches."));
  connect(box_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.volume_box = on; });
  });
}

void SurfaceControls::add_surface(Form& form) {
  surface_ = form.check(tr("Surface"), tr("Shows the level set's surface."));
  connect(surface_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.surface = on; });
  });
  colouring_ =
      form.choice(tr("Coloured by"), tr("One colour, or what happens at each place of the surface."));
  const std::pair<QString, renderer::SurfaceColouring> colourings[] = {
      {tr("One colour"), renderer::SurfaceColouring::plain},
      {tr("Total speed"), renderer::SurfaceColouring::total_speed},
      {tr("Speed of the data term"), renderer::SurfaceColouring::data},
      {tr("Speed of the curvature term"), renderer::SurfaceColouring::curvature_term},
      {tr("Speed of rescaling"), renderer::SurfaceColouring::rescaling},
      {tr("Mean curvature"), renderer::SurfaceColouring::curvature},
      {tr("Pages of memory"), renderer::SurfaceColouring::pages}};
  for (const auto& [text, colouring] : colourings) colouring_->addItem(text, static_cast<int>(colouring));
  connect(colouring_, &QComboBox::activated, this, [this] {
    const auto colouring = static_cast<renderer::SurfaceColouring>(colouring_->currentData().toInt());
    change_display([=](engine::DisplaySettings& settings) { settings.colouring = colouring; });
  });
  colour_ = new ColourButton;
  form.row(tr("Colour"), colour_, tr("Of the surface, where it has one colour."));
  connect(colour_, &ColourButton::chosen, this, [this](const QColor& colour) {
    change_display([&](engine::DisplaySettings& settings) {
      settings.surface_colour =
          glm::vec4(colour.redF(), colour.greenF(), colour.blueF(), settings.surface_colour.a);
    });
  });
  opacity_ = form.slider(tr("Opacity"), tr("Of the surface."));
  opacity_->set_decimals(0);
  opacity_->set_range(0.0, 100.0);
  opacity_->set_unit(QStringLiteral("%"));
  connect(opacity_, &SliderNumber::edited, this, [this](double value) {
    change_display([=](engine::DisplaySettings& settings) {
      settings.surface_colour.a = static_cast<float>(value / 100.0);
    });
  });
  occlusion_ =
      form.slider(tr("Hollows"), tr("How much darker hollows of the surface are (ambient occlusion)."));
  occlusion_->set_decimals(0);
  occlusion_->set_range(0.0, 100.0);
  occlusion_->set_unit(QStringLiteral("%"));
  connect(occlusion_, &SliderNumber::edited, this, [this](double value) {
    change_display([=](engine::DisplaySettings& settings) { settings.occlusion = value / 100.0; });
  });
}

void SurfaceControls::add_source(Form& form) {
  source_ = form.check(tr("Source"), tr("Shows the study itself, by its transfer function."));
  connect(source_, &QCheckBox::clicked, this, [this](bool on) {
    change_display([=](engine::DisplaySettings& settings) { settings.show_source = on; });
  });
  region_ = form.choice(tr("Where"), tr("Where the source shows: the surface is a region of interest."));
  const std::pair<QString, renderer::Region> regions[] = {
      {tr("Everywhere"), renderer::Region::everywhere},
      {tr("Inside the surface"), renderer::Region::inside},
      {tr("Outside the surface"), renderer::Region::outside},
      {tr("Everywhere, inside tinted"), renderer::Region::tinted}};
  for (const auto& [text, region] : regions) region_->addItem(text, static_cast<int>(region));
  connect(region_, &QComboBox::activated, this, [this] {
    const auto region = static_cast<renderer::Region>(region_->currentData().toInt());
    change_display([=](engine::DisplaySettings& settings) { settings.region = region; });
  });
}

void SurfaceControls::refresh() {
  const engine::DisplaySettings& settings = proxy()->display().settings();
  mode_->setCurrentIndex(settings.mode == renderer::Mode::raycast ? 0 : 1);
  surface_->setChecked(settings.surface);
  colouring_->setCurrentIndex(colouring_->findData(static_cast<int>(settings.colouring)));
  colour_->set_colour(to_colour(settings.surface_colour));
  opacity_->set_value(100.0 * static_cast<double>(settings.surface_colour.a));
  occlusion_->set_value(100.0 * settings.occlusion);
  source_->setChecked(settings.show_source);
  region_->setCurrentIndex(region_->findData(static_cast<int>(settings.region)));
  cube_->setChecked(settings.orientation_cube);
  box_->setChecked(settings.volume_box);
  colouring_->setEnabled(settings.surface);
  colour_->setEnabled(settings.surface && settings.colouring == renderer::SurfaceColouring::plain);
  opacity_->setEnabled(settings.surface);
  occlusion_->setEnabled(settings.surface);
  region_->setEnabled(settings.show_source);
}

}  // namespace tidemark::ui
