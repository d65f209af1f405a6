// The opacity of the source page by page, so that rays and slices skip pages that show nothing.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "core/paging/page_layout.h"
#include "renderer/views.h"

namespace tidemark::renderer {

class PageOpacity {
 public:
  PageOpacity() = default;
  explicit PageOpacity(const PageLayout& layout) : layout_(layout) {}

  // Works out pages() for that function, in the source's own units. Returns false when they are as they were.
  bool set_transfer_function(const Volume& source, const TransferFunction& function, Region region,
                             double band);

  // The greatest opacity of a mm in each page of V_P: where it is outside throughout, inside throughout, and
  // holds the surface. The fourth number is 0.
  [[nodiscard]] const std::vector<glm::vec4>& pages() const { return pages_; }

 private:
  struct Shown {
    TransferFunction function;
    Region region;
    double band;
    bool operator==(const Shown&) const = default;
  };

  PageLayout layout_;
  std::vector<glm::vec2> ranges_;  // of the values in each page; empty until a transfer function needs them
  std::vector<glm::vec4> pages_;
  std::optional<Shown> shown_;
};

}  // namespace tidemark::renderer
