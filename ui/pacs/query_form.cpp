#include "ui/pacs/query_form.h"

#include <QGridLayout>
#include <QLabel>

#include "ui/look/theme.h"

namespace tidemark::ui {

QueryForm::QueryForm(QWidget* parent) : QWidget(parent), modality_(new QComboBox(this)) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(kSpace);
  grid->setVerticalSpacing(kSpaceTight);
  name_ = line(tr("Patient's &name"), tr("Family^Given"),
               tr("As the server has it; * stands for any letters: Doe*"), 0, 0);
  id_ = line(tr("Patient's &ID"), {}, tr("The patient's number; * stands for any"), 0, 1);
  description_ = line(tr("&Description"), {}, tr("Of the study; * stands for any letters"), 0, 2);
  from_ = line(tr("&From"), tr("2026-01-31"), tr("Studies of that day and later"), 1, 0);
  to_ = line(tr("&Until"), tr("2026-12-31"), tr("Studies of that day and earlier"), 1, 1);
  modality_->setEditable(true);
  modality_->addItems({QString(), "CT", "MR", "PT", "SEG", "RTSTRUCT"});
  modality_->setAccessibleName(tr("Modality"));
  modality_->setToolTip(tr("Studies with a series of that kind"));
  auto* label = new QLabel(tr("&Modality"), this);
  label->setBuddy(modality_);
  grid->addWidget(label, 1, 4);
  grid->addWidget(modality_, 1, 5);
  for (const int column : {1, 3, 5}) grid->setColumnStretch(column, 1);
}

QLineEdit* QueryForm::line(const QString& label, const QString& placeholder, const QString& tip, int row,
                           int column) {
  auto* edit = new QLineEdit(this);
  edit->setPlaceholderText(placeholder);
  edit->setToolTip(tip);
  edit->setAccessibleName(QString(label).remove('&'));
  edit->setClearButtonEnabled(true);
  connect(edit, &QLineEdit::returnPressed, this, &QueryForm::submitted);
  auto* text = new QLabel(label, this);
  text->setBuddy(edit);
  auto* grid = static_cast<QGridLayout*>(layout());
  grid->addWidget(text, row, 2 * column);
  grid->addWidget(edit, row, 2 * column + 1);
  return edit;
}

imaging::StudyQuery QueryForm::query() const {
  const auto text = [](const QString& entered) { return entered.trimmed().toStdString(); };
  imaging::StudyQuery query;
  query.patient_name = text(name_->text());
  query.patient_id = text(id_->text());
  query.date_from = text(from_->text());
  query.date_to = text(to_->text());
  query.modality = text(modality_->currentText());
  query.description = text(description_->text());
  return query;
}

void QueryForm::show_query(const imaging::StudyQuery& query) {
  const auto text = [](const std::string& entered) { return QString::fromStdString(entered); };
  name_->setText(text(query.patient_name));
  id_->setText(text(query.patient_id));
  from_->setText(text(query.date_from));
  to_->setText(text(query.date_to));
  modality_->setCurrentText(text(query.modality));
  description_->setText(text(query.description));
}

}  // namespace tidemark::ui
