// phi of several states of one level set, for session files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/result.h"
#include "solver/field.h"

namespace tidemark::document {

// A page that several states have is there once.
class SharedPages {
 public:
  SharedPages() = default;
  // Of fields on that grid with that band.
  SharedPages(const Geometry& geometry, double band, Index3 page_shape);

  // The next state. Its pages are compared with those of the state `like`, unless it is the first.
  void add(const solver::Field& phi, std::size_t like);
  [[nodiscard]] solver::Field field(std::size_t state) const;
  [[nodiscard]] std::size_t size() const { return tables_.size(); }

  // Of the pages and tables.
  [[nodiscard]] std::int64_t bytes() const;

  // Files.
  [[nodiscard]] Index3 page_shape() const { return empty_.layout.page_shape(); }
  [[nodiscard]] const std::vector<float>& pages() const { return pages_; }
  [[nodiscard]] const std::vector<std::vector<std::int32_t>>& tables() const { return tables_; }
  // Fails (ErrorKind::input) when a table names a page that is not there, or a value is not finite or beyond
  // the band. `what` is for the message.
  Status assign(std::vector<float> pages, std::vector<std::vector<std::int32_t>> tables,
                const std::string& what);

 private:
  solver::Field empty_;  // grid, band and the shape of pages
  std::vector<float> pages_;
  std::vector<std::vector<std::int32_t>> tables_;  // a state: a virtual page's index in `pages_`, as Field's
};

}  // namespace tidemark::document
