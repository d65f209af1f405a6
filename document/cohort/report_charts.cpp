#include <algorithm>
#include <cmath>

#include "document/cohort/report_page.h"

namespace tidemark::cohort {
namespace {

constexpr int kWidth = 280;  // of a chart, in its own units
constexpr int kHeight = 150;
constexpr int kBottom = 24;  // for numbers
constexpr int kBins = 24;
constexpr std::size_t kMostPoints = 5000;  // of a scatter plot: more are no more legible

struct Span {
  double low = 0.0;
  double high = 1.0;
  [[nodiscard]] double share(double value) const {
    return high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.5;
  }
};

std::vector<double> values_of(const Review& review, int figure) {
  std::vector<double> values;
  for (const ReviewedCase& one : review.cases) {
    if (const auto value = review_figures()[figure].value(one.status)) values.push_back(*value);
  }
  return values;
}

Span span_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return {*low, *high};
}

std::string frame(const std::string& title, const Span& across, const std::string& inside) {
  return fmt::format(
      "<figure><figcaption>{}</figcaption><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">{}"
      "<line x1=\"0\" y1=\"{}\" x2=\"{}\" y2=\"{}\"/><text x=\"0\" y=\"{}\">{:.4g}</text>"
      "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{:.4g}</text></svg></figure>\n",
      title, kWidth, kHeight, title, inside, kHeight - kBottom, kWidth, kHeight - kBottom, kHeight - 6,
      across.low, kWidth, kHeight - 6, across.high);
}

}  // namespace

std::string histogram_svg(const Review& review, int figure) {
  const std::vector<double> values = values_of(review, figure);
  if (values.empty()) return {};
  const Span span = span_of(values);
  std::vector<int> counts(kBins, 0);
  for (const double value : values) {
    ++counts[std::min<std::size_t>(kBins - 1, static_cast<std::size_t>(span.share(value) * kBins))];
  }
  const int most = *std::max_element(counts.begin(), counts.end());
  std::string bars;
  for (int bin = 0; bin < kBins; ++bin) {
    const int count = counts[static_cast<std::size_t>(bin)];
    if (count == 0) continue;
    const double height = std::max(1.0, static_cast<double>(kHeight - kBottom) * count / most);
    bars += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"><title>{}</title></rect>",
        static_cast<double>(bin) * kWidth / kBins, kHeight - kBottom - height,
        static_cast<double>(kWidth) / kBins - 1.0, height, count);
  }
  return frame(review_figures()[figure].title, span, bars);
}

std::string scatter_svg(const Review& review) {
  const Span across = span_of(values_of(review, 0));
  const Span up = span_of(values_of(review, 1));
  std::string points;
  std::size_t drawn = 0;
  for (const ReviewedCase& one : review.cases) {
    if (!one.status.figures || drawn++ >= kMostPoints) continue;
    points += fmt::format("<a href=\"#case-{}\"><circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.5\"/></a>",
                          html_text(one.status.id), across.share(one.status.figures->volume_ml) * kWidth,
                          (1.0 - up.share(one.status.figures->surface_mm2)) * (kHeight - kBottom));
  }
  if (points.empty()) return {};
  return frame("Area over volume (ml)", across, points);
}

}  // namespace tidemark::cohort
