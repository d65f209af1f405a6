#include "ui/results/deidentify_dialog.h"

#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "engine/message_text.h"
#include "engine/study_loader.h"
#include "imaging/deidentify/shifted_date.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/settings.h"
#include "ui/widgets/form.h"
#include "ui/widgets/menu_text.h"
#include "ui/widgets/number_box.h"
#include "ui/widgets/path_line.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {
namespace {

constexpr int kDialogWidth = 600;
constexpr int kSeriesWidth = 380;  // of patient and series
constexpr int kOutcomeHeight = 160;
constexpr int kLongestEntry = 64;  // letters of a DICOM value of that kind (LO)

enum Dates { kGo, kMovedByChance, kMovedByDays };

QString absolute(const QLineEdit& line) {
  const QString text = line.text().trimmed();
  return text.isEmpty() ? text : QDir::cleanPath(QDir(settings::save_folder().get()).absoluteFilePath(text));
}

QString list_of(const QString& folder) {
  return folder + QStringLiteral("-changes.csv");
}

QString key_of(const QString& folder) {
  return folder + QStringLiteral("-key.json");
}

QString text_of(imaging::Change change) {
  switch (change) {
    case imaging::Change::removed:
      return DeidentifyDialog::tr("removed");
    case imaging::Change::emptied:
      return DeidentifyDialog::tr("emptied");
    case imaging::Change::replaced:
      return DeidentifyDialog::tr("replaced");
    case imaging::Change::shifted:
      return DeidentifyDialog::tr("moved");
    case imaging::Change::added:
      return DeidentifyDialog::tr("added");
  }
  return {};
}

// What is written must not lie among the files that are read.
std::filesystem::path folder_of(const std::vector<std::filesystem::path>& files) {
  return files.empty() ? std::filesystem::path() : files.front().parent_path();
}

}  // namespace

