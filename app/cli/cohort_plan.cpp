// tidemark-cli cohort plan: from studies and a recipe to a work list.
#include <map>
#include <memory>
#include <set>
#include <span>

#include "app/cli/arguments.h"
#include "app/cli/cohort_commands.h"
#include "app/cli/pacs_commands.h"
#include "app/cli/shell_word.h"
#include "core/text_file.h"
#include "document/checksum.h"
#include "document/cohort/case_status.h"
#include "document/cohort/cohort_folder.h"
#include "document/cohort/decisions.h"
#include "document/cohort/find_cases.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kCohortPlan{
    "plan", "Makes a work list of studies in a folder, in BIDS, in a list or on a server",
    "Writes DIR/work.csv, a row a case, and DIR/plan.json; nothing is computed. SOURCE is a folder with "
    "studies\n"
    "anywhere below it, a BIDS dataset, a list (.csv, its columns named by its first line; input or server "
    "is\n"
    "needed), an earlier cohort's folder, or pacs:SERVER, whose series are brought when they are computed. "
    "Of the recipe its parameters, smoothing and speed at its end are used, and "
    "its\n"
    "start in patient mm where a case has none of its own. What is wrong is said for all rows at once, and "
    "then\n"
    "nothing is written.\n"
    "Columns of a list: id, input, server, study, series, recipe, mask, within_mm, seed (i,j,k,r; several "
    "with blanks "
    "between),\n"
    "seed_mm (x,y,z,r), threshold (lo,hi), auto_start (yes or no), speed_map, target, range, alpha, "
    "smooth_mm,\n"
    "steps, max_steps, levels, truth, truth_label.",
    "  tidemark-cli cohort plan archive/ --recipe liver.json --auto-start --out livers\n"
    "  tidemark-cli cohort plan bids/ --match '*_T1w.nii.gz' --recipe brain.json --out brains\n"
    "  tidemark-cli cohort plan cases.csv --recipe liver.json --output seg --out livers\n"
    "  tidemark-cli cohort plan pacs:main --modality CT --from 2026-01-01 --recipe liver.json --out livers\n"
    "  tidemark-cli cohort plan livers --rejected decisions.csv --recipe wider.json --out livers-2\n"};

constexpr std::size_t kMostSaid = 100;  // problems in words; all are counted

struct PlanArguments {
  std::string source, out, recipe, rejected, servers;
  cohort::FindOptions find;
  bool without_edits = false, auto_start = false, no_pictures = false, skip_problems = false;
  std::vector<std::string> outputs;
  std::optional<double> target, range, alpha, smooth_mm, within_mm;
  std::optional<std::int64_t> steps, max_steps, levels;
  std::vector<SphereArgument> seeds;
  std::optional<std::vector<double>> threshold;

  [[nodiscard]] cohort::WorkRow given() const;
};

// What options say of every case.
cohort::WorkRow PlanArguments::given() const {
  cohort::WorkRow row;
  row.target = target;
  row.range = range;
  row.alpha = alpha;
  row.smooth_mm = smooth_mm;
  row.within_mm = within_mm;
  row.steps = steps;
  row.max_steps = max_steps;
  row.levels = levels;
  row.auto_start = auto_start;
  for (const SphereArgument& seed : seeds) row.seeds_mm.push_back({seed.centre, seed.radius_mm});
  if (threshold) row.threshold = {(*threshold)[0], (*threshold)[1]};
  return row;
}

// The options for columns of a list, for messages.
constexpr std::pair<std::string_view, std::string_view> kOptionsOfColumns[] = {
    {"threshold", "--init-threshold"},
    {"within_mm", "--within"},
    {"range", "--range"},
    {"alpha", "--alpha"},
    {"smooth_mm", "--smooth"},
    {"steps, max_steps", "--steps, --max-steps"},
    {"steps", "--steps"},
    {"max_steps", "--max-steps"},
    {"levels", "--levels"}};

class PlanCommand {
 public:
  PlanCommand(Program& program, const PlanArguments& arguments)
      : console_(program.console), arguments_(arguments), folder_(arguments.out) {}

  Status run();

 private:
  Status take_outputs();
  Status take_recipe();
  Status check_source() const;
  Status check_values() const;
  Status take_servers(Result<imaging::PacsConfiguration> servers);
  Status find();
  Status keep_rejected();
  Status check();
  void take_values();
  void warn_of_own_values(const cohort::WorkRow& given) const;
  void warn_of(const std::vector<std::string>& texts) const;
  void say();

  Console& console_;
  const PlanArguments& arguments_;
  cohort::CohortFolder folder_;
  cohort::CohortPlan plan_;
  std::string recipe_text_;
  cohort::FindOptions options_;
  cohort::FoundCases found_;
  std::size_t skipped_ = 0;
};

