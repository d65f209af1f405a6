// The fields of a query.
#pragma once

#include <QComboBox>
#include <QLineEdit>
#include <QWidget>

#include "imaging/pacs/services.h"

namespace tidemark::ui {

class QueryForm : public QWidget {
  Q_OBJECT
 public:
  explicit QueryForm(QWidget* parent = nullptr);
  [[nodiscard]] imaging::StudyQuery query() const;
  void show_query(const imaging::StudyQuery& query);  // but for a study's UID, for which there is no field

 signals:
  void submitted();  // by Return

 private:
  QLineEdit* line(const QString& label, const QString& placeholder, const QString& tip, int row, int column);

  QLineEdit* name_;
  QLineEdit* id_;
  QLineEdit* from_;
  QLineEdit* to_;
  QComboBox* modality_;
  QLineEdit* description_;
};

}  // namespace tidemark::ui
