// A known answer with which a case is compared: an expert's mask from a file, or one of the case's labels.
#pragma once

#include <QHash>
#include <QObject>
#include <QPointer>
#include <functional>
#include <memory>
#include <optional>

#include "core/bit_mask.h"
#include "engine/result_jobs.h"
#include "ui/main/case_window.h"

namespace tidemark::engine {
class BackgroundJob;
}

namespace tidemark::ui {

class MainWindow;
class StatusProgress;

// Carries out File > Compare with a mask and Compare with the chosen label, on the active case.
class TruthReader : public QObject {
  Q_OBJECT
 public:
  explicit TruthReader(MainWindow& window);
  ~TruthReader() override;

  // A mask, a label map, a DICOM Segmentation or a structure set. Of several regions the user chooses one.
  void read(CaseWindow& window, const QString& file);
  // The label as it is now: what becomes of it later changes nothing.
  void compare_with_label(CaseWindow& window);

 private:
  // The case that is compared, whichever is the active one by then, and the file that has the answer.
  struct Subject {
    QPointer<CaseWindow> of;
    QString file;
  };

  void choose(const std::shared_ptr<const imaging::Segments>& segments);
  // With all of it, or with one region.
  void compare(const Subject& subject, const std::shared_ptr<const imaging::Segments>& segments,
               std::optional<std::size_t> region);
  void compare(CaseWindow& of, const QString& name, std::function<BitMask()> make);
  void take(CaseWindow& of, const std::shared_ptr<const BitMask>& truth, const QString& name);
  void end(const QString& problem = {});

  MainWindow& window_;
  engine::ResultJobs jobs_;
  StatusProgress* progress_;
  Subject read_;                                                        // last
  QHash<CaseWindow*, std::shared_ptr<engine::BackgroundJob>> jobs_of_;  // that make the masks of cases
};

}  // namespace tidemark::ui