Status PlanCommand::run() {
  if (const Status free = folder_.check_free(); !free) {
    return fail(free.error().kind, "--out {}", free.error().message);
  }
  TIDEMARK_TRY(check_source());
  TIDEMARK_TRY(check_values());
  for (const auto step : {&PlanCommand::take_outputs, &PlanCommand::take_recipe, &PlanCommand::find,
                          &PlanCommand::keep_rejected, &PlanCommand::check}) {
    TIDEMARK_TRY((this->*step)());
    if (console_.interrupted()) return cancelled_error();
  }
  plan_.pictures = !arguments_.no_pictures;
  plan_.source = found_.place;
  plan_.program = TIDEMARK_VERSION;
  plan_.planned = cohort::utc_now();
  TIDEMARK_TRY(folder_.write_plan(plan_, found_.list, recipe_text_));
  say();
  return {};
}

Status PlanCommand::take_outputs() {
  const auto& names = cohort::output_names();
  for (const std::string& word : arguments_.outputs) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) {
      return fail(ErrorKind::usage, "--output {}: must be one of {}", word, fmt::join(names, ", "));
    }
    const auto output = static_cast<cohort::CaseOutput>(found - names.begin());
    if (std::find(plan_.outputs.begin(), plan_.outputs.end(), output) == plan_.outputs.end()) {
      plan_.outputs.push_back(output);
    }
  }
  return {};
}

Status PlanCommand::take_recipe() {
  if (arguments_.recipe.empty()) return {};
  auto text = read_text_file(arguments_.recipe, document::Recipe::kLargestFile);
  if (!text) return pass_on(text);
  auto shared = cohort::SharedRecipe::parse(*text, arguments_.recipe, arguments_.without_edits);
  if (!shared) return pass_on(shared);
  for (const std::string& remark : shared->remarks()) console_.warn(remark);
  recipe_text_ = std::move(*text);
  plan_.recipe_checksum = document::sha256(std::as_bytes(std::span(recipe_text_)));
  plan_.recipe = std::move(*shared);
  return {};
}

// Options that the source has no use for are a mistake.
Status PlanCommand::check_source() const {
  const bool is_server = arguments_.source.starts_with(cohort::kPacsSource);
  const cohort::FindOptions& find = arguments_.find;
  if (is_server && find.query.studies.modality.empty()) {
    return fail(ErrorKind::usage, "{}: needs --modality: reports and segmentations are no cases",
                arguments_.source);
  }
  if (is_server && !(find.match.empty() && find.mask.empty() && find.truth.empty())) {
    return fail(ErrorKind::usage, "--match, --mask, --truth: are for folders, not for {}", arguments_.source);
  }
  if (!is_server && find.query != cohort::PacsQuery()) {
    return fail(ErrorKind::usage, "{}: a query is for a SOURCE like {}main", arguments_.source,
                cohort::kPacsSource);
  }
  return {};
}

// A cohort with values that no case may have could never be run.
Status PlanCommand::check_values() const {
  const auto problems = cohort::problems_of_values(arguments_.given());
  if (problems.empty()) return {};
  const std::string_view problem = problems.front();
  const std::size_t colon = problem.find(':');
  const auto is_named = [&](const auto& one) { return one.first == problem.substr(0, colon); };
  const auto* const option =
      std::find_if(std::begin(kOptionsOfColumns), std::end(kOptionsOfColumns), is_named);
  if (option == std::end(kOptionsOfColumns)) return fail(ErrorKind::usage, "{}", problem);
  return fail(ErrorKind::usage, "{}{}", option->second, problem.substr(colon));
}

Status PlanCommand::find() {
  options_ = arguments_.find;
  if (!arguments_.servers.empty())
    plan_.servers_file = std::filesystem::absolute(arguments_.servers).lexically_normal();
  if (arguments_.source.starts_with(cohort::kPacsSource)) {
    TIDEMARK_TRY(take_servers(imaging::read_chosen_pacs_configuration(plan_.servers_file)));
  }
  auto found = cohort::find_cases(arguments_.source, options_, console_.progress());
  if (!found) return pass_on(found);
  if (found->source == "cohort" && arguments_.rejected.empty()) {
    return fail(ErrorKind::usage, "{}: is a cohort: --rejected says which of its cases to plan again",
                arguments_.source);
  }
  for (const std::string& text : found->left_out) console_.log("left out: {}", text);
  if (!found->left_out.empty()) {
    console_.say("Left out   {} series, files and folders that cannot be loaded (--verbose names them)",
                 found->left_out.size());
  }
  found_ = std::move(*found);
  if (found_.source != "cohort" || !plan_.servers_file.empty()) return {};
  const auto earlier = cohort::CohortFolder(arguments_.source).load_plan();
  if (!earlier) return pass_on(earlier);
  plan_.servers_file = earlier->servers_file;
  return {};
}

