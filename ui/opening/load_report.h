// The report of loading a study: one line of what was found and changed, and all of it on demand. Not modal;
// the user dismisses it.
#pragma once

#include <QFrame>
#include <QStringList>

#include "engine/result_finder.h"
#include "engine/study_loader.h"

class QPushButton;

namespace tidemark::ui {

class LoadReport : public QFrame {
  Q_OBJECT
 public:
  // The results lie beside the study, and are offered for import.
  explicit LoadReport(const engine::LoadedStudy& study, const std::vector<engine::FoundResult>& results = {},
                      QWidget* parent = nullptr);

 signals:
  void dismissed();
  void import_wanted(const QStringList& files);  // of the results

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  QWidget* make_line(const engine::LoadedStudy& study, const std::vector<engine::FoundResult>& results);
  QWidget* make_offer(const std::vector<engine::FoundResult>& results);
  QWidget* make_details(const std::vector<std::string>& changes,
                        const std::vector<engine::FoundResult>& results);
  void dismiss();

  QPushButton* details_button_;
};

}  // namespace tidemark::ui
