#include "ui/panels/speed_details.h"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <algorithm>

#include "ui/look/theme.h"
#include "ui/widgets/disclosure.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_box.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {
namespace {

constexpr double kNarrowestBand = 2.0;  // as solver::check() has it
constexpr double kWidestBand = 20.0;

}  // namespace

SpeedDetails::SpeedDetails(QWidget* parent) : CaseWidget(parent) {
  auto* fold = new Disclosure(tr("Details of the speed"), QStringLiteral("speed"));
  Form all(this);
  all.wide(fold);
  Form form(fold->content());
  paper_alpha_ = form.figure(tr("α as in the paper"),
                             tr("The paper does not divide the data term by ε. With this α its own equation "
                                "balances the terms as here."));
  add_terms(form);
  add_scheme(form);
}

void SpeedDetails::add_terms(Form& form) {
  auto* terms = new QWidget;
  auto* row = new QHBoxLayout(terms);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  const auto add = [&](const QString& text, const QString& tip, bool solver::Parameters::*term) {
    auto* check = new QCheckBox(text);
    check->setToolTip(tip);
    check->setAccessibleName(tr("%1 term").arg(text));
    row->addWidget(check);
    connect(check, &QCheckBox::clicked, this, [this, term](bool on) {
      change([=](solver::Parameters& parameters) { parameters.*term = on; },
             engine::CaseProxy::new_gesture());
    });
    return check;
  };
  data_term_ =
      add(tr("Data"), tr("Moves the surface by the values of the source."), &solver::Parameters::data_term);
  curvature_term_ = add(tr("Curvature"), tr("Smooths the surface by its mean curvature."),
                        &solver::Parameters::curvature_term);
  rescaling_term_ = add(tr("Rescaling"),
                        tr("Keeps the slope of φ near 1, so that the band around the surface stays as wide."),
                        &solver::Parameters::rescaling_term);
  row->addStretch(1);
  form.heading(tr("Terms"));
  form.wide(terms);
}

void SpeedDetails::add_scheme(Form& form) {
  form.heading(tr("Numerics"));
  scheme_ = form.choice(
      tr("Scheme"), tr("How a step of equation 6 is computed (paper, section 4.3). Split: data and curvature "
                       "have a gradient of their own each. Paper: one upwind gradient for their sum, as the "
                       "paper writes it, in steps of 0.6 of the length."));
  scheme_->addItem(tr("Split"), static_cast<int>(solver::Scheme::split));
  scheme_->addItem(tr("Paper"), static_cast<int>(solver::Scheme::paper));
  connect(scheme_, &QComboBox::activated, this, [this] {
    const auto scheme = static_cast<solver::Scheme>(scheme_->currentData().toInt());
    change([=](solver::Parameters& parameters) { parameters.scheme = scheme; },
           engine::CaseProxy::new_gesture());
  });
  data_form_ =
      form.choice(tr("Data term D"),
                  tr("Equation 7 of the paper. Clamped: max(-1, 1 - |I - T| / ε), so that α means the "
                     "same for every ε. Raw: ε - |I - T|, as the paper writes it, without a lower end: "
                     "it outweighs the curvature, and the steps are short."));
  data_form_->addItem(tr("Clamped"), static_cast<int>(solver::DataForm::clamped));
  data_form_->addItem(tr("Raw"), static_cast<int>(solver::DataForm::raw));
  connect(data_form_, &QComboBox::activated, this, [this] {
    const auto form_of_data = static_cast<solver::DataForm>(data_form_->currentData().toInt());
    change([=](solver::Parameters& parameters) { parameters.data_form = form_of_data; },
           engine::CaseProxy::new_gesture());
  });
  add_band(form);
  add_rescaling(form);
}

