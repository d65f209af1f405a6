#include "ui/main/parameter_difference.h"

#include <algorithm>
#include <functional>

#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

using Text = std::function<QString(const solver::Parameters&)>;

Text number(const char* name, double solver::Parameters::*value) {
  return
      [=](const solver::Parameters& parameters) { return tr(name).arg(general_text(parameters.*value, 4)); };
}

// Of what is unset until the user sets it.
Text number(const char* name, const char* unset, std::optional<double> solver::Parameters::*value) {
  return [=](const solver::Parameters& parameters) {
    const auto& set = parameters.*value;
    return set ? tr(name).arg(general_text(*set, 4)) : tr(unset);
  };
}

Text term(const char* on, const char* off, bool solver::Parameters::*term) {
  return [=](const solver::Parameters& parameters) { return tr(parameters.*term ? on : off); };
}

std::vector<Text> all_texts() {
  using P = solver::Parameters;
  return {[](const P& p) { return tr(p.scheme == solver::Scheme::paper ? "Paper scheme" : "Split scheme"); },
          [](const P& p) { return tr(p.data_form == solver::DataForm::raw ? "D raw" : "D clamped"); },
          number("T %1", &P::target),
          number("ε %1", &P::range),
          number("α %1", &P::alpha),
          number("W %1", QT_TRANSLATE_NOOP("tidemark", "W by spacing"), &P::band),
          number("w %1", QT_TRANSLATE_NOOP("tidemark", "w by band"), &P::rescale),
          number("g %1", &P::target_gradient),
          term(QT_TRANSLATE_NOOP("tidemark", "with data"), QT_TRANSLATE_NOOP("tidemark", "without data"),
               &P::data_term),
          term(QT_TRANSLATE_NOOP("tidemark", "with curvature"),
               QT_TRANSLATE_NOOP("tidemark", "without curvature"), &P::curvature_term),
          term(QT_TRANSLATE_NOOP("tidemark", "with rescaling"),
               QT_TRANSLATE_NOOP("tidemark", "without rescaling"), &P::rescaling_term)};
}

}  // namespace

QStringList parameter_differences(const std::vector<solver::Parameters>& all) {
  std::vector<QStringList> parts(all.size());
  for (const Text& text : all_texts()) {
    QStringList values;
    for (const solver::Parameters& parameters : all) values << text(parameters);
    if (std::all_of(values.begin(), values.end(), [&](const QString& one) { return one == values.front(); }))
      continue;
    for (qsizetype i = 0; i < values.size(); ++i) parts[static_cast<std::size_t>(i)] << values[i];
  }
  QStringList differences;
  for (const QStringList& part : parts) differences << part.join(QStringLiteral(", "));
  return differences;
}

}  // namespace tidemark::ui
