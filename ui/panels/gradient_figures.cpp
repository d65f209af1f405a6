#include "ui/panels/gradient_figures.h"

#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include "ui/panels/gradient_plot.h"
#include "ui/widgets/disclosure.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr int kRest = 9;  // times as long as the histogram takes

QString text_of(const solver::GradientHistogram::Part& part) {
  if (part.voxels == 0) return QStringLiteral("–");
  return number_text(part.mean, 3) + QStringLiteral(" ± ") + number_text(part.deviation, 3);
}

}  // namespace

GradientFigures::GradientFigures(QWidget* parent)
    : CaseWidget(parent),
      fold_(new Disclosure(tr("Gradient of φ"), QStringLiteral("gradient"))),
      plot_(new GradientPlot),
      question_(
          this,
          [](const Question& question, const std::stop_token& stop) {
            auto found = solver::gradient_histogram(*question.phi, question.highest, {nullptr, stop});
            return found ? Answer(*found) : std::nullopt;
          },
          [this] { show_answer(); }, kRest) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(fold_);
  fold_->set_title(tr("Gradient of φ"));
  Form form(fold_->content());
  plot_->setToolTip(
      tr("How many voxels have which |∇φ|. The dashed line is the target of the rescaling term, "
         "at which it holds φ; without the term the histogram spreads."));
  form.wide(plot_);
  near_ = form.figure(tr("Near the surface"),
                      tr("Mean and standard deviation of |∇φ| where |φ| is at most 1.5 voxels."));
  band_ =
      form.figure(tr("Whole band"), tr("The same of all voxels of the band that have no clamped neighbour."));
  connect(fold_, &Disclosure::toggled, this, [this](bool open) {
    if (open && proxy()) return refresh();
    question_.forget();
  });
}

void GradientFigures::attach() {
  question_.forget();
  show_answer();
}

void GradientFigures::refresh() {
  if (!fold_->is_open()) return;
  const engine::CaseState& state = proxy()->state();
  plot_->set_target(state.parameters.target_gradient);
  if (!state.begun || !state.phi) {
    question_.forget();
    return show_answer();
  }
  question_.ask({state.phi, GradientPlot::kTargets * state.parameters.target_gradient});
}

void GradientFigures::show_answer() {
  const auto& answered = question_.answer();
  const Answer found = answered ? answered->answer : std::nullopt;
  plot_->set_histogram(found);
  near_->setText(text_of(found ? found->near : solver::GradientHistogram::Part{}));
  band_->setText(text_of(found ? found->band : solver::GradientHistogram::Part{}));
}

}  // namespace tidemark::ui
