// The way from a case of a cohort to a case of the desktop: its study, and the surface that its recipe makes.
#pragma once

#include <QObject>
#include <memory>

#include "document/cohort/review_list.h"
#include "document/session_contents.h"
#include "engine/study_loader.h"

namespace tidemark::ui {

// One at a time; the next gives up the one before.
class CaseOpener : public QObject {
  Q_OBJECT
 public:
  CaseOpener();
  ~CaseOpener() override;

  // A study that a server has comes into the folder of retrieved series, and stays there.
  void open(const cohort::CohortFolder& folder, const cohort::CohortPlan& plan,
            const cohort::ReviewEntry& entry);
  void cancel();

 signals:
  void progressed(double fraction, const QString& step);  // below 0 when unknown
  // Without contents: there is no result.
  void opened(std::shared_ptr<const tidemark::engine::LoadedStudy> study,
              std::shared_ptr<const tidemark::document::SessionContents> contents);
  void failed(const QString& message);

 private:
  class Work;

  void load(const imaging::GridPolicy& policy);
  void bring(const imaging::GridPolicy& policy);
  void replay(const std::shared_ptr<const engine::LoadedStudy>& study);

  engine::StudyLoader loader_;
  std::unique_ptr<Work> work_;
  cohort::ReviewEntry entry_;
  std::filesystem::path servers_file_;
  std::shared_ptr<const document::Recipe> recipe_;  // null: no result
};

}  // namespace tidemark::ui
