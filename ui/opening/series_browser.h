// The choice among the series that were found under a path.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSortFilterProxyModel>
#include <QTableView>
#include <QTextBrowser>
#include <memory>

#include "imaging/series.h"

namespace tidemark::ui {

class SeriesModel;

class SeriesBrowser : public QDialog {
  Q_OBJECT
 public:
  explicit SeriesBrowser(QWidget* parent = nullptr);

  void show_catalogue(std::shared_ptr<const imaging::Catalogue> catalogue, const QString& path);
  // Null where none is chosen.
  [[nodiscard]] const imaging::Series* selected() const;

 signals:
  void chosen(const tidemark::imaging::Series& series);  // loadable or fillable; the dialog is then closed

 private:
  void build_table();
  void lay_out();
  void choose();
  void follow_selection();

  std::shared_ptr<const imaging::Catalogue> catalogue_;
  SeriesModel* model_;
  QSortFilterProxyModel* shown_;
  QLabel* heading_;
  QLineEdit* filter_;
  QTableView* table_;
  QTextBrowser* details_;
  QLabel* skipped_;
  QPushButton* open_;
};

}  // namespace tidemark::ui
