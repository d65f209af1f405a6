#include "ui/readers/readers_dialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "engine/message_text.h"
#include "ui/look/theme.h"
#include "ui/main/case_head.h"
#include "ui/panels/acceptance_text.h"
#include "ui/readers/reader_list.h"
#include "ui/readers/reader_table.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {
namespace {

constexpr QSize kDialogSize(1180, 600);
constexpr int kReaderListWidth = 240;
constexpr int kShareDecimals = 3;   // decimals of shares of 1
constexpr int kAmountDecimals = 2;  // of ml and mm
constexpr int kDiceColumn = 2;

// Whether a voxel of the region has no label.
bool has_free_voxel(const Region& region, const PagedBytes& labels) {
  bool is_free = false;
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    for (std::int64_t i = 0; i < length && !is_free; ++i) is_free = labels.at(voxel + Index3(i, 0, 0)) == 0;
  });
  return is_free;
}

std::vector<ReaderTable::Column> pair_columns() {
  return {{ReadersDialog::tr("First"), {}},
          {ReadersDialog::tr("Second"), {}},
          {ReadersDialog::tr("Dice"), ReadersDialog::tr("Twice what both have, by the sum of both"),
           kShareDecimals},
          {ReadersDialog::tr("Jaccard"), ReadersDialog::tr("What both have, by what any of them has"),
           kShareDecimals},
          {ReadersDialog::tr("First (ml)"), ReadersDialog::tr("The volume of the first"), kAmountDecimals},
          {ReadersDialog::tr("Second (ml)"), ReadersDialog::tr("The volume of the second"), kAmountDecimals},
          {ReadersDialog::tr("Mean (mm)"),
           ReadersDialog::tr("The mean distance between both surfaces, both ways"), kAmountDecimals},
          {ReadersDialog::tr("95 % (mm)"),
           ReadersDialog::tr("95 of 100 places are nearer to the other surface"), kAmountDecimals},
          {ReadersDialog::tr("Largest (mm)"), ReadersDialog::tr("The largest distance: Hausdorff's"),
           kAmountDecimals}};
}

std::vector<ReaderTable::Column> estimate_columns() {
  return {{ReadersDialog::tr("Reader"), {}},
          {ReadersDialog::tr("Sensitivity"),
           ReadersDialog::tr("The share of the estimate that the reader has"), kShareDecimals},
          {ReadersDialog::tr("Specificity"),
           ReadersDialog::tr("The share of what is outside the estimate that the reader leaves out, near it"),
           kShareDecimals},
          {ReadersDialog::tr("Dice"), ReadersDialog::tr("With the estimate"), kShareDecimals}};
}

}  // namespace

ReadersDialog::ReadersDialog(CaseWindow& window)
    : QDialog(&window),
      window_(window),
      list_(new ReaderList(window.proxy())),
      add_(make_button(tr("Add files…"), tr("Masks, label maps, DICOM segmentations, structure sets"))),
      remove_(make_button(tr("Remove"), tr("Takes the chosen file out of the list"))),
      region_(new QComboBox),
      pairs_(new ReaderTable(pair_columns(), tr("Comparison of each with each"), kDiceColumn)),
      estimates_(new ReaderTable(estimate_columns(), tr("Readers and the estimate"), 0)),
      estimate_(make_note({})),
      take_all_(new QCheckBox(tr("Take voxels of other labels"))),
      keep_(make_button(tr("Keep as label"), tr("The estimate becomes a new label of this case."))),
      work_(new WorkLine),
      export_(make_button(tr("Export CSV…"), tr("Both tables as a file of comma-separated values."))),
      go_(make_button(tr("&Compare"), tr("Compares those with a tick, as they are now"))) {
  setAttribute(Qt::WA_DeleteOnClose);
  lay_out();
  connect(list_, &ReaderList::chosen_changed, this, [this] {
    measuring_ = false;
    if (waiting_.isEmpty()) comparison_.cancel();  // of others than those
    show_regions();
    clear_results();
  });
  connect(list_, &QListWidget::currentRowChanged, this, &ReadersDialog::show_buttons);
  connect(region_, &QComboBox::currentIndexChanged, this, &ReadersDialog::clear_results);
  connect(add_, &QPushButton::clicked, this, &ReadersDialog::files_wanted);
  connect(remove_, &QPushButton::clicked, list_, &ReaderList::remove_current);
  connect(keep_, &QPushButton::clicked, this, &ReadersDialog::keep_estimate);
  connect(export_, &QPushButton::clicked, this, [this] { emit export_wanted(to_csv(results_)); });
  connect(go_, &QPushButton::clicked, this, &ReadersDialog::compare);
  connect(&proxy(), &engine::CaseProxy::state_changed, this, &ReadersDialog::follow_keeping);
  connect(&proxy().display(), &engine::Display::changed, this, &ReadersDialog::follow_title);
  connect_comparison();
  follow_title();
  show_regions();
  clear_results();
  go_->setDefault(true);
  resize(kDialogSize);
}

