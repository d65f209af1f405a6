#include "ui/opening/series_browser.h"

#include <QBoxLayout>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QShortcut>
#include <QStyledItemDelegate>
#include <algorithm>

#include "engine/message_text.h"
#include "engine/study_loader.h"
#include "ui/opening/series_model.h"

namespace tidemark::ui {
namespace {

constexpr int kColumnGap = 14;
constexpr int kWidestColumn = 240;  // names of persons can be long
constexpr int kNoteIconSize = 18;
constexpr int kMostSkippedNamed = 20;  // in the tool tip

// The table's icons are as large as its pictures; those of notes are not.
class NotesDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

 protected:
  void initStyleOption(QStyleOptionViewItem* option, const QModelIndex& index) const override {
    QStyledItemDelegate::initStyleOption(option, index);
    option->decorationSize = {kNoteIconSize, kNoteIconSize};
  }
};

QString item_list(const QString& title, const std::vector<std::string>& items) {
  if (items.empty()) return {};
  QString html = QStringLiteral("<p style='margin:0 0 2px 0'><b>%1</b></p>").arg(title.toHtmlEscaped());
  html += QStringLiteral("<ul style='margin:0 0 6px -20px'>");
  for (const std::string& item : items) {
    html += QStringLiteral("<li>%1</li>").arg(engine::message_text(item).toHtmlEscaped());
  }
  return html + QStringLiteral("</ul>");
}

QString skipped_text(std::size_t count) {
  if (count == 0) return {};
  return SeriesBrowser::tr("%n other files are no scans.", nullptr, static_cast<int>(count));
}

QString skipped_list(const std::vector<imaging::SkippedFile>& skipped) {
  QStringList lines;
  for (const imaging::SkippedFile& one : skipped) {
    if (lines.size() == kMostSkippedNamed) {
      lines.push_back(QStringLiteral("…"));
      break;
    }
    lines.push_back(QStringLiteral("%1: %2").arg(QString::fromStdString(one.file.filename().string()),
                                                 engine::message_text(one.reason)));
  }
  return lines.join(QLatin1Char('\n'));
}

}  // namespace

SeriesBrowser::SeriesBrowser(QWidget* parent)
    : QDialog(parent),
      model_(new SeriesModel(this)),
      shown_(new QSortFilterProxyModel(this)),
      heading_(new QLabel(this)),
      filter_(new QLineEdit(this)),
      table_(new QTableView(this)),
      details_(new QTextBrowser(this)),
      skipped_(new QLabel(this)),
      open_(new QPushButton(tr("&Open"), this)) {
  setWindowTitle(tr("Choose a series"));
  shown_->setSourceModel(model_);
  shown_->setSortRole(SeriesModel::kSortRole);
  shown_->setFilterKeyColumn(-1);  // all columns
  shown_->setFilterCaseSensitivity(Qt::CaseInsensitive);
  heading_->setTextFormat(Qt::PlainText);
  filter_->setPlaceholderText(tr("Filter by any text"));
  filter_->setAccessibleName(tr("Filter the series"));
  filter_->setClearButtonEnabled(true);
  details_->setAccessibleName(tr("What is known about the chosen series"));
  skipped_->setTextFormat(Qt::PlainText);
  build_table();
  lay_out();
  connect(filter_, &QLineEdit::textChanged, this, [this](const QString& text) {
    shown_->setFilterFixedString(text);
    if (!table_->currentIndex().isValid() && shown_->rowCount() > 0) table_->selectRow(0);
    follow_selection();
  });
  connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &SeriesBrowser::follow_selection);
  connect(table_, &QTableView::activated, this, &SeriesBrowser::choose);
  connect(open_, &QPushButton::clicked, this, &SeriesBrowser::choose);
  auto* find = new QShortcut(QKeySequence::Find, this);
  connect(find, &QShortcut::activated, filter_, qOverload<>(&QWidget::setFocus));
  resize(1040, 600);
}

