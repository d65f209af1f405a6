// Results out of a case, and labels into it, for the user interface, which never waits.
#pragma once

#include <QObject>
#include <QString>
#include <filesystem>
#include <functional>
#include <memory>

#include "core/geometry.h"
#include "core/progress.h"

namespace tidemark {

class BackgroundJob;
struct Segments;

// Lives on the thread of the user interface; the work is done on others. One piece of work at a time: whoever
// asks for the next gives up the one before, of which nothing is heard any more.
class ResultJobs : public QObject {
  Q_OBJECT
 public:
  using QObject::QObject;
  ~ResultJobs() override;  // asks what runs to stop, and waits for nothing

  // Writes files of its own; ends with written(), failed() or, where it was stopped in time, cancelled().
  void write(std::function<Status(const Progress&)> work);
  // Ends with labels_read(), failed() or cancelled(). With `only_results`, what is neither a DICOM
  // Segmentation nor a structure set ends with no_result().
  void read_labels(const std::filesystem::path& file, const Geometry& grid, bool only_results = false);

  [[nodiscard]] bool busy() const { return job_ != nullptr; }
  void cancel();

 signals:
  void progressed(double fraction, const QString& step);
  void written();
  void labels_read(std::shared_ptr<const tidemark::Segments> segments);
  void no_result();
  void failed(const QString& message);
  void cancelled();

 private:
  template <class Work, class Deliver>
  void run(Work work, Deliver deliver);

  std::shared_ptr<BackgroundJob> job_;
};

}  // namespace tidemark
