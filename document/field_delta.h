// The difference of two level sets on one grid: the pages that are not the same, both ways.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/field.h"

namespace tidemark::document {

// Bytes that a field holds, for the budget of the history.
[[nodiscard]] std::int64_t memory_of(const solver::Field& field);

class FieldDelta {
 public:
  // The fields must have the same grid. Their pages may differ in shape; the delta has the second's.
  FieldDelta(const solver::Field& before, const solver::Field& after);

  [[nodiscard]] bool empty() const { return pages_.empty(); }
  [[nodiscard]] std::int64_t bytes() const;

  // One field from the other (its pages may have any shape).
  [[nodiscard]] solver::Field before(const solver::Field& after) const { return replaced(after, before_); }
  [[nodiscard]] solver::Field after(const solver::Field& before) const { return replaced(before, after_); }

 private:
  struct Side {
    double band = 0.0;
    std::vector<std::int32_t> table;  // for each changed page: which of `values`, or a constant of Field's
    std::vector<float> values;
  };
  static void keep(const solver::Field& field, std::int64_t page, Side& side);
  [[nodiscard]] solver::Field replaced(const solver::Field& field, const Side& side) const;

  solver::PageLayout layout_;
  std::vector<std::int64_t> pages_;  // ascending
  Side before_;
  Side after_;
};

}  // namespace tidemark::document