void ReadersDialog::lay_out() {
  auto* head = new CaseHead;
  head->set_case(&window_);
  auto* columns = new QHBoxLayout;
  columns->setSpacing(kSpaceGroups);
  columns->addWidget(make_list_column());
  columns->addWidget(make_results_column(), 1);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
  buttons->addButton(go_, QDialogButtonBox::ActionRole);
  buttons->addButton(export_, QDialogButtonBox::ActionRole);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* rows = new QVBoxLayout(this);
  rows->setSpacing(kSpace);
  rows->addWidget(head);
  rows->addLayout(columns, 1);
  rows->addWidget(work_);
  rows->addWidget(buttons);
}

QWidget* ReadersDialog::make_list_column() {
  region_->setAccessibleName(tr("Region of the files"));
  region_->setToolTip(tr("What counts of files that have several regions. One without it counts as empty."));
  auto* column = new QWidget;
  column->setFixedWidth(kReaderListWidth);
  auto* rows = new QVBoxLayout(column);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(kSpace);
  rows->addWidget(new QLabel(tr("Segmentations")));
  rows->addWidget(list_, 1);
  auto* files = new QHBoxLayout;
  files->addWidget(add_);
  files->addWidget(remove_);
  rows->addLayout(files);
  rows->addWidget(new QLabel(tr("Region of the files")));
  rows->addWidget(region_);
  return column;
}

QWidget* ReadersDialog::make_results_column() {
  take_all_->setToolTip(
      tr("Otherwise only voxels that have no label yet are taken. Voxels of locked labels stay."));
  auto* column = new QWidget;
  auto* rows = new QVBoxLayout(column);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(kSpace);
  rows->addWidget(new QLabel(tr("Each with each")));
  rows->addWidget(pairs_, 3);
  rows->addWidget(estimate_);
  rows->addWidget(estimates_, 2);
  auto* keeping = new QHBoxLayout;
  keeping->addWidget(keep_);
  keeping->addWidget(take_all_);
  keeping->addStretch(1);
  rows->addLayout(keeping);
  return column;
}

QPushButton* ReadersDialog::make_button(const QString& text, const QString& tip) {
  auto* button = new QPushButton(text, this);
  button->setToolTip(tip);
  button->setAutoDefault(false);
  return button;
}

void ReadersDialog::connect_comparison() {
  connect(&comparison_, &engine::JobRunner::progressed, work_, &WorkLine::set_progress);
  connect(work_, &WorkLine::cancelled, this, [this] {
    if (std::exchange(measuring_, false)) return rest(tr("Cancelled."));
    comparison_.cancel();
  });
  connect(&comparison_, &engine::ReaderComparison::was_read, this, &ReadersDialog::take_file);
  connect(&comparison_, &engine::ReaderComparison::pair_compared, this,
          [this](std::size_t first, std::size_t second, const document::Comparison& comparison) {
            take_pair({first, second, comparison});
          });
  connect(&comparison_, &engine::ReaderComparison::estimated, this, &ReadersDialog::take_estimate);
  connect(&comparison_, &engine::JobRunner::failed, this, [this](const QString& message) {
    if (waiting_.isEmpty()) return rest(message);
    problems_ << message;
    end_reading();
  });
  connect(&comparison_, &engine::JobRunner::cancelled, this, [this] {
    waiting_.clear();
    problems_.clear();
    rest(tr("Cancelled."));
  });
}

// The patient is named while the views do so, too.
void ReadersDialog::follow_title() {
  setWindowTitle(tr("Compare readers: %1").arg(findChild<CaseHead*>()->text()));
}

void ReadersDialog::show_regions() {
  const QStringList names = list_->region_names();
  const QString before = region_->currentIndex() > 0 ? region_->currentText() : QString();
  const QSignalBlocker quiet(region_);
  region_->clear();
  region_->addItem(tr("All of them together"));
  region_->addItems(names);
  region_->setCurrentIndex(static_cast<int>(names.indexOf(before)) + 1);
}

void ReadersDialog::read(const QString& file) {
  waiting_ << file;
  if (waiting_.size() == 1) read_next();
}

void ReadersDialog::read_next() {
  work_->begin(tr("Reading %1").arg(QFileInfo(waiting_.front()).fileName()));
  show_buttons();
  comparison_.read(path_of(waiting_.front()), proxy().volume().geometry);
}

void ReadersDialog::take_file(std::shared_ptr<const document::FileRegions> file) {
  for (const std::string& change : file->changes)
    problems_ << tr("%1: %2").arg(text_of(file->file.filename()), engine::message_text(change));
  list_->add(std::move(file));
  end_reading();
}

void ReadersDialog::end_reading() {
  waiting_.pop_front();
  if (!waiting_.isEmpty()) return read_next();
  rest(std::exchange(problems_, {}).join(u'\n'));
}

