#include "ui/panels/statistics_panel.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/figure_table.h"
#include "ui/panels/measure_controls.h"
#include "ui/panels/region_table.h"
#include "ui/panels/value_unit.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

// A figure of the study's values.
QString study_figure(const engine::CaseProxy& proxy, double value, const QString& unit = {}) {
  return number_text(value, value_decimals(proxy.summary().high - proxy.summary().low), unit);
}

}  // namespace

StatisticsPanel::StatisticsPanel(QWidget* parent) : Panel(tr("Open a study to measure in it."), parent) {
  add(make_surface());
  add(make_tables());
  add(new MeasureControls);
  add(make_buttons());
}

QWidget* StatisticsPanel::make_surface() {
  auto* part = new QWidget;
  Form form(part);
  form.heading(tr("Surface"));
  volume_ = form.figure(tr("Volume"), tr("The volume inside the surface, at sub-voxel precision."));
  area_ = form.figure(tr("Area"), tr("The area of the surface, without the study's own border."));
  voxels_ = form.figure(tr("Voxels"), tr("How many voxels have their centre inside."));
  mean_ =
      form.figure(tr("Mean"), tr("The mean of the study's values inside; measured when the surface rests."));
  deviation_ =
      form.figure(tr("SD"), tr("The standard deviation of the study's values inside; measured when the "
                               "surface rests."));
  return part;
}

QWidget* StatisticsPanel::make_tables() {
  auto* part = new QWidget;
  Form form(part);
  labels_title_ = form.heading(tr("Labels"));
  labels_ = new FigureTable({tr("Label"), tr("ml"), tr("Mean"), tr("SD")}, tr("Figures of the labels"));
  form.wide(labels_);
  measurements_title_ = form.heading(tr("Measurements"));
  measured_ = new FigureTable({tr("Kind"), tr("Value")}, tr("Measurements"));
  form.wide(measured_);
  remove_ = new QPushButton(icon(u"remove"), tr("Remove"));
  remove_->setToolTip(tr("Removes the selected measurements, as the key Delete does in their list."));
  form.wide(remove_);
  connect(remove_, &QPushButton::clicked, this, &StatisticsPanel::remove_measurements);
  auto* by_key = new QAction(measured_);
  by_key->setShortcut(QKeySequence::Delete);
  by_key->setShortcutContext(Qt::WidgetShortcut);
  measured_->addAction(by_key);
  connect(by_key, &QAction::triggered, this, &StatisticsPanel::remove_measurements);
  const auto follow_selection = [this] { remove_->setEnabled(measured_->selectionModel()->hasSelection()); };
  connect(measured_, &QTableWidget::itemSelectionChanged, this, follow_selection);
  follow_selection();
  return part;
}

QWidget* StatisticsPanel::make_buttons() {
  auto* part = new QWidget;
  auto* row = new QHBoxLayout(part);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  auto* copy_button = new QPushButton(icon(u"duplicate"), tr("Copy"));
  copy_button->setToolTip(tr("All figures as text, for a spreadsheet or a report."));
  export_ = new QPushButton(icon(u"export"), tr("Export CSV…"));
  export_->setToolTip(tr("All figures as a file of comma-separated values."));
  row->addWidget(copy_button);
  row->addWidget(export_);
  connect(copy_button, &QPushButton::clicked, this, &StatisticsPanel::copy);
  return part;
}

void StatisticsPanel::show_measurements(const std::vector<engine::Measurement>& measurements) {
  std::vector<QStringList> lines;
  for (const engine::Measurement& measurement : measurements) {
    if (!measurement.complete()) continue;
    lines.push_back(
        {kind_text(measurement.kind), size_text(measurement.value(), 1, unit_text(measurement.kind))});
  }
  measured_->fill(lines, measurements_title_);
  remove_->setVisible(!lines.empty());
}

void StatisticsPanel::remove_measurements() {
  change_display([this](engine::DisplaySettings& settings) {
    int row = 0;
    std::erase_if(settings.measurements, [&](const engine::Measurement& measurement) {
      return measurement.complete() && measured_->selectionModel()->isRowSelected(row++);
    });
  });
}

void StatisticsPanel::copy() const {
  if (!proxy()) return;
  QGuiApplication::clipboard()->setText(to_text(*proxy()));
}

void StatisticsPanel::set_export_action(QAction* action) {
  connect(export_, &QPushButton::clicked, action, &QAction::trigger);
}

void StatisticsPanel::attach() {
  Panel::attach();
  measured_->clearSelection();
  if (proxy()) return;
  show_surface({});
  show_labels({});
  show_measurements({});
}

void StatisticsPanel::show_surface(const std::vector<RegionRow>& rows) {
  const bool there = !rows.empty() && rows.front().area_mm2.has_value();
  const bool measured = there && rows.front().values.has_value();
  const QString unit = proxy() ? value_unit(proxy()->volume()) : QString();
  volume_->setText(there ? size_text(rows.front().volume_ml, 2, tr("ml")) : kNothing);
  area_->setText(there ? size_text(*rows.front().area_mm2, 0, tr("mm²")) : kNothing);
  voxels_->setText(there ? count_text(rows.front().voxels) : kNothing);
  mean_->setText(measured ? study_figure(*proxy(), rows.front().values->mean, unit) : kNothing);
  deviation_->setText(measured ? study_figure(*proxy(), rows.front().values->standard_deviation, unit)
                               : kNothing);
}

void StatisticsPanel::show_labels(const std::vector<RegionRow>& rows) {
  std::vector<QStringList> lines;
  for (const RegionRow& row : rows) {
    if (row.area_mm2) continue;
    lines.push_back({row.name, size_text(row.volume_ml, 1),
                     row.values ? study_figure(*proxy(), row.values->mean) : kNothing,
                     row.values ? study_figure(*proxy(), row.values->standard_deviation) : kNothing});
  }
  labels_->fill(lines, labels_title_);
}

void StatisticsPanel::refresh() {
  const auto rows = region_rows(proxy()->state());
  show_surface(rows);
  show_labels(rows);
  show_measurements(proxy()->display().settings().measurements);
}

}  // namespace tidemark::ui
