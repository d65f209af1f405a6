// The dialog that makes copies of DICOM files without what tells who the patient is.
#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QLineEdit>
#include <QPushButton>
#include <QRadioButton>
#include <QTreeWidget>

#include "engine/deidentifier.h"
#include "ui/widgets/work_line.h"

namespace tidemark::engine {
struct LoadedStudy;
}

namespace tidemark::ui {

class Form;
class NumberBox;

// Not modal. It offers the files of the series that is open when it is made, whatever becomes of the case.
class DeidentifyDialog : public QDialog {
  Q_OBJECT
 public:
  DeidentifyDialog(const engine::LoadedStudy* study, QWidget* parent);  // null: no case is open

  [[nodiscard]] bool working() const { return work_->working(); }

 signals:
  void copies_asked_for(const QString& folder);  // to be looked at

 private:
  void make_source(Form& form, const engine::LoadedStudy* study);
  void make_options(Form& form);
  void make_dates(Form& form);
  QLineEdit* folder_line(Form& form, const QString& label, const QString& tip);
  void follow();
  void begin();
  void show_outcome(const engine::DeidentifyOutcome& outcome);
  void rest(const QString& said);
  void reject() override;
  [[nodiscard]] engine::DeidentifyOrder order() const;
  [[nodiscard]] bool overwrites_something();

  engine::Deidentifier worker_;
  std::vector<std::filesystem::path> series_;             // of the case
  std::shared_ptr<const imaging::StudyArchive> archive_;  // that they lie in
  QWidget* entries_;
  QRadioButton* of_series_;
  QRadioButton* of_folder_;
  QLineEdit* source_;
  QLineEdit* target_;
  QLineEdit* id_;
  QLineEdit* name_;
  QComboBox* dates_;
  NumberBox* days_;
  QCheckBox* characteristics_;
  QCheckBox* device_;
  QCheckBox* institution_;
  QCheckBox* uids_;
  QCheckBox* risky_;
  QCheckBox* list_;
  QCheckBox* key_;
  WorkLine* work_;
  QTreeWidget* outcome_;
  QPushButton* go_;
  QPushButton* look_;
  QString made_;  // the folder with the copies
};

}  // namespace tidemark::ui
