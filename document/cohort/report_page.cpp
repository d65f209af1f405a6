#include "document/cohort/report_page.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <system_error>
#include <unordered_map>

#include "core/base64.h"
#include "core/text_file.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestPicture = std::size_t{8} << 20;  // bytes

std::string_view part(std::string_view name) {
  for (const PagePart& one : page_parts()) {
    if (one.name == name) return one.text;
  }
  return {};
}

// The page with its marks (@NAME@) replaced. What is put in is not looked at again: a case's name may look
// like a mark.
std::string filled(std::string_view page, const std::map<std::string_view, std::string>& marks) {
  std::string text;
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t begin = page.find('@', at);
    const std::size_t end = begin == std::string_view::npos ? begin : page.find('@', begin + 1);
    text += page.substr(at, begin - at);
    if (end == std::string_view::npos) break;
    const auto mark = marks.find(page.substr(begin + 1, end - begin - 1));
    if (mark != marks.end()) text += mark->second;
    at = end + 1;
  }
  return text;
}

std::string picture_of(const CohortFolder& folder, const CaseStatus& status, PagePictures pictures) {
  const std::string name = "overview.png";
  if (std::find(status.files.begin(), status.files.end(), name) == status.files.end()) return {};
  std::string source = "cases/" + status.id + "/" + name;
  if (pictures == PagePictures::embed) {
    const auto bytes = read_text_file(folder.case_folder(status.id) / name, kLargestPicture);
    if (!bytes) return {};
    source = "data:image/png;base64," + to_base64(*bytes);
  }
  return fmt::format(
      "<img loading=\"lazy\" decoding=\"async\" alt=\"Three slices with the outline, and the surface\" "
      "src=\"{}\">",
      html_text(source));
}

std::string figures_of(const ReviewedCase& one) {
  std::string text;
  for (int figure = 0; figure < kReviewFigures; ++figure) {
    const auto value = review_figures()[static_cast<std::size_t>(figure)].value(one.status);
    if (!value) continue;
    const double z = one.z[figure].value_or(0.0);
    text += fmt::format("<tr{}><th>{}</th><td>{:.5g}</td><td>{:+.1f}</td></tr>",
                        std::abs(z) > kFarOff ? " class=\"far\"" : "",
                        review_figures()[static_cast<std::size_t>(figure)].title, *value, z);
  }
  return text;
}

// What the folder keeps of a case.
std::string decision_of(const Decision& decision) {
  return fmt::format(" data-decision=\"{}\" data-comment=\"{}\"", word_of(decision.verdict),
                     html_text(decision.comment));
}

using Decisions = std::unordered_map<std::string_view, const Decision*>;

std::string card_of(const CohortFolder& folder, const ReviewedCase& one, const Decisions& decisions,
                    PagePictures pictures) {
  const CaseStatus& status = one.status;
  std::string warnings = status.corrected ? "<b>corrected</b> " : "";
  for (const CaseWarning warning : status.warnings) {
    warnings += fmt::format("<b class=\"warning\">{}</b> ", words_of(warning));
  }
  const std::string id = html_text(status.id);
  std::string card =
      fmt::format("<article id=\"case-{}\" data-id=\"{}\" data-finished=\"{}\" data-outcome=\"{}\"", id, id,
                  html_text(status.finished), name_of(status.outcome));
  if (const auto said = decisions.find(status.id); said != decisions.end())
    card += decision_of(*said->second);
  card += fmt::format(" tabindex=\"0\"><h2>{}</h2>", id);
  card += picture_of(folder, status, pictures);
  if (status.outcome != CaseOutcome::done) {
    card += fmt::format("<p class=\"failed\">{}: {}</p>", words_of(status.outcome), html_text(status.reason));
  }
  card += fmt::format("<table>{}</table><p>{}{:.2f} s, {} MB</p>", figures_of(one), warnings, status.seconds,
                      status.peak_memory_bytes >> 20);
  for (const std::string& remark : status.remarks) {
    card += "<p class=\"remark\">" + html_text(remark) + "</p>";
  }
  card += fmt::format("<p class=\"input\">{}</p>", html_text(status.input));
  if (status.outcome == CaseOutcome::done) card += fmt::format("<a href=\"cases/{}/\">files</a>", id);
  return card + "<p class=\"verdict\"></p></article>\n";
}

std::string summary_of(const Review& review) {
  std::string text;
  for (const CaseOutcome outcome : {CaseOutcome::done, CaseOutcome::refused, CaseOutcome::timed_out,
                                    CaseOutcome::out_of_memory, CaseOutcome::failed}) {
    const std::int64_t count = review.count(outcome);
    if (count > 0 || outcome == CaseOutcome::done) text += fmt::format("{} {}, ", count, words_of(outcome));
  }
  text += fmt::format("{} not computed yet", review.not_done.size());
  if (review.cases.size() > kMostCards) {
    text += fmt::format("; the {} most unusual are below, all are in report.csv", kMostCards);
  }
  if (!review.unreadable.empty()) {
    text += fmt::format(", {} with a status that cannot be read, first {}", review.unreadable.size(),
                        review.unreadable.front());
  }
  return html_text(text);
}

}  // namespace

std::string html_text(std::string_view text) {
  std::string html;
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return html;
}

PagePictures suitable_pictures(const CohortFolder& folder, const Review& review) {
  std::int64_t bytes = 0;
  for (const ReviewedCase& one : review.cases) {
    std::error_code error;
    const auto size = fs::file_size(folder.case_folder(one.status.id) / "overview.png", error);
    if (!error) bytes += static_cast<std::int64_t>(size);
    if (bytes > kMostEmbedded) return PagePictures::link;
  }
  return PagePictures::embed;
}

Result<std::string> report_page(const CohortFolder& folder, const CohortPlan& plan, const Review& review,
                                PagePictures pictures, const Progress& progress) {
  Decisions decisions;
  for (const Decision& decision : review.decisions) decisions.emplace(decision.id, &decision);
  std::string cards;
  const std::size_t count = std::min(review.cases.size(), kMostCards);
  for (std::size_t i = 0; i < count; ++i) {
    if (progress.cancelled()) return cancelled_error();
    progress(static_cast<double>(i) / static_cast<double>(count), "writing the report");
    cards += card_of(folder, review.cases[i], decisions, pictures);
  }
  std::string charts;
  for (int figure = 0; figure < kReviewFigures; ++figure) charts += histogram_svg(review, figure);
  charts += scatter_svg(review);
  const std::string name = html_text(folder.path().filename().string());
  return filled(part("page.html"), {{"STYLE", std::string(part("page.css"))},
                                    {"SCRIPT", std::string(part("page.js"))},
                                    {"PLAN", html_text(plan.planned + " " + plan.recipe_checksum)},
                                    {"TITLE", name},
                                    {"NAME", name},
                                    {"SUMMARY", summary_of(review)},
                                    {"CHARTS", charts},
                                    {"CASES", cards}});
}

}  // namespace tidemark::cohort
