#include "ui/lessons/parameter_names.h"

#include <QCoreApplication>

namespace tidemark::ui {
namespace {

using solver::Parameters;

constexpr double kLargestValue = 1e9;

const NamedParameter kParameters[] = {
    {QT_TRANSLATE_NOOP("Parameters", "Target T"),
     QT_TRANSLATE_NOOP("Parameters", "The value of the wanted tissue, in the study's units."),
     &Parameters::target, -kLargestValue, kLargestValue, 2},
    {QT_TRANSLATE_NOOP("Parameters", "Range ε"),
     QT_TRANSLATE_NOOP("Parameters", "How far a value may be from T for the surface to grow there."),
     &Parameters::range, solver::kMinimumRange, kLargestValue, 2},
    {QT_TRANSLATE_NOOP("Parameters", "Data weight α"),
     QT_TRANSLATE_NOOP("Parameters", "At 1 the data alone counts, at 0 the curvature alone."),
     &Parameters::alpha, 0.0, 1.0, 3},
    {QT_TRANSLATE_NOOP("Parameters", "Data term"),
     QT_TRANSLATE_NOOP("Parameters", "Whether the data moves the surface."), &Parameters::data_term},
    {QT_TRANSLATE_NOOP("Parameters", "Curvature term"),
     QT_TRANSLATE_NOOP("Parameters", "Whether the curvature moves the surface."),
     &Parameters::curvature_term},
    {QT_TRANSLATE_NOOP("Parameters", "Rescaling term"),
     QT_TRANSLATE_NOOP("Parameters", "Whether the slope of φ is drawn to the target gradient."),
     &Parameters::rescaling_term},
    {QT_TRANSLATE_NOOP("Parameters", "Rescaling w"),
     QT_TRANSLATE_NOOP("Parameters", "How strongly the slope of φ is drawn to the target gradient."),
     &Parameters::rescale, 0.0, 1000.0, 3},
    {QT_TRANSLATE_NOOP("Parameters", "Target gradient"),
     QT_TRANSLATE_NOOP("Parameters", "The slope of φ that the rescaling term keeps."),
     &Parameters::target_gradient, 0.01, 1000.0, 2},
    {QT_TRANSLATE_NOOP("Parameters", "Band W"),
     QT_TRANSLATE_NOOP("Parameters",
                       "Half the width of the band in which φ varies, in voxels. Another one needs a "
                       "start."),
     &Parameters::band, 2.0, 10'000.0, 2},
    {QT_TRANSLATE_NOOP("Parameters", "Scheme"),
     QT_TRANSLATE_NOOP(
         "Parameters",
         "Split: an upwind gradient for the data, a central one for the curvature. Paper: one for both."),
     &Parameters::scheme},
    {QT_TRANSLATE_NOOP("Parameters", "Form of the data term"),
     QT_TRANSLATE_NOOP("Parameters", "Clamped: within -1 to 1. Raw: as far below as the values are off."),
     &Parameters::data_form},
    {QT_TRANSLATE_NOOP("Parameters", "Time step factor"),
     QT_TRANSLATE_NOOP("Parameters", "Of the largest stable time step. Above 1 the level set falls apart."),
     &Parameters::time_step_factor, 0.001, 1000.0, 3},
};

}  // namespace

QString NamedParameter::title_text() const {
  return QCoreApplication::translate("Parameters", title);
}

QString NamedParameter::tip_text() const {
  return QCoreApplication::translate("Parameters", tip);
}

bool NamedParameter::is_same(const Parameters& a, const Parameters& b) const {
  return std::visit([&](auto one) { return a.*one == b.*one; }, member);
}

void NamedParameter::copy(const Parameters& from, Parameters& to) const {
  std::visit([&](auto one) { to.*one = from.*one; }, member);
}

std::span<const NamedParameter> named_parameters() {
  return kParameters;
}

void follow(Parameters& parameters, const Parameters& before, const Parameters& after) {
  for (const NamedParameter& one : kParameters) {
    if (one.is_same(parameters, before)) one.copy(after, parameters);
  }
}

}  // namespace tidemark::ui
