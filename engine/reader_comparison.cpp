#include "engine/reader_comparison.h"

#include <utility>

namespace tidemark::engine {
namespace {

Region region_of(const Reader& reader, const ReaderQuestion& question) {
  if (!reader.file) return question.of_case.region(reader.label);
  if (question.region.empty() || reader.file->list.size() == 1) return reader.file->all();
  const Region* found = reader.file->find(question.region);
  return found == nullptr ? Region() : *found;
}

}  // namespace

void ReaderComparison::read(const std::filesystem::path& file, const Geometry& grid) {
  using Found = std::shared_ptr<const document::FileRegions>;
  run(
      [file, on = std::optional(grid)](const Progress& progress) -> Result<Found> {
        std::optional<Geometry> given = on;
        auto regions = document::read_regions(file, true, given, progress);
        if (!regions) return pass_on(regions);
        return std::make_shared<const document::FileRegions>(std::move(*regions));
      },
      [this](const Found& found) { emit was_read(found); });
}

void ReaderComparison::compare(ReaderQuestion question) {
  grid_ = question.of_case.geometry;
  run(
      [question = std::move(question)](const Progress& progress) -> Result<Regions> {
        progress(-1.0, "comparing readers");
        std::vector<Region> regions;
        for (const Reader& reader : question.readers) {
          if (progress.cancelled()) return cancelled_error();
          regions.push_back(region_of(reader, question));
        }
        return std::make_shared<const std::vector<Region>>(std::move(regions));
      },
      [this](const Regions& regions) {
        regions_ = regions;
        done_ = 0;
        compare_pair(0, 1);
      });
}

std::size_t ReaderComparison::pieces() const {
  return regions_->size() * (regions_->size() - 1) / 2 + 1;
}

void ReaderComparison::compare_pair(std::size_t first, std::size_t second) {
  const double fraction = static_cast<double>(done_++) / static_cast<double>(pieces());
  run(
      [=, regions = regions_, grid = grid_](const Progress& progress) {
        progress(fraction, "comparing readers");
        return document::compare((*regions)[first], (*regions)[second], grid, {nullptr, progress.stop});
      },
      [=, this](const document::Comparison& comparison) {
        emit pair_compared(first, second, comparison);
        if (second + 1 < regions_->size()) return compare_pair(first, second + 1);
        if (first + 2 < regions_->size()) return compare_pair(first + 1, first + 2);
        estimate();
      });
}

void ReaderComparison::estimate() {
  using Found = std::shared_ptr<const imaging::TruthEstimate>;
  const double fraction = static_cast<double>(done_) / static_cast<double>(pieces());
  run(
      [=, regions = regions_, grid = grid_](const Progress& progress) -> Result<Found> {
        progress(fraction, "estimating the truth");
        auto found = imaging::estimate_truth(*regions, grid, progress);
        if (!found) return pass_on(found);
        return std::make_shared<const imaging::TruthEstimate>(std::move(*found));
      },
      [this](const Found& found) {
        regions_.reset();
        emit estimated(found);
      });
}

}  // namespace tidemark::engine