Status PlanCommand::take_servers(Result<imaging::PacsConfiguration> servers) {
  if (!servers) return pass_on(servers);
  options_.servers = std::move(*servers);
  return {};
}

// Of an earlier cohort's rows those that a person has rejected.
Status PlanCommand::keep_rejected() {
  if (arguments_.rejected.empty()) return {};
  const auto decisions = cohort::load_decisions(arguments_.rejected);
  if (!decisions) return pass_on(decisions);
  std::set<std::string> rejected;
  for (const cohort::Decision& decision : *decisions) {
    if (decision.verdict == cohort::Decision::Verdict::rejected) rejected.insert(decision.id);
  }
  std::erase_if(found_.list.rows, [&](const cohort::WorkRow& row) { return !rejected.contains(row.id); });
  for (const cohort::WorkRow& row : found_.list.rows) rejected.erase(row.id);
  if (!rejected.empty()) {
    return fail(ErrorKind::input, "{}: id '{}': no such case in {}", arguments_.rejected, *rejected.begin(),
                arguments_.source);
  }
  if (found_.list.rows.empty()) return fail(ErrorKind::input, "{}: rejects no case", arguments_.rejected);
  return {};
}

Status PlanCommand::check() {
  // Of a query they are known.
  if (options_.servers.servers.empty()) {
    TIDEMARK_TRY(take_servers(cohort::servers_of(plan_.servers_file, found_.list.rows)));
  }
  if (options_.servers.servers.empty() && !arguments_.servers.empty()) {
    return fail(ErrorKind::usage, "--servers: no case of {} is on a server", arguments_.source);
  }
  take_values();
  const cohort::SharedRecipe* recipe = plan_.recipe ? &*plan_.recipe : nullptr;
  const std::vector<bool> good = cohort::check_cases(
      found_, arguments_.source, recipe, arguments_.without_edits, options_.servers, console_.progress());
  warn_of(found_.remarks);
  const std::vector<std::string>& problems = found_.list.problems;
  if (problems.empty()) return {};
  warn_of(problems);
  if (!arguments_.skip_problems) {
    return fail(ErrorKind::input,
                "{} problems in {} rows; nothing was written (--skip-problems leaves such rows out)",
                problems.size(), found_.list.rows.size());
  }
  std::vector<cohort::WorkRow> kept;
  for (std::size_t i = 0; i < good.size(); ++i) {
    if (good[i]) kept.push_back(std::move(found_.list.rows[i]));
  }
  skipped_ = found_.list.rows.size() - kept.size();
  found_.list = {std::move(kept), {}};
  if (found_.list.rows.empty())
    return fail(ErrorKind::input, "{}: no row is without a problem", arguments_.source);
  return {};
}

// The rows of an earlier cohort have the values that it was planned with: what is given now replaces them.
void PlanCommand::take_values() {
  const bool is_again = found_.source == "cohort";
  const cohort::WorkRow given = arguments_.given();
  const auto take = is_again ? &cohort::WorkRow::replace : &cohort::WorkRow::complete;
  for (cohort::WorkRow& row : found_.list.rows) (row.*take)(given);
  if (is_again && plan_.recipe) warn_of_own_values(given);
}

// Whoever plans again with another recipe may take it for the one that counts.
void PlanCommand::warn_of_own_values(const cohort::WorkRow& given) const {
  std::map<std::string_view, std::size_t> rows;
  for (const cohort::WorkRow& row : found_.list.rows) {
    for (const std::string_view column : cohort::own_values(row, *plan_.recipe)) ++rows[column];
  }
  for (const std::string_view column : cohort::own_values(given, *plan_.recipe)) rows.erase(column);
  for (const auto& [column, count] : rows) {
    console_.warn(fmt::format("--recipe {}: {}: {} cases have their own, which counts", arguments_.recipe,
                              column, count));
  }
}

// Of very many the first ones.
void PlanCommand::warn_of(const std::vector<std::string>& texts) const {
  for (std::size_t i = 0; i < std::min(texts.size(), kMostSaid); ++i) console_.warn(texts[i]);
  if (texts.size() > kMostSaid) console_.warn(fmt::format("and {} more", texts.size() - kMostSaid));
}

void PlanCommand::say() {
  console_.say("Planned    {} cases{}", found_.list.rows.size(),
               skipped_ > 0 ? fmt::format(", {} left out", skipped_) : "");
  console_.say("Wrote      {}", folder_.work_list().string());
  console_.say("Next       tidemark-cli cohort run {}", shell_word(arguments_.out));
  Json object;
  object["cases"] = found_.list.rows.size();
  object["skipped"] = skipped_;
  object["left_out"] = found_.left_out.size();
  object["work_list"] = folder_.work_list().string();
  object["recipe_checksum"] = plan_.recipe_checksum.empty() ? Json() : Json(plan_.recipe_checksum);
  console_.result(object);
}