// Right after an edit the case's state still has phi before it.
void ReadersDialog::compare() {
  clear_results();
  work_->begin(tr("Comparing readers"));
  measuring_ = true;
  show_buttons();
  proxy().measure([self = QPointer(this)] {
    if (self && std::exchange(self->measuring_, false)) self->compare_measured();
  });
}

void ReadersDialog::compare_measured() {
  const std::vector<ListedReader> chosen = list_->chosen();
  const engine::CaseState& state = proxy().state();
  engine::ReaderQuestion question{
      {proxy().volume().geometry, state.labels, state.label_voxels, state.phi}, {}, {}};
  if (region_->currentIndex() > 0) question.region = region_->currentText().toStdString();
  results_.region = question.region;
  results_.voxel_ml = question.of_case.geometry.voxel_volume_ml();
  for (const ListedReader& one : chosen) {
    question.readers.push_back(one.reader);
    results_.names.push_back(one.name.toStdString());
  }
  comparison_.compare(std::move(question));
}

void ReadersDialog::take_pair(const ComparedPair& pair) {
  results_.pairs.push_back(pair);
  const document::Comparison& comparison = pair.comparison;
  const auto mm = [&](double solver::SurfaceDistance::*of) {
    return comparison.distance ? std::optional((*comparison.distance).*of) : std::nullopt;
  };
  pairs_->add_row({QString::fromStdString(results_.names[pair.first]),
                   QString::fromStdString(results_.names[pair.second])},
                  {comparison.dice(), comparison.jaccard(), pair.first_ml(), pair.second_ml(),
                   mm(&solver::SurfaceDistance::mean_mm), mm(&solver::SurfaceDistance::most_mm),
                   mm(&solver::SurfaceDistance::largest_mm)});
}

void ReadersDialog::take_estimate(std::shared_ptr<const imaging::TruthEstimate> estimate) {
  results_.estimate = std::move(estimate);
  for (std::size_t n = 0; n < results_.names.size(); ++n) {
    const imaging::ReaderQuality& quality = results_.estimate->readers[n];
    estimates_->add_row({QString::fromStdString(results_.names[n])},
                        {quality.sensitivity, quality.specificity, quality.dice});
  }
  estimate_->setText(tr("Estimate of the truth from all of them (STAPLE): %1")
                         .arg(number_text(results_.estimate_ml(), kAmountDecimals, tr("ml"))));
  const auto least = std::min_element(
      results_.pairs.begin(), results_.pairs.end(),
      [](const ComparedPair& a, const ComparedPair& b) { return a.comparison.dice() < b.comparison.dice(); });
  rest(tr("Least alike: %1 and %2, Dice %3")
           .arg(QString::fromStdString(results_.names[least->first]),
                QString::fromStdString(results_.names[least->second]),
                number_text(least->comparison.dice(), kShareDecimals)));
}

void ReadersDialog::keep_estimate() {
  const auto& labels = proxy().state().label_voxels;
  if (!take_all_->isChecked() && labels && !has_free_voxel(results_.estimate->region, *labels))
    return rest(tr("All of it lies in other labels: tick the box to take their voxels."));
  keeping_ = tr("Estimate of %1 readers").arg(results_.names.size());
  auto regions = std::make_shared<std::vector<document::LabelRegion>>();
  regions->push_back({0, keeping_.toStdString(), results_.estimate->region});
  proxy().finish_labels(regions,
                        take_all_->isChecked() ? document::Take::others_too : document::Take::free_voxels);
}

// Says what has become of the estimate, once the case has it.
void ReadersDialog::follow_keeping() {
  const auto& acceptance = proxy().state().acceptance;
  if (keeping_.isEmpty() || !acceptance || acceptance->label != keeping_.toStdString()) return;
  keeping_.clear();
  rest(acceptance_text(*acceptance));
}

void ReadersDialog::clear_results() {
  results_ = {};
  pairs_->setRowCount(0);
  estimates_->setRowCount(0);
  estimate_->setText(tr("Estimate of the truth from all of them (STAPLE)"));
  rest(list_->chosen().size() < 2 ? tr("Tick two segmentations or more.") : QString());
}

void ReadersDialog::rest(const QString& said) {
  if (!measuring_ && !comparison_.busy()) work_->end(said);
  show_buttons();
}

void ReadersDialog::show_buttons() {
  const bool busy = measuring_ || comparison_.busy() || !waiting_.isEmpty();
  list_->setEnabled(!busy);
  add_->setEnabled(!busy);
  remove_->setEnabled(!busy && list_->can_remove_current());
  region_->setEnabled(!busy && region_->count() > 1);
  go_->setEnabled(!busy && list_->chosen().size() >= 2);
  export_->setEnabled(!busy && !results_.pairs.empty());
  keep_->setEnabled(!busy && results_.estimate && !results_.estimate->region.empty());
  take_all_->setEnabled(keep_->isEnabled());
}

}  // namespace tidemark::ui
