#include "ui/transfer/primitive_page.h"

#include <QRadioButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/transfer/joint_histogram_plot.h"

namespace tidemark::ui {

PrimitivePage::PrimitivePage(PrimitiveKind kind, int axes, const QString& when_empty, QWidget* parent)
    : QWidget(parent),
      kind_(kind),
      axes_(static_cast<std::size_t>(axes)),
      switches_(new QWidget(this)),
      switch_group_(new QButtonGroup(this)),
      plots_(new QStackedWidget(this)),
      greyed_(new QLabel(this)),
      list_(new PrimitiveList(when_empty, this)),
      form_(new PrimitiveForm(kind, axes, this)) {
  auto* row = new QHBoxLayout(switches_);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(new QLabel(tr("Axes"), switches_));
  row->addStretch();
  switches_->hide();
  greyed_->setWordWrap(true);
  greyed_->hide();
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(switches_);
  column->addWidget(plots_, 1);
  column->addWidget(greyed_);
  column->addWidget(list_);
  column->addWidget(form_);
  connect(switch_group_, &QButtonGroup::idClicked, plots_, &QStackedWidget::setCurrentIndex);
  connect(list_, &PrimitiveList::chosen, this, [this](int index) { emit edited(primitives_, index); });
  connect(list_, &PrimitiveList::add_asked, this,
          [this](renderer::TransferFactor::Kind shape) { add(new_primitive(shape)); });
  connect(list_, &PrimitiveList::duplicate_asked, this, [this] {
    if (chosen_ >= 0) add(primitives_[static_cast<std::size_t>(chosen_)]);
  });
  connect(list_, &PrimitiveList::delete_asked, this, &PrimitivePage::remove_chosen);
  connect(form_, &PrimitiveForm::edited, this,
          [this](const AxisPrimitive& primitive) { replace(chosen_, primitive); });
}

void PrimitivePage::add_plot(const QString& name, TransferPlot* plot) {
  const int index = plots_->addWidget(plot);
  all_plots_.push_back(plot);
  auto* button = new QRadioButton(name, switches_);
  button->setAccessibleName(tr("Plot of %1").arg(name));
  button->setToolTip(plot->accessibleName());
  button->setChecked(index == 0);
  switch_group_->addButton(button, index);
  auto* row = static_cast<QHBoxLayout*>(switches_->layout());
  row->insertWidget(row->count() - 1, button);
  switches_->setVisible(index > 0);
  connect(plot, &TransferPlot::chosen, this, [this](int chosen) { emit edited(primitives_, chosen); });
  connect(plot, &TransferPlot::edited, this, &PrimitivePage::replace);
  connect(plot, &TransferPlot::delete_asked, this, &PrimitivePage::remove_chosen);
}

TransferPlot* PrimitivePage::shown_plot() const {
  return all_plots_[static_cast<std::size_t>(plots_->currentIndex())];
}

void PrimitivePage::set_axes(const std::vector<PrimitiveAxis>& axes) {
  axes_ = axes;
  for (TransferPlot* plot : all_plots_) plot->set_axes(axes_[0], axes_[1]);
  form_->set_axes(axes_);
  QStringList reasons;
  for (const PrimitiveAxis& axis : axes_) {
    if (!axis.greyed.isEmpty()) reasons << axis.greyed;
  }
  greyed_->setText(reasons.join(' '));
  greyed_->setVisible(!reasons.isEmpty());
}

void PrimitivePage::set_primitives(const std::vector<AxisPrimitive>& primitives, int chosen) {
  primitives_ = primitives;
  chosen_ = std::clamp(chosen, primitives.empty() ? -1 : 0, static_cast<int>(primitives.size()) - 1);
  for (TransferPlot* plot : all_plots_) plot->set_primitives(primitives_, chosen_);
  list_->set_primitives(primitives_, axes_, chosen_);
  form_->set_primitive(chosen_ >= 0 ? std::optional(primitives_[static_cast<std::size_t>(chosen_)])
                                    : std::nullopt);
}

void PrimitivePage::reset_zoom() {
  for (TransferPlot* plot : all_plots_) plot->reset_zoom();
}

void PrimitivePage::replace(int index, const AxisPrimitive& primitive) {
  if (index < 0 || index >= static_cast<int>(primitives_.size())) return;
  std::vector<AxisPrimitive> next = primitives_;
  next[static_cast<std::size_t>(index)] = primitive;
  emit edited(next, index);
}

void PrimitivePage::add(const AxisPrimitive& primitive) {
  if (primitives_.size() >= renderer::TransferFunction::kMostPrimitives) return;
  std::vector<AxisPrimitive> next = primitives_;
  next.push_back(primitive);
  emit edited(next, static_cast<int>(next.size()) - 1);
}

void PrimitivePage::remove_chosen() {
  if (chosen_ < 0) return;
  std::vector<AxisPrimitive> next = primitives_;
  next.erase(next.begin() + chosen_);
  emit edited(next, std::max(0, std::min(chosen_, static_cast<int>(next.size()) - 1)));
}

// In the middle of the visible range.
AxisPrimitive PrimitivePage::new_primitive(renderer::TransferFactor::Kind kind) const {
  const TransferPlot& plot = *shown_plot();
  AxisPrimitive primitive;
  primitive.factors[0] = middle_factor(kind, {{}, {}, plot.x_axis().low, plot.x_axis().high, {}});
  const bool in_plane = qobject_cast<const JointHistogramPlot*>(&plot) != nullptr;
  if (in_plane && kind == renderer::TransferFactor::Kind::gaussian) {
    primitive.factors[1] = middle_factor(kind, {{}, {}, plot.y_axis().low, plot.y_axis().high, {}});
  }
  primitive.opacity = kind_ == PrimitiveKind::source ? 0.2 : 1.0;
  primitive.colour = next_colour(primitives_);
  return primitive;
}

}  // namespace tidemark::ui
