// The studies that a server has found, and under each its series once it is unfolded.
#pragma once

#include <QTreeWidget>
#include <optional>

#include "imaging/pacs/services.h"

namespace tidemark::ui {

class StudyTree : public QTreeWidget {
  Q_OBJECT
 public:
  explicit StudyTree(QWidget* parent = nullptr);

  void show_studies(const imaging::Found<imaging::PacsStudy>& studies);
  void show_series(const QString& study_uid, const imaging::Found<imaging::PacsSeries>& series);
  void forget_question(const QString& study_uid);  // its series did not come: unfolding asks again

  // The selection: a series, or a study where the series is empty. Unset without a selection.
  struct Chosen {
    QString study_uid;
    QString series_uid;
  };
  [[nodiscard]] std::optional<Chosen> chosen() const;

 signals:
  void series_wanted(const QString& study_uid);
  void choice_changed();
  void opened();  // by a double click or Return on a series

 private:
  void unfold(QTreeWidgetItem* item);
  [[nodiscard]] QTreeWidgetItem* study(const QString& uid) const;
};

}  // namespace tidemark::ui
