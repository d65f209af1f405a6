// The report of a cohort as one HTML page that needs no network and no other program.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/progress.h"
#include "document/cohort/review.h"

namespace tidemark::cohort {

// A part of the page: its name and text.
struct PagePart {
  std::string_view name;
  std::string_view text;
};
[[nodiscard]] std::span<const PagePart> page_parts();

// Text as HTML shows it: no tag, no attribute and no script comes of it.
[[nodiscard]] std::string html_text(std::string_view text);

// Where the pictures of cases are.
enum class PagePictures {
  embed,  // in the page
  link,   // in the cases' folders, beside the page
};
// Pictures in a page may take so many bytes before a browser is slow to open it.
inline constexpr std::int64_t kMostEmbedded = std::int64_t{32} << 20;
// By the sizes of the pictures that are there.
[[nodiscard]] PagePictures suitable_pictures(const CohortFolder& folder, const Review& review);

// Cards of a page: a browser scrolls through so many. The tables have all cases.
inline constexpr std::size_t kMostCards = 20'000;

// Counts, histograms and a scatter plot, then a card a case, in the review's order. A browser keeps what is
// said there for the plan and for the result of the case. Fails with ErrorKind::cancelled; a picture that
// cannot be read is left out.
Result<std::string> report_page(const CohortFolder& folder, const CohortPlan& plan, const Review& review,
                                PagePictures pictures, const Progress& progress = {});

// A histogram of a figure, and area over volume, as SVG.
[[nodiscard]] std::string histogram_svg(const Review& review, int figure);
[[nodiscard]] std::string scatter_svg(const Review& review);

}  // namespace tidemark::cohort
