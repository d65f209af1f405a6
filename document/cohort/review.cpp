#include "document/cohort/review.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_set>
#include <utility>

#include "core/csv.h"
#include "core/json/json.h"
#include "core/json/json_text.h"

namespace tidemark::cohort {
namespace {

constexpr double kNormalMad = 0.6745;    // of a normal distribution, in standard deviations
constexpr double kNormalMean = 0.79788;  // its mean deviation

double median_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

constexpr ReviewFigure kFigures[kReviewFigures] = {
    {"volume_ml", "Volume (ml)",
     [](const CaseStatus& status) {
       return status.figures ? std::optional(status.figures->volume_ml) : std::nullopt;
     }},
    {"surface_mm2", "Area (mm\xC2\xB2)",
     [](const CaseStatus& status) {
       return status.figures ? std::optional(status.figures->surface_mm2) : std::nullopt;
     }},
    {"mean_inside", "Mean inside",
     [](const CaseStatus& status) { return status.figures ? status.figures->mean_inside : std::nullopt; }},
    {"dice", "Dice",
     [](const CaseStatus& status) { return status.figures ? status.figures->dice : std::nullopt; }},
};

// What there is to compare, the most urgent last. A surface that has vanished or fills the volume is none.
enum class Comparable { surface, no_surface, no_result };

Comparable comparable(const CaseStatus& status) {
  if (status.outcome != CaseOutcome::done) return Comparable::no_result;
  const bool has_surface = std::none_of(
      status.warnings.begin(), status.warnings.end(),
      [](CaseWarning warning) { return warning == CaseWarning::vanished || warning == CaseWarning::filled; });
  return has_surface ? Comparable::surface : Comparable::no_surface;
}

bool comes_before(const ReviewedCase& a, const ReviewedCase& b) {
  return std::pair(comparable(a.status), a.unusual) > std::pair(comparable(b.status), b.unusual);
}

void set_scales(Review& review) {
  for (int figure = 0; figure < kReviewFigures; ++figure) {
    std::vector<double> values;
    for (const ReviewedCase& one : review.cases) {
      if (comparable(one.status) != Comparable::surface) continue;
      if (const auto value = kFigures[figure].value(one.status)) values.push_back(*value);
    }
    review.scales[figure] = RobustScale::of(std::move(values));
  }
}

void set_unusual(Review& review) {
  for (ReviewedCase& one : review.cases) {
    for (int figure = 0; figure < kReviewFigures; ++figure) {
      const auto value = kFigures[figure].value(one.status);
      if (!value) continue;
      one.z[figure] = review.scales[figure].z(*value);
      one.unusual = std::max(one.unusual, std::abs(*one.z[figure]));
    }
  }
}

std::string joined(const std::vector<CaseWarning>& warnings) {
  std::string text;
  for (const CaseWarning warning : warnings) {
    if (!text.empty()) text += ' ';
    text += name_of(warning);
  }
  return text;
}

std::string number(std::optional<double> value) {
  return value ? fmt::format("{:.6g}", *value) : std::string();
}

}  // namespace

RobustScale RobustScale::of(std::vector<double> values) {
  RobustScale scale;
  if (values.empty()) return scale;
  scale.median = median_of(values);
  for (double& value : values) value = std::abs(value - scale.median);
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  const double mad = median_of(values);
  scale.spread = mad > 0.0 ? mad / kNormalMad : mean / kNormalMean;
  return scale;
}

std::span<const ReviewFigure, kReviewFigures> review_figures() {
  return kFigures;
}

std::int64_t Review::count(CaseOutcome outcome) const {
  return std::count_if(cases.begin(), cases.end(),
                       [&](const ReviewedCase& one) { return one.status.outcome == outcome; });
}

Result<Review> review(const CohortFolder& folder, const WorkList& list, const Progress& progress) {
  const auto ids = folder.finished_ids();
  if (!ids) return pass_on(ids);
  const std::unordered_set<std::string> done(ids->begin(), ids->end());
  Review review;
  for (std::size_t i = 0; i < list.rows.size(); ++i) {
    if (progress.cancelled()) return cancelled_error();
    progress(static_cast<double>(i) / static_cast<double>(list.rows.size()), "reading results");
    const std::string& id = list.rows[i].id;
    if (!done.contains(id)) {
      review.not_done.push_back(id);
      continue;
    }
    auto status = CaseStatus::load(folder.status(id));
    if (status) {
      status->id = id;  // what pages link to is the folder's name
      review.cases.push_back({std::move(*status), {}, 0.0});
    } else {
      review.unreadable.push_back(status.error().message);
    }
  }
  if (auto decisions = load_decisions(folder)) {
    review.decisions = std::move(*decisions);
  } else {
    review.unreadable.push_back(decisions.error().message);
  }
  set_scales(review);
  set_unusual(review);
  std::stable_sort(review.cases.begin(), review.cases.end(), comes_before);
  return review;
}

std::string review_csv(const Review& review) {
  std::vector<std::string> names{"id", "outcome", "unusual"};
  for (const ReviewFigure& figure : kFigures) {
    names.emplace_back(figure.name);
    names.push_back(std::string("z_") + figure.name);
  }
  for (const char* name :
       {"steps", "seconds", "peak_memory_mb", "warnings", "reason", "input", "series", "corrected"}) {
    names.emplace_back(name);
  }
  std::string text = csv_line(names);
  for (const ReviewedCase& one : review.cases) {
    const CaseStatus& status = one.status;
    const bool done = status.outcome == CaseOutcome::done;
    std::vector<std::string> fields{csv_text(status.id), std::string(name_of(status.outcome)),
                                    done ? number(one.unusual) : std::string()};
    for (int figure = 0; figure < kReviewFigures; ++figure) {
      fields.push_back(number(kFigures[figure].value(status)));
      fields.push_back(number(one.z[figure]));
    }
    fields.push_back(status.figures ? std::to_string(status.figures->steps) : std::string());
    fields.push_back(number(status.seconds));
    fields.push_back(std::to_string(status.peak_memory_bytes >> 20));
    for (const std::string& field : {joined(status.warnings), status.reason, status.input, status.series}) {
      fields.push_back(csv_text(field));
    }
    fields.emplace_back(status.corrected ? "yes" : "");
    text += csv_line(fields);
  }
  return text;
}

std::string review_json(const Review& review) {
  Json object{{"cases", Json::array()}, {"not_done", review.not_done}, {"unreadable", review.unreadable}};
  for (int figure = 0; figure < kReviewFigures; ++figure) {
    object["scales"][kFigures[figure].name] = {{"median", review.scales[figure].median},
                                               {"spread", review.scales[figure].spread}};
  }
  for (const ReviewedCase& one : review.cases) {
    const CaseStatus& status = one.status;
    Json entry{{"id", status.id},
               {"outcome", name_of(status.outcome)},
               {"seconds", status.seconds},
               {"peak_memory_bytes", status.peak_memory_bytes},
               {"reason", status.reason},
               {"input", status.input},
               {"corrected", status.corrected},
               {"warnings", Json::array()}};
    for (const CaseWarning warning : status.warnings) entry["warnings"].push_back(name_of(warning));
    if (status.outcome == CaseOutcome::done) entry["unusual"] = one.unusual;
    for (int figure = 0; figure < kReviewFigures; ++figure) {
      if (const auto value = kFigures[figure].value(status)) entry[kFigures[figure].name] = *value;
      if (one.z[figure]) entry["z"][kFigures[figure].name] = *one.z[figure];
    }
    object["cases"].push_back(std::move(entry));
  }
  return json_text(object, 1);
}

}  // namespace tidemark::cohort
