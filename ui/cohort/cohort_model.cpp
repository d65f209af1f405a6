#include "ui/cohort/cohort_model.h"

#include <algorithm>

#include "document/cohort/review.h"
#include "engine/message_text.h"
#include "ui/cohort/case_pictures.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

using cohort::CaseOutcome;
using Verdict = cohort::Decision::Verdict;

template <class Kind>
QString words(Kind kind) {
  return engine::message_text(std::string(cohort::words_of(kind)));
}

QString words_of(const cohort::ReviewEntry& entry) {
  QStringList words;
  if (entry.decision.verdict == Verdict::accepted) words << QStringLiteral("✓ %1").arg(tr("accepted"));
  if (entry.decision.verdict == Verdict::rejected) words << QStringLiteral("✗ %1").arg(tr("rejected"));
  if (entry.status && entry.status->corrected) words << tr("corrected");
  return words.join(QStringLiteral(", "));
}

}  // namespace

CohortModel::CohortModel(cohort::CohortFolder folder, std::vector<cohort::ReviewEntry> entries,
                         QObject* parent)
    : QAbstractListModel(parent),
      folder_(std::move(folder)),
      entries_(std::move(entries)),
      pictures_(std::make_unique<CasePictures>()) {
  connect(pictures_.get(), &CasePictures::read, this, [this](const QString& file) {
    // The case's folder is named by its id.
    const int row = row_of(path_of(file).parent_path().filename().string());
    if (row >= 0) emit dataChanged(index(row), index(row), {Qt::DecorationRole});
  });
}

CohortModel::~CohortModel() = default;

int CohortModel::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(entries_.size());
}

QVariant CohortModel::data(const QModelIndex& index, int role) const {
  if (!index.isValid() || index.row() >= rowCount()) return {};
  switch (role) {
    case Qt::DisplayRole:
      return text_of(at(index.row()));
    case Qt::ToolTipRole:
      return QString::fromStdString(at(index.row()).row.place());
    case Qt::DecorationRole:
      return pictures_->picture(picture_file(at(index.row()).row.id));
    default:
      return {};
  }
}

int CohortModel::row_of(const std::string& id) const {
  const auto found = std::find_if(entries_.begin(), entries_.end(),
                                  [&](const cohort::ReviewEntry& entry) { return entry.row.id == id; });
  return found == entries_.end() ? -1 : static_cast<int>(found - entries_.begin());
}

void CohortModel::set_decision(const cohort::Decision& decision) {
  const int row = row_of(decision.id);
  if (row < 0) return;
  entries_[static_cast<std::size_t>(row)].decision = decision;
  emit dataChanged(index(row), index(row));
}

void CohortModel::set_status(const cohort::CaseStatus& status) {
  const int row = row_of(status.id);
  if (row < 0) return;
  entries_[static_cast<std::size_t>(row)].status = status;
  pictures_->forget(picture_file(status.id));
  emit dataChanged(index(row), index(row));
}

QString CohortModel::summary() const {
  const auto count = [&](auto wanted) {
    return QString::number(std::count_if(entries_.begin(), entries_.end(), wanted));
  };
  const auto verdict = [](Verdict wanted) {
    return [wanted](const cohort::ReviewEntry& entry) { return entry.decision.verdict == wanted; };
  };
  return tr("Cases: %1. Accepted: %2, rejected: %3, without a result: %4.")
      .arg(QString::number(entries_.size()), count(verdict(Verdict::accepted)),
           count(verdict(Verdict::rejected)), count([](const cohort::ReviewEntry& entry) {
             return !entry.status || entry.status->outcome != CaseOutcome::done;
           }));
}

QString CohortModel::details(int row) const {
  const cohort::ReviewEntry& entry = at(row);
  if (!entry.status) return tr("No run has computed this case.");
  QStringList lines;
  if (!entry.status->reason.empty()) lines << engine::message_text(entry.status->reason);
  for (const std::string& remark : entry.status->remarks) lines << engine::message_text(remark);
  return lines.join('\n');
}

QString CohortModel::picture_file(const std::string& id) const {
  return ui::text_of(folder_.picture(id));
}

QString CohortModel::text_of(const cohort::ReviewEntry& entry) const {
  QStringList lines{QString::fromStdString(entry.row.id)};
  const auto& status = entry.status;
  if (!status) {
    lines << tr("not computed");
  } else if (status->outcome != CaseOutcome::done || !status->figures) {
    lines << words(status->outcome);
  } else {
    QStringList figures{number_text(status->figures->volume_ml, 1, tr("ml"))};
    if (entry.unusual >= cohort::kFarOff) figures << tr("unusual (%1)").arg(number_text(entry.unusual, 1));
    for (const cohort::CaseWarning warning : status->warnings) figures << words(warning);
    lines << figures.join(QStringLiteral(" · "));
  }
  lines << words_of(entry);
  return lines.join('\n');
}

}  // namespace tidemark::ui
