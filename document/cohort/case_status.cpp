#include "document/cohort/case_status.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>

#include "core/json/json.h"
#include "core/json/json_field.h"
#include "core/json/json_text.h"
#include "core/text_file.h"

namespace tidemark::cohort {
namespace {

const std::vector<std::string_view> kOutcomes{"done", "refused", "timed_out", "out_of_memory", "failed"};
const std::vector<std::string_view> kWarnings{"vanished", "filled", "not_converged", "touches_border"};
constexpr std::int64_t kMost = std::int64_t{1} << 53;
constexpr std::size_t kMostTexts = 1000;
constexpr std::size_t kLongestText = 4096;                    // bytes
constexpr std::size_t kLongestReason = std::size_t{1} << 16;  // bytes, and of all remarks together

Json to_json(const CaseFigures& figures) {
  Json object{{"volume_ml", figures.volume_ml},
              {"surface_mm2", figures.surface_mm2},
              {"voxels_inside", figures.voxels_inside},
              {"steps", figures.steps},
              {"solver_seconds", figures.solver_seconds},
              {"solver_outcome", figures.solver_outcome},
              {"unit", figures.unit}};
  if (figures.mean_inside) object["mean_inside"] = *figures.mean_inside;
  if (figures.dice) object["dice"] = *figures.dice;
  return object;
}

CaseFigures read_figures(const JsonField& field) {
  CaseFigures figures;
  figures.volume_ml = field.at("volume_ml").number(0.0);
  figures.surface_mm2 = field.at("surface_mm2").number(0.0);
  figures.voxels_inside = field.at("voxels_inside").integer(0, kMost);
  figures.steps = field.at("steps").integer(0, kMost);
  figures.solver_seconds = field.at("solver_seconds").number(0.0);
  figures.solver_outcome = field.at("solver_outcome").text();
  figures.unit = field.at("unit").text();
  if (field.has("mean_inside")) figures.mean_inside = field.at("mean_inside").number();
  if (field.has("dice")) figures.dice = field.at("dice").number(0.0, 1.0);
  return figures;
}

std::vector<std::string> read_texts(const JsonField& field) {
  std::vector<std::string> texts;
  const std::size_t count = field.size(kMostTexts);
  for (std::size_t i = 0; i < count; ++i) texts.push_back(field.at(i).text(kLongestText));
  return texts;
}

// At most so many bytes, of whole characters of UTF-8.
std::string_view beginning_of(std::string_view text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0U) == 0x80U) --most;
  return text.substr(0, most);
}

// As many remarks as are read.
Json to_json(const std::vector<std::string>& remarks) {
  Json list = Json::array();
  std::size_t left = kLongestReason;
  for (const std::string& remark : remarks) {
    const std::string_view text = beginning_of(remark, std::min(kLongestText, left));
    if (list.size() == kMostTexts || (text.empty() && !remark.empty())) break;
    list.push_back(text);
    left -= text.size();
  }
  return list;
}

}  // namespace

std::string_view name_of(CaseOutcome outcome) {
  return kOutcomes[static_cast<std::size_t>(outcome)];
}

std::string_view name_of(CaseWarning warning) {
  return kWarnings[static_cast<std::size_t>(warning)];
}

std::string_view words_of(CaseWarning warning) {
  switch (warning) {
    case CaseWarning::vanished:
      return "vanished";
    case CaseWarning::filled:
      return "filled the volume";
    case CaseWarning::not_converged:
      return "still moving";
    case CaseWarning::touches_border:
      return "touches the border";
  }
  return {};
}

std::string_view words_of(CaseOutcome outcome) {
  switch (outcome) {
    case CaseOutcome::done:
      return "done";
    case CaseOutcome::refused:
      return "refused";
    case CaseOutcome::timed_out:
      return "timed out";
    case CaseOutcome::out_of_memory:
      return "out of memory";
    case CaseOutcome::failed:
      return "failed";
  }
  return {};
}

std::string CaseStatus::to_text() const {
  Json object{{"format", "tidemark case status"},
              {"version", kVersion},
              {"id", id},
              {"outcome", name_of(outcome)},
              {"reason", beginning_of(reason, kLongestReason)},
              {"attempt", attempt},
              {"input", input},
              {"series", series},
              {"input_checksum", input_checksum},
              {"recipe_checksum", recipe_checksum},
              {"program", program},
              {"machine", machine},
              {"finished", finished},
              {"seconds", seconds},
              {"peak_memory_bytes", peak_memory_bytes},
              {"warnings", Json::array()},
              {"remarks", to_json(remarks)},
              {"files", files}};
  for (const CaseWarning warning : warnings) object["warnings"].push_back(name_of(warning));
  if (figures) object["figures"] = to_json(*figures);
  if (corrected) object["corrected"] = true;
  return json_text(object);
}

Result<CaseStatus> CaseStatus::parse(std::string_view text, const std::string& file) {
  const auto document = JsonDocument::parse(text, file, {kLargestFile, 20'000, 8});
  if (!document) return pass_on(document);
  const JsonField root = root_of(*document, file);
  root.at("format").must_be("tidemark case status");
  static_cast<void>(root.at("version").integer(1, kVersion));
  CaseStatus status;
  status.id = root.at("id").text();
  status.outcome = static_cast<CaseOutcome>(root.at("outcome").word(kOutcomes));
  status.reason = root.at("reason").text(kLongestReason);
  status.attempt = root.at("attempt").integer(1, kMost);
  status.input = root.at("input").text();
  status.series = root.at("series").text();
  status.input_checksum = root.at("input_checksum").text();
  status.recipe_checksum = root.at("recipe_checksum").text();
  status.program = root.at("program").text();
  status.machine = root.at("machine").text();
  status.finished = root.at("finished").text();
  status.seconds = root.at("seconds").number(0.0);
  status.peak_memory_bytes = root.at("peak_memory_bytes").integer(0, kMost);
  const JsonField warnings = root.at("warnings");
  const std::size_t count = warnings.size(kWarnings.size());
  for (std::size_t i = 0; i < count; ++i) {
    status.warnings.push_back(static_cast<CaseWarning>(warnings.at(i).word(kWarnings)));
  }
  status.remarks = read_texts(root.at("remarks"));
  status.files = read_texts(root.at("files"));
  if (root.has("corrected")) status.corrected = root.at("corrected").boolean();
  if (root.has("figures")) status.figures = read_figures(root.at("figures"));
  if (!root.good()) return tl::unexpected(root.status().error());
  return status;
}

Result<CaseStatus> CaseStatus::load(const std::filesystem::path& file) {
  const auto text = read_text_file(file, kLargestFile);
  if (!text) return pass_on(text);
  return parse(*text, file.string());
}

std::string utc_now() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm parts{};
  ::gmtime_r(&now, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec);
}

}  // namespace tidemark::cohort
