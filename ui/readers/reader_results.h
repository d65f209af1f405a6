// The outcome of a comparison of readers, as a table for programs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "document/comparison.h"
#include "imaging/regions/staple.h"

namespace tidemark::ui {

struct ComparedPair {
  std::size_t first = 0;  // of the names
  std::size_t second = 0;
  document::Comparison comparison;

  [[nodiscard]] double first_ml() const;
  [[nodiscard]] double second_ml() const;
};

struct ReaderResults {
  std::vector<std::string> names;  // of the readers
  std::string region;              // that was compared of files; empty: all together
  double voxel_ml = 0.0;
  std::vector<ComparedPair> pairs;
  std::shared_ptr<const imaging::TruthEstimate> estimate;  // null: not yet

  // Of the estimate.
  [[nodiscard]] double estimate_ml() const;
};

// RFC 4180, numbers with a point in every locale: a line a pair, then one of each reader with the estimate,
// which is called "STAPLE". Names of columns do not depend on the language.
std::string to_csv(const ReaderResults& results);

}  // namespace tidemark::ui
