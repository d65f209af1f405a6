// The dialog that compares several readers' segmentations of a case, and keeps the estimate of the truth.
#pragma once

#include <QDialog>
#include <QStringList>

#include "engine/reader_comparison.h"
#include "ui/main/case_window.h"
#include "ui/readers/reader_results.h"

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;

namespace tidemark::ui {

class ReaderList;
class ReaderTable;
class WorkLine;

// Not modal. It belongs to one case, and closes with it; the comparison is of the case as it is at the click.
class ReadersDialog : public QDialog {
  Q_OBJECT
 public:
  explicit ReadersDialog(CaseWindow& window);

  // Files are read one after the other; those that cannot be read are named at the end.
  void read(const QString& file);

 signals:
  void files_wanted();
  void export_wanted(const std::string& csv);

 private:
  void lay_out();
  QWidget* make_list_column();
  QWidget* make_results_column();
  QPushButton* make_button(const QString& text, const QString& tip);
  void connect_comparison();
  void follow_title();
  void show_regions();
  void read_next();
  void take_file(std::shared_ptr<const document::FileRegions> file);
  void end_reading();
  void compare();
  void compare_measured();
  void take_pair(const ComparedPair& pair);
  void take_estimate(std::shared_ptr<const imaging::TruthEstimate> estimate);
  void keep_estimate();
  void follow_keeping();
  void clear_results();
  void rest(const QString& said);
  void show_buttons();
  [[nodiscard]] engine::CaseProxy& proxy() const { return window_.proxy(); }

  CaseWindow& window_;
  engine::ReaderComparison comparison_;
  bool measuring_ = false;  // the case, before the comparison
  QStringList waiting_;     // files; the first is being read
  QStringList problems_;    // of files
  ReaderResults results_;
  QString keeping_;  // the name of the label that the estimate is about to become
  ReaderList* list_;
  QPushButton* add_;
  QPushButton* remove_;
  QComboBox* region_;
  ReaderTable* pairs_;
  ReaderTable* estimates_;
  QLabel* estimate_;
  QCheckBox* take_all_;
  QPushButton* keep_;
  WorkLine* work_;
  QPushButton* export_;
  QPushButton* go_;
};

}  // namespace tidemark::ui