void SpeedDetails::add_band(Form& form) {
  band_ = new NumberBox;
  band_->setRange(kNarrowestBand, kWidestBand);
  band_->setDecimals(1);
  band_->setSingleStep(0.5);
  band_->setKeyboardTracking(false);
  band_->setSuffix(tr(" voxels"));
  guard_wheel(band_);
  form.row(
      tr("Band W"), band_,
      tr("φ is clamped to ±W (paper, section 4.2): pages farther from the surface are constant and need no "
         "memory. With another W the surface begins again at its start."));
  connect(band_, &NumberBox::valueChanged, this, [this](double value) {
    change([value](solver::Parameters& parameters) { parameters.band = value; },
           engine::CaseProxy::new_gesture());
  });
  band_by_spacing_ =
      form.check(tr("W by the voxels' spacing"),
                 tr("2.5 voxels, or twice the ratio of the largest spacing to the smallest: thick "
                    "slices would stop the surface in a narrower band."));
  connect(band_by_spacing_, &QCheckBox::clicked, this, [this](bool on) {
    const double now = band();
    change(
        [=](solver::Parameters& parameters) {
          parameters.band = on ? std::nullopt : std::optional<double>(now);
        },
        engine::CaseProxy::new_gesture());
  });
}

void SpeedDetails::add_rescaling(Form& form) {
  rescale_ =
      form.slider(tr("Rescaling w"), tr("The weight of the rescaling term of equation 5 (paper, section "
                                        "4.2): how strongly the slope of φ is drawn to the target "
                                        "gradient. It does not move the surface itself."));
  rescale_->set_decimals(3);
  rescale_->set_step(0.01);
  rescale_->set_range(0.0, 1.0, 0.0, 10.0);
  connect(rescale_, &SliderNumber::edited, this, [this](double value, std::uint64_t gesture) {
    change([value](solver::Parameters& parameters) { parameters.rescale = value; }, gesture);
  });
  rescale_by_band_ =
      form.check(tr("w by the band's width"),
                 tr("0.75 / W for a band that reaches W voxels to either side of the surface."));
  connect(rescale_by_band_, &QCheckBox::clicked, this, [this](bool on) {
    const double now = rescaling_weight();
    change(
        [=](solver::Parameters& parameters) {
          parameters.rescale = on ? std::nullopt : std::optional<double>(now);
        },
        engine::CaseProxy::new_gesture());
  });
  target_gradient_ =
      form.slider(tr("Target gradient"),
                  tr("g of equation 5 (paper, section 4.2): the slope of φ that the rescaling term "
                     "keeps. At 1 φ is a distance in voxels; above it the band is narrower."));
  target_gradient_->set_decimals(2);
  target_gradient_->set_step(0.05);
  target_gradient_->set_range(0.2, 2.0, 0.05, 10.0);
  connect(target_gradient_, &SliderNumber::edited, this, [this](double value, std::uint64_t gesture) {
    change([value](solver::Parameters& parameters) { parameters.target_gradient = value; }, gesture);
  });
}

double SpeedDetails::rescaling_weight() const {
  const double by_band = 0.75 / proxy()->state().band;  // 0 where phi is not clamped
  return proxy()->parameters().rescale.value_or(by_band);
}

double SpeedDetails::band() const {
  return proxy()->parameters().band.value_or(proxy()->state().band);
}

void SpeedDetails::refresh() {
  const solver::Parameters& parameters = proxy()->parameters();
  paper_alpha_->setText(short_text(solver::paper_alpha(parameters)));
  data_term_->setChecked(parameters.data_term);
  curvature_term_->setChecked(parameters.curvature_term);
  rescaling_term_->setChecked(parameters.rescaling_term);
  scheme_->setCurrentIndex(scheme_->findData(static_cast<int>(parameters.scheme)));
  data_form_->setCurrentIndex(data_form_->findData(static_cast<int>(parameters.data_form)));
  data_form_->setEnabled(document::uses_tent(proxy()->drive()));
  band_->show_unless_typed(std::clamp(band(), kNarrowestBand, kWidestBand));
  band_by_spacing_->setChecked(!parameters.band.has_value());
  rescale_->set_value(rescaling_weight());
  rescale_by_band_->setChecked(!parameters.rescale.has_value());
  target_gradient_->set_value(parameters.target_gradient);
  for (QWidget* number : {static_cast<QWidget*>(rescale_), static_cast<QWidget*>(rescale_by_band_),
                          static_cast<QWidget*>(target_gradient_)})
    number->setEnabled(parameters.rescaling_term);
}

void SpeedDetails::change(const engine::CaseProxy::ParameterChange& apply, std::uint64_t gesture) {
  if (proxy()) proxy()->change_parameters(apply, gesture);
}

}  // namespace tidemark::ui