DeidentifyDialog::DeidentifyDialog(const engine::LoadedStudy* study, QWidget* parent)
    : QDialog(parent),
      entries_(new QWidget(this)),
      work_(new WorkLine(this)),
      outcome_(new QTreeWidget(this)),
      go_(new QPushButton(tr("&Make copies"), this)),
      look_(new QPushButton(tr("&Look at the copies"), this)) {
  setWindowTitle(tr("Anonymous copies"));
  setAttribute(Qt::WA_DeleteOnClose);
  Form form(entries_);
  make_source(form, study);
  make_options(form);
  outcome_->setHeaderLabels({tr("What"), tr("What became of it"), tr("Values")});
  outcome_->setAccessibleName(tr("What was changed"));
  outcome_->header()->setSectionResizeMode(1, QHeaderView::Stretch);
  outcome_->header()->setStretchLastSection(false);
  outcome_->setMinimumHeight(kOutcomeHeight);
  outcome_->hide();
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  buttons->addButton(look_, QDialogButtonBox::ActionRole);
  buttons->addButton(go_, QDialogButtonBox::ActionRole);
  go_->setDefault(true);
  go_->setToolTip(tr("Writes the copies into the new folder; the source stays as it is"));
  look_->setToolTip(tr("Opens them: a sample should be looked at before they are given away"));
  look_->setEnabled(false);
  auto* column = new QVBoxLayout(this);
  column->setSpacing(kSpace);
  column->addWidget(entries_);
  column->addWidget(make_note(
      tr("By the Basic Application Level Confidentiality Profile of DICOM. Pixels are never changed: text "
         "in a picture stays, and a head in thin slices can be drawn as a face.")));
  column->addWidget(work_);
  column->addWidget(outcome_, 1);
  column->addWidget(buttons);
  connect(of_series_, &QRadioButton::toggled, this, &DeidentifyDialog::follow);
  connect(dates_, &QComboBox::currentIndexChanged, this, &DeidentifyDialog::follow);
  for (const QLineEdit* line : {source_, target_})
    connect(line, &QLineEdit::textChanged, this, &DeidentifyDialog::follow);
  connect(go_, &QPushButton::clicked, this, &DeidentifyDialog::begin);
  connect(look_, &QPushButton::clicked, this, [this] { emit copies_asked_for(made_); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(work_, &WorkLine::cancelled, this, [this] { worker_.cancel(); });
  connect(&worker_, &engine::Deidentifier::progressed, work_, &WorkLine::set_progress);
  connect(&worker_, &engine::Deidentifier::failed, this, &DeidentifyDialog::rest);
  connect(&worker_, &engine::Deidentifier::cancelled, this,
          [this] { rest(tr("Cancelled: nothing was written.")); });
  connect(&worker_, &engine::Deidentifier::written, this,
          [this](const auto& outcome) { show_outcome(*outcome); });
  follow();
  resize(kDialogWidth, layout()->totalHeightForWidth(kDialogWidth));
}

void DeidentifyDialog::make_source(Form& form, const engine::LoadedStudy* study) {
  of_series_ = new QRadioButton;
  of_folder_ = new QRadioButton(tr("All DICOM files in a &folder"));
  if (study != nullptr) {
    series_ = study->dicom_files;
    archive_ = study->archive;
  }
  if (series_.empty()) {
    of_series_->setText(tr("The &series that is open: there is none in DICOM"));
    of_series_->setEnabled(false);
    of_folder_->setChecked(true);
  } else {
    QStringList parts{QString::fromStdString(study->patient.name), study->name};
    parts.removeAll(QString());
    const QString whole = parts.join(QStringLiteral(", "));
    const QString name = of_series_->fontMetrics().elidedText(whole, Qt::ElideMiddle, kSeriesWidth);
    of_series_->setText(tr("The &series that is open: %1").arg(menu_text(name)));
    of_series_->setAccessibleDescription(whole);
    of_series_->setChecked(true);
  }
  of_series_->setToolTip(tr("The files of that series alone"));
  of_folder_->setToolTip(tr("Also those in folders within it"));
  form.wide(of_series_);
  form.wide(of_folder_);
  source_ = folder_line(form, tr("Folder"), tr("The folder with the files; they stay as they are"));
  target_ =
      folder_line(form, tr("Copies to"), tr("A new or an empty folder. It appears whole or not at all."));
  target_->setText(QDir(settings::save_folder().get()).filePath(tr("anonymous")));
}

QLineEdit* DeidentifyDialog::folder_line(Form& form, const QString& label, const QString& tip) {
  auto* choose = new QToolButton;
  choose->setIcon(icon(u"open-folder"));
  choose->setToolTip(tr("Choose a folder"));
  choose->setAccessibleName(tr("Choose a folder: %1").arg(label));
  QLineEdit* line = add_path_line(form, label, tip, choose);
  connect(choose, &QToolButton::clicked, this, [this, line] {
    const QString folder = QFileDialog::getExistingDirectory(this, windowTitle(), absolute(*line));
    if (!folder.isEmpty()) line->setText(folder);
  });
  return line;
}

void DeidentifyDialog::make_options(Form& form) {
  form.heading(tr("The patient becomes"));
  const auto line = [&](const QString& label, const QString& placeholder, const QString& tip) {
    auto* one = new QLineEdit;
    one->setPlaceholderText(placeholder);
    one->setMaxLength(kLongestEntry);
    form.row(label, one, tip);
    return one;
  };
  id_ = line(tr("New ID"), tr("by chance"), tr("Of one patient alone; several get IDs by chance"));
  name_ = line(tr("New name"), tr("the new ID"), tr("Of one patient alone"));
  form.heading(tr("What stays"));
  make_dates(form);
  auto* kept = new QGridLayout;
  int count = 0;
  const auto check = [&](const QString& text, const QString& tip) {
    auto* one = new QCheckBox(text);
    one->setToolTip(tip);
    kept->addWidget(one, count / 2, count % 2);
    ++count;
    return one;
  };
  characteristics_ = check(tr("Sex, age, size and weight"),
                           tr("Uptake values of PET need the weight, and moved dates with their times"));
  device_ = check(tr("Devices"), tr("Their serial numbers and names"));
  institution_ = check(tr("Institutions"), tr("Their names and addresses"));
  uids_ = check(tr("UIDs"), tr("Whoever has the source can then tell whose files they are"));
  form.wide(kept);
  risky_ = form.check(tr("Images that may show who it is, too"),
                      tr("With burned-in text, secondary captures, ultrasound; else they are left out"));
  form.heading(tr("Beside the new folder"));
  list_ = form.check(tr("A list of what was changed (CSV)"), tr("For each copy, without the old values"));
  key_ = form.check(tr("A key to the old names (JSON)"),
                    tr("Old and new IDs, UIDs and files, which only you can read. Without it there is no way "
                       "back; do not give it away."));
}

void DeidentifyDialog::make_dates(Form& form) {
  auto* whole = new QWidget;
  auto* row = new QHBoxLayout(whole);
  row->setContentsMargins(0, 0, 0, 0);
  const QString tip = tr("Moved dates keep their distances; times of the day stay with them");
  dates_ = new QComboBox;
  dates_->setAccessibleName(tr("Dates"));
  dates_->setToolTip(tip);
  dates_->addItems({tr("go, and times with them"), tr("are moved back by a number of days by chance"),
                    tr("are moved back by as many days:")});
  days_ = new NumberBox;
  days_->setAccessibleName(tr("Days"));
  days_->setToolTip(tr("The same for all patients"));
  days_->setDecimals(0);
  days_->setRange(1, imaging::kMostShiftDays);
  days_->show_value(100);  // NOLINT
  whole->setFocusProxy(dates_);
  row->addWidget(dates_, 1);
  row->addWidget(days_);
  form.row(tr("Dates"), whole, tip);
}

void DeidentifyDialog::follow() {
  const bool busy = work_->working();
  entries_->setEnabled(!busy);
  source_->parentWidget()->setEnabled(of_folder_->isChecked());
  days_->setEnabled(dates_->currentIndex() == kMovedByDays);
  const bool has_source = of_series_->isChecked() || !source_->text().trimmed().isEmpty();
  go_->setEnabled(!busy && has_source && !target_->text().trimmed().isEmpty());
}

engine::DeidentifyOrder DeidentifyDialog::order() const {
  engine::DeidentifyOrder order;
  if (of_series_->isChecked()) {
    order.files = series_;
    order.archive = archive_;
  }
  const QString folder = absolute(*target_);
  order.places.source = of_series_->isChecked() ? folder_of(series_) : path_of(absolute(*source_));
  order.places.folder = path_of(folder);
  if (list_->isChecked()) order.places.list = path_of(list_of(folder));
  if (key_->isChecked()) order.places.key = path_of(key_of(folder));
  imaging::DeidentifyOptions& options = order.options;
  const auto entered = [](const QLineEdit& line) -> std::optional<std::string> {
    const std::string text = line.text().trimmed().toStdString();
    return text.empty() ? std::nullopt : std::optional(text);
  };
  options.patient_id = entered(*id_);
  options.patient_name = entered(*name_);
  options.shift_dates = dates_->currentIndex() != kGo;
  if (dates_->currentIndex() == kMovedByDays)
    options.shift_days = -static_cast<int>(std::lround(days_->value()));
  options.keep_characteristics = characteristics_->isChecked();
  options.keep_device = device_->isChecked();
  options.keep_institution = institution_->isChecked();
  options.keep_uids = uids_->isChecked();
  options.with_risky_images = risky_->isChecked();
  return order;
}

// The key is never overwritten; the worker sees to it.
bool DeidentifyDialog::overwrites_something() {
  const QString list = list_of(absolute(*target_));
  if (!list_->isChecked() || !QFileInfo::exists(list)) return false;
  rest(tr("%1 is there: choose another folder, or move it away.").arg(list));
  return true;
}

void DeidentifyDialog::begin() {
  if (work_->working()) return;
  if (dates_->currentIndex() == kMovedByDays && !days_->problem().isEmpty()) {
    days_->setFocus();
    return rest(days_->problem());
  }
  // They are relative to a folder that becomes another one.
  for (QLineEdit* line : {source_, target_}) line->setText(absolute(*line));
  if (overwrites_something()) return;
  const engine::DeidentifyOrder wanted = order();
  if (const Status fit = imaging::check_places(wanted.places); !fit)
    return rest(engine::message_text(fit.error()));
  made_ = absolute(*target_);
  settings::save_folder().set(QFileInfo(made_).absolutePath());
  outcome_->hide();
  look_->setEnabled(false);
  work_->begin(tr("De-identifying files"));
  follow();
  worker_.write(wanted);
}

void DeidentifyDialog::show_outcome(const engine::DeidentifyOutcome& outcome) {
  outcome_->clear();
  const auto group = [this](const QString& title) {
    auto* item = new QTreeWidgetItem(outcome_, {title});
    item->setExpanded(true);
    return item;
  };
  const auto add_files = [&](const QString& title, const auto& files, auto file_of, auto reason_of) {
    if (files.empty()) return;
    auto* item = group(title);
    for (const auto& one : files) {
      const QString reason = engine::message_text(reason_of(one));
      auto* row = new QTreeWidgetItem(item, {text_of(file_of(one).filename()), reason});
      row->setToolTip(0, text_of(file_of(one)));
      row->setToolTip(1, reason);
    }
  };
  // What needs a look comes first.
  add_files(
      tr("Left out"), outcome.left_out, [](const auto& one) { return one.file; },
      [](const auto& one) { return one.reason; });
  add_files(
      tr("May show who it is"), outcome.risky, [](const auto& one) { return one.first; },
      [](const auto& one) { return one.second; });
  auto* changes = group(tr("Attributes"));
  for (const imaging::ChangeTotal& one : outcome.changes) {
    auto* row = new QTreeWidgetItem(changes, {QString::fromStdString(one.attribute.keyword),
                                              text_of(one.attribute.change), QString::number(one.values)});
    row->setToolTip(0, QString::fromStdString(one.attribute.path));
    row->setTextAlignment(2, Qt::AlignRight | Qt::AlignVCenter);
  }
  outcome_->resizeColumnToContents(0);
  outcome_->resizeColumnToContents(2);
  outcome_->show();
  look_->setEnabled(true);
  QString said = tr("%1: files %2, series %3, patients %4.")
                     .arg(QFileInfo(made_).fileName(), QString::number(outcome.files),
                          QString::number(outcome.series), QString::number(outcome.patients));
  if (!outcome.left_out.empty())
    said += ' ' + tr("Files that were left out: %1.").arg(outcome.left_out.size());
  rest(said + ' ' + tr("Look at a sample before you give them away."));
  if (height() < layout()->totalHeightForWidth(width()))
    resize(width(), layout()->totalHeightForWidth(width()));
}

void DeidentifyDialog::rest(const QString& said) {
  work_->end(said);
  follow();
}

// While it works, the first time stops the work: how that ends is to be seen.
void DeidentifyDialog::reject() {
  if (!working()) return QDialog::reject();
  worker_.cancel();
}

}  // namespace tidemark::ui