void add_row_options(CLI::App& command, PlanArguments& arguments) {
  const char* const kGroup = "Cases (what a row of a list has of its own counts)";
  command
      .add_flag(
          "--auto-start", arguments.auto_start,
          "Where a case has no start: an even, bright region near the middle, by the recipe's target and "
          "range")
      ->group(kGroup);
  add_spheres(command, "--seed-mm", SphereUnits::millimetres, arguments.seeds,
              "A ball around a point in patient coordinates (LPS), all in mm; may be repeated")
      ->group(kGroup);
  add_numbers(command, "--init-threshold", "LO,HI", arguments.threshold,
              "All voxels with values from LO to HI, in the volume's units")
      ->group(kGroup);
  const auto number = [&](const char* name, std::optional<double>& value, const char* description) {
    add_number(command, name, value, description)->group(kGroup);
  };
  number("--within", arguments.within_mm, "Of cases with a mask: the surface stays within so many mm of it");
  number("--target", arguments.target, "T, instead of the recipe's");
  number("--range", arguments.range, "epsilon, instead of the recipe's");
  number("--alpha", arguments.alpha, "alpha, instead of the recipe's");
  number("--smooth", arguments.smooth_mm, "Smooth volumes first by so many mm, instead of the recipe's");
  add_count(command, "--steps", arguments.steps, "Compute exactly N steps (default: until it rests)")
      ->group(kGroup);
  add_count(command, "--max-steps", arguments.max_steps, "Stop after N steps at the latest")->group(kGroup);
  add_count(command, "--levels", arguments.levels, "Coarse to fine on so many levels, 1 to 3")->group(kGroup);
}

void add_find_options(CLI::App& command, PlanArguments& arguments) {
  const char* const kGroup = "Folders";
  command
      .add_option("--match", arguments.find.match,
                  "Take the inputs whose name, or path below SOURCE, is like this (as *.nii.gz)")
      ->type_name("PATTERN")
      ->group(kGroup);
  command
      .add_option("--mask", arguments.find.mask,
                  "A mask beside each input to start from, from its folder on; {name} is the input's name")
      ->type_name("PATTERN")
      ->group(kGroup);
  command.add_option("--truth", arguments.find.truth, "A mask beside each input to compare with, likewise")
      ->type_name("PATTERN")
      ->group(kGroup);
}

void add_server_options(CLI::App& command, PlanArguments& arguments) {
  const char* const kGroup = "Servers";
  for (CLI::Option* key : add_study_keys(command, arguments.find.query.studies, "Of the study").all)
    key->group(kGroup);
  command
      .add_option("--series-description", arguments.find.query.series_description,
                  "Of the series; may hold the wildcards * and ?")
      ->type_name("TEXT")
      ->group(kGroup);
  command
      .add_option("--servers", arguments.servers,
                  "The file of servers, instead of the usual one; runs read it, too")
      ->type_name("FILE.json")
      ->group(kGroup);
}

}  // namespace

void add_cohort_plan(CLI::App& cohort, Program& program) {
  auto arguments = std::make_shared<PlanArguments>();
  CLI::App& command = add_command(cohort, program, kCohortPlan,
                                  [&program, arguments] { return PlanCommand(program, *arguments).run(); });
  command
      .add_option("SOURCE", arguments->source,
                  "A folder, a BIDS dataset, a list (.csv), a cohort or pacs:SERVER")
      ->required()
      ->type_name("");
  command.add_option("--out", arguments->out, "The folder to make the cohort in")
      ->required()
      ->type_name("DIR");
  command
      .add_option("--recipe", arguments->recipe,
                  "What to do with each case, as segment and the desktop write it")
      ->type_name("FILE.json");
  command.add_flag("--without-edits", arguments->without_edits,
                   "Leave out what recipes paint at places of their own studies");
  command
      .add_option(
          "--output", arguments->outputs,
          "Written of each case beside mask.nii.gz; may be repeated: seg (DICOM segmentation), rtstruct,\n"
          "surface (.stl), phi (the level set)")
      ->allow_extra_args(false)
      ->type_name("seg|rtstruct|surface|phi");
  command.add_flag("--no-pictures", arguments->no_pictures, "Without slices for the report");
  command
      .add_option("--rejected", arguments->rejected,
                  "Of an earlier cohort the cases that the decisions of its report reject")
      ->type_name("FILE.csv");
  command.add_flag("--skip-problems", arguments->skip_problems, "Leave out the rows that have problems");
  add_row_options(command, *arguments);
  add_find_options(command, *arguments);
  add_server_options(command, *arguments);
}

}  // namespace tidemark::cli
