#include "document/cohort/cohort_folder.h"

#include <system_error>

#include "core/atomic_file.h"
#include "core/json/json.h"
#include "core/json/json_field.h"
#include "core/json/json_text.h"
#include "core/text_file.h"
#include "document/checksum.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "tidemark cohort";
constexpr int kPlanVersion = 1;
constexpr std::size_t kLargestPlan = std::size_t{1} << 20;  // bytes

Json to_json(const CohortPlan& plan) {
  Json outputs = Json::array();
  for (const CaseOutput output : plan.outputs)
    outputs.push_back(output_names()[static_cast<std::size_t>(output)]);
  Json json{{"format", kFormat},       {"version", kPlanVersion},   {"recipe_checksum", plan.recipe_checksum},
            {"outputs", outputs},      {"pictures", plan.pictures}, {"source", plan.source},
            {"program", plan.program}, {"planned", plan.planned}};
  if (!plan.servers_file.empty()) json["servers"] = plan.servers_file.string();
  return json;
}

Result<CohortPlan> read_plan(std::string_view text, const std::string& file) {
  const auto document = JsonDocument::parse(text, file, {kLargestPlan, 10'000, 8});
  if (!document) return pass_on(document);
  const JsonField root = root_of(*document, file);
  root.at("format").must_be(kFormat);
  static_cast<void>(root.at("version").integer(1, kPlanVersion));
  CohortPlan plan;
  plan.recipe_checksum = root.at("recipe_checksum").text();
  const JsonField outputs = root.at("outputs");
  const std::size_t count = outputs.size(output_names().size());
  for (std::size_t i = 0; i < count; ++i) {
    plan.outputs.push_back(static_cast<CaseOutput>(outputs.at(i).word(output_names())));
  }
  plan.pictures = root.at("pictures").boolean();
  plan.source = root.at("source").text();
  plan.program = root.at("program").text();
  plan.planned = root.at("planned").text();
  if (root.has("servers")) plan.servers_file = root.at("servers").text();
  if (!root.good()) return tl::unexpected(root.status().error());
  return plan;
}

Status make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return {};
  return fail(ErrorKind::write, "{}: cannot be made: {}", folder.string(), error.message());
}

}  // namespace

const std::vector<std::string_view>& output_names() {
  static const std::vector<std::string_view> kNames{"seg", "rtstruct", "surface", "phi"};
  return kNames;
}

bool CohortFolder::is_planned() const {
  std::error_code ignored;
  return fs::exists(plan(), ignored);
}

Status CohortFolder::check_free() const {
  if (is_planned()) {
    return fail(ErrorKind::usage, "{}: holds a cohort already; name a new folder", folder_.string());
  }
  std::error_code ignored;
  for (const fs::path& file : {work_list(), recipe()}) {
    if (!fs::exists(file, ignored)) continue;
    return fail(ErrorKind::usage, "{}: is there already, and a plan would replace it; name a new folder",
                file.string());
  }
  return {};
}

Result<std::vector<std::string>> CohortFolder::finished_ids() const {
  std::vector<std::string> ids;
  std::error_code error;
  for (fs::directory_iterator entry(cases(), error), end; !error && entry != end; entry.increment(error)) {
    ids.push_back(entry->path().filename().string());
  }
  if (error) return fail(ErrorKind::input, "{}: cannot be read: {}", cases().string(), error.message());
  return ids;
}

Result<CohortPlan> CohortFolder::load_plan() const {
  if (!is_planned()) {
    return fail(ErrorKind::input, "{}: is no cohort: it has no plan.json (see cohort plan)",
                folder_.string());
  }
  const auto text = read_text_file(plan(), kLargestPlan);
  if (!text) return pass_on(text);
  auto plan = read_plan(*text, this->plan().string());
  if (!plan || plan->recipe_checksum.empty()) return plan;
  const auto recipe_text = read_text_file(recipe(), document::Recipe::kLargestFile);
  if (!recipe_text) return pass_on(recipe_text);
  if (document::sha256(std::as_bytes(std::span(*recipe_text))) != plan->recipe_checksum) {
    return fail(ErrorKind::input, "{}: is another one than was planned with", recipe().string());
  }
  auto shared = SharedRecipe::parse(*recipe_text, recipe().string(), true);
  if (!shared) return pass_on(shared);
  plan->recipe = std::move(*shared);
  return plan;
}

Result<WorkList> CohortFolder::load_work_list() const {
  auto list = WorkList::load(work_list());
  if (list && !list->problems.empty()) return fail(ErrorKind::input, "{}", list->problems.front());
  return list;
}

Status CohortFolder::write_plan(const CohortPlan& plan, const WorkList& list,
                                const std::string& recipe_text) const {
  TIDEMARK_TRY(check_free());
  for (const fs::path& folder : {cases(), leases(), staging()}) {
    TIDEMARK_TRY(make_folder(folder));
  }
  Status written;
  if (!recipe_text.empty()) written = write_file(recipe(), recipe_text);
  if (written) written = write_file(work_list(), list.to_text());
  if (written) written = write_file(this->plan(), json_text(to_json(plan)));
  if (written) return written;
  // They would stand in the way of the next try.
  std::error_code ignored;
  for (const fs::path& file : {recipe(), work_list()}) fs::remove(file, ignored);
  return written;
}

}  // namespace tidemark::cohort
