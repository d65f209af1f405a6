#include "ui/pacs/study_tree.h"

#include <QHeaderView>
#include <algorithm>

namespace tidemark::ui {
namespace {

enum Column { kName, kId, kDate, kModality, kDescription, kObjects, kColumns };
constexpr int kTreeColumnGap = 14;
constexpr int kLeastNameWidth = 180;  // also for the series below
constexpr int kStudyRole = Qt::UserRole;
constexpr int kSeriesRole = Qt::UserRole + 1;  // of a series' row
constexpr int kAskedRole = Qt::UserRole + 2;   // of a study's row: whether its series were asked for

QString text(const std::string& utf8) {
  return QString::fromStdString(utf8);
}

void set_count(QTreeWidgetItem& item, const std::optional<std::int64_t>& count) {
  if (count) item.setData(kObjects, Qt::DisplayRole, QVariant::fromValue<qlonglong>(*count));
  item.setTextAlignment(kObjects, Qt::AlignRight | Qt::AlignVCenter);
}

}  // namespace

StudyTree::StudyTree(QWidget* parent) : QTreeWidget(parent) {
  setAccessibleName(tr("Studies found"));
  setColumnCount(kColumns);
  setHeaderLabels({tr("Patient"), tr("ID"), tr("Date"), tr("Modality"), tr("Description"), tr("Objects")});
  setUniformRowHeights(true);
  setSortingEnabled(true);
  sortByColumn(kDate, Qt::DescendingOrder);
  header()->setStretchLastSection(false);
  header()->setSectionResizeMode(kDescription, QHeaderView::Stretch);
  connect(this, &QTreeWidget::itemExpanded, this, &StudyTree::unfold);
  connect(this, &QTreeWidget::itemSelectionChanged, this, &StudyTree::choice_changed);
  connect(this, &QTreeWidget::itemActivated, this, [this](const QTreeWidgetItem* item) {
    if (item->parent() != nullptr) emit opened();
  });
}

void StudyTree::show_studies(const imaging::Found<imaging::PacsStudy>& studies) {
  clear();
  for (const imaging::PacsStudy& one : studies.entries) {
    auto* item = new QTreeWidgetItem(this);
    item->setData(kName, kStudyRole, text(one.uid));
    item->setText(kName, text(imaging::readable_name(one.patient_name)));
    item->setText(kId, text(one.patient_id));
    item->setText(kDate, text(one.date));
    QStringList modalities;
    for (const std::string& modality : one.modalities) modalities << text(modality);
    item->setText(kModality, modalities.join(QStringLiteral(", ")));
    item->setText(kDescription, text(one.description));
    set_count(*item, one.objects);
    item->setChildIndicatorPolicy(QTreeWidgetItem::ShowIndicator);
  }
  for (const int column : {kName, kId, kDate, kModality, kObjects}) {
    resizeColumnToContents(column);
    const int least = column == kName ? kLeastNameWidth : 0;
    setColumnWidth(column, std::max(columnWidth(column) + kTreeColumnGap, least));
  }
  if (topLevelItemCount() > 0) setCurrentItem(topLevelItem(0));
}

QTreeWidgetItem* StudyTree::study(const QString& uid) const {
  for (int row = 0; row < topLevelItemCount(); ++row) {
    if (topLevelItem(row)->data(kName, kStudyRole).toString() == uid) return topLevelItem(row);
  }
  return nullptr;
}

void StudyTree::unfold(QTreeWidgetItem* item) {
  if (item->parent() != nullptr || item->data(kName, kAskedRole).toBool()) return;
  item->setData(kName, kAskedRole, true);
  emit series_wanted(item->data(kName, kStudyRole).toString());
}

void StudyTree::forget_question(const QString& study_uid) {
  QTreeWidgetItem* item = study(study_uid);
  if (item == nullptr || item->childCount() > 0) return;
  item->setData(kName, kAskedRole, false);
  item->setExpanded(false);
}

void StudyTree::show_series(const QString& study_uid, const imaging::Found<imaging::PacsSeries>& series) {
  QTreeWidgetItem* parent = study(study_uid);
  if (parent == nullptr) return;
  qDeleteAll(parent->takeChildren());
  for (const imaging::PacsSeries& one : series.entries) {
    auto* item = new QTreeWidgetItem(parent);
    item->setData(kName, kStudyRole, study_uid);
    item->setData(kName, kSeriesRole, text(one.uid));
    item->setText(kName, one.number.empty() ? tr("Series") : tr("Series %1").arg(text(one.number)));
    item->setText(kDate, text(one.date));
    item->setText(kModality, text(one.modality));
    item->setText(kDescription, text(one.description));
    set_count(*item, one.objects);
  }
  if (parent->childCount() == 0) parent->setChildIndicatorPolicy(QTreeWidgetItem::DontShowIndicator);
}

std::optional<StudyTree::Chosen> StudyTree::chosen() const {
  const QList<QTreeWidgetItem*> items = selectedItems();
  if (items.isEmpty()) return std::nullopt;
  return Chosen{items.front()->data(kName, kStudyRole).toString(),
                items.front()->data(kName, kSeriesRole).toString()};
}

}  // namespace tidemark::ui
