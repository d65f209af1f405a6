// The search for segmentations and structure sets among the files of a study, beside the user interface.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "engine/job_runner.h"
#include "imaging/series.h"

namespace tidemark::imaging {
enum class ResultForm;
}

namespace tidemark::engine {

struct FoundResult {
  std::filesystem::path file;
  imaging::ResultForm form;
};

class ResultFinder : public JobRunner {
  Q_OBJECT
 public:
  explicit ResultFinder(QObject* parent = nullptr);

  // Ends with found(). Looks at what was found with the series: all of its archive, else what lies in its
  // folder, in folders within it or in those next to it, and what is of its study, wherever it lies. Reads
  // the beginnings of these files.
  void look(const imaging::Series& series, std::shared_ptr<const imaging::Catalogue> found_with);
  void cancel() { give_up(); }

 signals:
  void found(const std::vector<tidemark::engine::FoundResult>& results);
};

}  // namespace tidemark::engine
