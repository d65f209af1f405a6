// phi as bytes for files: a page table and the pages that it names.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/result.h"
#include "solver/field.h"

namespace tidemark::document {

// The pages with every padding voxel set, so that equal fields give equal bytes.
[[nodiscard]] std::vector<float> pages_for_file(const solver::Field& phi);

// Checks the table and the values, and makes a field of them. Fails (ErrorKind::input) when the table names
// missing pages, or one twice, or when a value is not finite or beyond the band. `what` is for the message.
Result<solver::Field> field_from_file(const Geometry& geometry, double band, Index3 page_shape,
                                      std::vector<std::int32_t> table, std::vector<float> pages,
                                      const std::string& what);

// Page shapes that files may name: those that executors have.
[[nodiscard]] bool is_page_shape(Index3 shape);

}  // namespace tidemark::document
