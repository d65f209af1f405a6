// De-identification beside the user interface.
#pragma once

#include "engine/job_runner.h"
#include "imaging/deidentify/deidentified_folder.h"

namespace tidemark::imaging {
class StudyArchive;
}

namespace tidemark::engine {

struct DeidentifyOrder {
  imaging::DeidentifyPlaces places;
  std::vector<std::filesystem::path> files;  // empty: all in the source
  imaging::DeidentifyOptions options;
  std::shared_ptr<const imaging::StudyArchive> archive;  // keeps the files that lie in one
};

// What there is to be said of the copies.
struct DeidentifyOutcome {
  std::size_t files = 0;
  std::int64_t series = 0;
  std::size_t patients = 0;
  std::vector<imaging::ChangeTotal> changes;
  std::vector<imaging::LeftOutFile> left_out;  // DICOM alone
  // Copies whose pixels may show who it is: the source's name, and why.
  std::vector<std::pair<std::filesystem::path, std::string>> risky;
};

class Deidentifier : public JobRunner {
  Q_OBJECT
 public:
  explicit Deidentifier(QObject* parent = nullptr);

  // Ends with written(), failed() or, where it was stopped in time, cancelled().
  void write(const DeidentifyOrder& order);
  void cancel() { ask_to_stop(); }

 signals:
  void written(std::shared_ptr<const tidemark::engine::DeidentifyOutcome> outcome);
};

}  // namespace tidemark::engine
