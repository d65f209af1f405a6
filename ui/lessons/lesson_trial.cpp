#include "ui/lessons/lesson_trial.h"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QVBoxLayout>

#include "ui/lessons/lesson_text.h"
#include "ui/lessons/measure_rows.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

enum TrialColumn { part_column, figure_column, measured_column, expected_column, verdict_column };

}  // namespace

LessonTrial::LessonTrial(QWidget* parent) : QDialog(parent), said_(make_note({})), table_(new QTableWidget) {
  setWindowTitle(tr("The lesson carried out"));
  table_->setColumnCount(verdict_column + 1);
  table_->setHorizontalHeaderLabels(
      {tr("Part"), tr("Figure"), tr("Measured"), tr("Expected"), tr("In range")});
  table_->setAccessibleName(tr("Figures of the lesson"));
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setTabKeyNavigation(false);
  table_->setShowGrid(false);
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(table_->fontMetrics().height() + kSpace);
  table_->horizontalHeader()->setHighlightSections(false);
  table_->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  table_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  table_->horizontalHeader()->setSectionResizeMode(part_column, QHeaderView::Stretch);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(kSpace);
  column->addWidget(said_);
  column->addWidget(table_, 1);
  column->addWidget(buttons);
  resize(720, 380);
}

void LessonTrial::show_outcomes(const document::Lesson& lesson,
                                const std::vector<document::LessonOutcome>& outcomes) {
  table_->setRowCount(0);
  int outside = 0;
  for (std::size_t i = 0; i < lesson.parts.size() && i < outcomes.size(); ++i) {
    const document::LessonPart& part = lesson.parts[i];
    const QString title = QStringLiteral("%1  %2").arg(i + 1).arg(QString::fromStdString(part.title));
    for (std::size_t k = 0; k < outcomes[i].figures.size(); ++k) {
      const auto value = outcomes[i].figures[k];
      add_row(k == 0 ? title : QString(), part.measures[k], value);
      if (!value || !part.measures[k].holds(*value)) ++outside;
    }
  }
  if (table_->rowCount() == 0) {
    said_->setText(tr("Every try can be carried out. The lesson measures no figure."));
  } else if (outside == 0) {
    said_->setText(tr("Every figure is in its range."));
  } else {
    said_->setText(tr("%n of %1 figures are out of range.", nullptr, outside).arg(table_->rowCount()));
  }
  table_->selectRow(0);
}

void LessonTrial::add_row(const QString& part, const document::LessonMeasure& measure,
                          std::optional<double> value) {
  const document::LessonFigure& figure = *document::lesson_figure(measure.figure);
  const int row = table_->rowCount();
  table_->insertRow(row);
  const auto put = [&](int column, const QString& text) {
    auto* item = new QTableWidgetItem(text);
    if (column == measured_column || column == expected_column)
      item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    table_->setItem(row, column, item);
    return item;
  };
  put(part_column, part)->setToolTip(part);
  put(figure_column, title_with_unit(figure));
  put(measured_column, value ? number_text(*value, figure.digits) : tr("none"));
  put(expected_column, tr("%1 to %2").arg(general_text(measure.low, 9), general_text(measure.high, 9)));
  const bool holds = value && measure.holds(*value);
  QTableWidgetItem* verdict = put(verdict_column, holds ? tr("yes") : tr("no"));
  verdict->setTextAlignment(Qt::AlignCenter);
  if (!holds) verdict->setIcon(icon(u"warning"));
}

}  // namespace tidemark::ui