void SeriesBrowser::build_table() {
  table_->setModel(shown_);
  table_->setAccessibleName(tr("Series found"));
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::SingleSelection);
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setTabKeyNavigation(false);  // Tab goes on to the buttons; arrows go through rows
  table_->setShowGrid(false);
  table_->setWordWrap(false);
  table_->setIconSize({SeriesModel::kPreviewSize, SeriesModel::kPreviewSize});
  table_->setItemDelegateForColumn(SeriesModel::kNotes, new NotesDelegate(table_));
  table_->setSortingEnabled(true);
  table_->sortByColumn(-1, Qt::AscendingOrder);  // the model's own order at first
  table_->verticalHeader()->hide();
  table_->verticalHeader()->setDefaultSectionSize(SeriesModel::kPreviewSize + 10);
  QHeaderView* header = table_->horizontalHeader();
  header->setHighlightSections(false);
  header->setSectionResizeMode(SeriesModel::kSeries, QHeaderView::Stretch);
  header->setStretchLastSection(false);
}

void SeriesBrowser::lay_out() {
  auto* top = new QHBoxLayout;
  top->addWidget(heading_, 1);
  top->addWidget(filter_);
  filter_->setMinimumWidth(220);
  details_->setMaximumHeight(6 * fontMetrics().lineSpacing());
  details_->setMinimumHeight(3 * fontMetrics().lineSpacing());
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  buttons->addButton(open_, QDialogButtonBox::AcceptRole);
  open_->setDefault(true);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* bottom = new QHBoxLayout;
  bottom->addWidget(skipped_, 1);
  bottom->addWidget(buttons);
  auto* column = new QVBoxLayout(this);
  column->addLayout(top);
  column->addWidget(table_, 1);
  column->addWidget(details_);
  column->addLayout(bottom);
  setTabOrder(filter_, table_);
  setTabOrder(table_, details_);
  setTabOrder(details_, open_);
}

void SeriesBrowser::show_catalogue(std::shared_ptr<const imaging::Catalogue> catalogue, const QString& path) {
  catalogue_ = std::move(catalogue);
  filter_->clear();
  model_->show(catalogue_, devicePixelRatioF());
  heading_->setText(tr("%n series in %1", nullptr, static_cast<int>(catalogue_->series.size())).arg(path));
  skipped_->setText(skipped_text(catalogue_->skipped.size()));
  skipped_->setToolTip(skipped_list(catalogue_->skipped));
  for (int column = SeriesModel::kPatient; column < SeriesModel::kColumns; ++column) {
    table_->resizeColumnToContents(column);
    table_->setColumnWidth(column, std::min(table_->columnWidth(column), kWidestColumn) + kColumnGap);
  }
  const auto& all = catalogue_->series;
  table_->setColumnHidden(SeriesModel::kPatient,
                          std::all_of(all.begin(), all.end(), [](const imaging::Series& series) {
                            return series.patient.name.empty();
                          }));
  table_->setColumnHidden(SeriesModel::kFrame, !model_->has_shared_frames());
  if (shown_->rowCount() > 0) table_->selectRow(0);
  table_->setFocus();
  follow_selection();
}

const imaging::Series* SeriesBrowser::selected() const {
  const QModelIndexList rows = table_->selectionModel()->selectedRows();
  return rows.isEmpty() ? nullptr : &model_->series(shown_->mapToSource(rows.front()).row());
}

void SeriesBrowser::follow_selection() {
  const imaging::Series* series = selected();
  open_->setEnabled(series != nullptr && (series->loadable || series->fillable()));
  if (series == nullptr) return details_->clear();
  QString html;
  if (series->fillable()) {
    html += item_list(tr("Can be loaded with its gaps filled"), {series->reason});
  } else if (!series->loadable) {
    html += item_list(tr("Cannot be loaded"), {series->reason});
  }
  html += item_list(tr("Warnings"), series->warnings);
  html += item_list(tr("What loading changes"), series->changes);
  std::vector<std::string> in_place;
  for (const imaging::Series* other : catalogue_->on_the_frame_of(*series)) {
    in_place.push_back(engine::StudyLoader::name_of(*other).toStdString());
  }
  if (html.isEmpty()) html = tr("Nothing has to be changed to load this series.").toHtmlEscaped();
  html += item_list(tr("In place with, by a shared frame of reference"), in_place);
  details_->setHtml(html);
}

void SeriesBrowser::choose() {
  const imaging::Series* series = selected();
  if (series == nullptr || !(series->loadable || series->fillable())) return;
  const imaging::Series copy = *series;  // the catalogue may go while it is opened
  accept();
  emit chosen(copy);
}

}  // namespace tidemark::ui
