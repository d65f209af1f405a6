// The comparison of several readers' segmentations of a case, beside the user interface.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "document/comparison.h"
#include "document/file_regions.h"
#include "document/label_tool.h"
#include "engine/job_runner.h"
#include "imaging/regions/staple.h"

namespace tidemark::engine {

// A segmentation that takes part: the surface or a label of the case, or what a file holds.
struct Reader {
  std::uint8_t label = document::kTheSurface;         // of the case, where there is no file
  std::shared_ptr<const document::FileRegions> file;  // null: the case's own

  bool operator==(const Reader&) const = default;
};

struct ReaderQuestion {
  document::LabelVoxels of_case;
  std::vector<Reader> readers;
  // Of files with several regions the one of that name, nothing where there is none; empty: all together.
  std::string region;
};

// One piece of work at a time: reading a file, or a comparison.
class ReaderComparison : public JobRunner {
  Q_OBJECT
 public:
  using JobRunner::JobRunner;

  // Onto the case's grid; ends with was_read(), failed() or cancelled().
  void read(const std::filesystem::path& file, const Geometry& grid);
  // Each reader with each other, then STAPLE's estimate of all. Ends with estimated(), failed() or
  // cancelled().
  void compare(ReaderQuestion question);
  void cancel() { give_up(); }

 signals:
  void was_read(std::shared_ptr<const tidemark::document::FileRegions> regions);
  // Readers by their place in the question.
  void pair_compared(std::size_t first, std::size_t second, const tidemark::document::Comparison& comparison);
  void estimated(std::shared_ptr<const tidemark::imaging::TruthEstimate> estimate);

 private:
  using Regions = std::shared_ptr<const std::vector<Region>>;
  void compare_pair(std::size_t first, std::size_t second);
  void estimate();
  // Of this comparison, from the pieces of work that are done.
  [[nodiscard]] std::size_t pieces() const;

  Geometry grid_;
  Regions regions_;
  std::size_t done_ = 0;
};

}  // namespace tidemark::engine
