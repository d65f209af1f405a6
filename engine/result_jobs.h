// The writing of a case's results, and the import of labels, beside the user interface.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "core/geometry.h"
#include "engine/job_runner.h"

namespace tidemark::imaging {
struct Segments;
}

namespace tidemark::engine {

class ResultJobs : public JobRunner {
  Q_OBJECT
 public:
  explicit ResultJobs(QObject* parent = nullptr);

  // Writes files of its own; ends with written(), failed() or, where it was stopped in time, cancelled().
  void write(std::function<Status(const Progress&)> work);
  // Ends with labels_read(), failed() or cancelled(). With `only_results`, what is neither a DICOM
  // Segmentation nor a structure set ends with no_result(). Changes tell of a frame of reference other than
  // the study's, where that is given.
  void read_labels(const std::filesystem::path& file, const Geometry& grid, bool only_results = false,
                   const std::string& frame_of_reference_uid = {});

  // Ends with cancelled(), unless the work was past stopping; then it ends as if it had not been asked.
  void cancel() { ask_to_stop(); }

 signals:
  void written();
  void labels_read(std::shared_ptr<const tidemark::imaging::Segments> segments);
  void no_result();
};

}  // namespace tidemark::engine
