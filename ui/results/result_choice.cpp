#include "ui/results/result_choice.h"

#include <QVBoxLayout>
#include <algorithm>

#include "ui/look/theme.h"

namespace tidemark::ui {

ResultChoice::ResultChoice(QWidget* parent) : QGroupBox(tr("What"), parent) {
  auto* column = new QVBoxLayout(this);
  column->setSpacing(kSpaceTight);
  all_ = add(tr("A segment for each label, with its name, colour and meaning"));
  visible_ = add(tr("Only the labels that the views show"));
  surface_ = add(tr("The surface that evolves, as one segment; contours follow it between voxels"));
}

QRadioButton* ResultChoice::add(const QString& tip) {
  auto* button = new QRadioButton(this);
  button->setToolTip(tip);
  layout()->addWidget(button);
  return button;
}

void ResultChoice::show_state(const engine::CaseState& state) {
  const auto all = static_cast<int>(state.labels.size());
  const auto visible = static_cast<int>(std::count_if(
      state.labels.begin(), state.labels.end(), [](const document::Label& label) { return label.visible; }));
  all_->setText(tr("&All labels (%1)").arg(all));
  visible_->setText(tr("&Visible labels (%1)").arg(visible));
  surface_->setText(tr("&Inside of the surface"));
  all_->setEnabled(all > 0);
  visible_->setEnabled(visible > 0);
  surface_->setEnabled(state.begun);
  const QRadioButton* const buttons[] = {all_, visible_, surface_};
  const bool chosen = std::any_of(std::begin(buttons), std::end(buttons), [this](const QRadioButton* button) {
    return is_there(button) && button->isChecked();
  });
  if (chosen) return;
  (all > 0 ? all_ : surface_)->setChecked(true);
}

bool ResultChoice::has_choice() const {
  return is_there(all_) || is_there(surface_);
}

document::ResultContent ResultChoice::content() const {
  if (surface_->isChecked()) return document::ResultContent::surface;
  return visible_->isChecked() ? document::ResultContent::visible_labels
                               : document::ResultContent::all_labels;
}

}  // namespace tidemark::ui
