#include "document/drive.h"

namespace tidemark::document {

std::int64_t bytes_of(const Drive& drive) {
  std::size_t bytes = 0;
  if (drive.strokes)
    bytes += (drive.strokes->inside.size() + drive.strokes->outside.size()) * sizeof(std::int64_t);
  // Pages are shared with the constraints before; the list of them is not.
  if (drive.constraints) {
    bytes += static_cast<std::size_t>(drive.constraints->layout().page_count()) *
             sizeof(std::shared_ptr<const solver::Constraints::Page>);
  }
  return static_cast<std::int64_t>(bytes);
}

}  // namespace tidemark::document
