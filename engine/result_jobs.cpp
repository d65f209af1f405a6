#include "engine/result_jobs.h"

#include "document/result_files.h"

namespace tidemark::engine {

ResultJobs::ResultJobs(QObject* parent) : JobRunner(parent) {}

void ResultJobs::write(std::function<Status(const Progress&)> work) {
  run(std::move(work), [this] { emit written(); });
}

void ResultJobs::read_labels(const std::filesystem::path& file, const Geometry& grid, bool only_results,
                             const std::string& frame_of_reference_uid) {
  using Found = std::shared_ptr<const imaging::Segments>;  // null: no result
  run(
      [=](const Progress& progress) -> Result<Found> {
        if (only_results && !imaging::result_form_of(file)) return Found();
        auto segments = tidemark::document::read_labels(file, &grid, progress);
        if (!segments) return pass_on(segments);
        if (progress.cancelled()) return cancelled_error();
        if (auto remark = imaging::frame_remark(segments->frames_of_reference, frame_of_reference_uid))
          segments->changes.push_back(std::move(*remark));
        return std::make_shared<const imaging::Segments>(std::move(*segments));
      },
      [this](const Found& found) {
        if (!found) return emit no_result();
        emit labels_read(found);
      });
}

}  // namespace tidemark::engine
