// tidemark-cli cohort report: the outcome of a cohort as tables and as one page.
#include <memory>

#include "app/cli/arguments.h"
#include "app/cli/cohort_commands.h"
#include "core/atomic_file.h"
#include "document/cohort/bids.h"
#include "document/cohort/report_page.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kCohortReport{
    "report", "Writes the outcome of a cohort as tables and as one page to review",
    "Writes DIR/report.csv, DIR/report.json and DIR/report.html, which needs nothing but a browser: a card a "
    "case\n"
    "with slices, figures and warnings, the most unusual first (robust z of volume, area, mean inside and "
    "Dice).\n"
    "Keys accept, reject and comment; the decisions are saved as CSV, which cohort plan --rejected reads. "
    "Small\n"
    "cohorts have their pictures in the page, large ones beside it.",
    "  tidemark-cli cohort report livers\n"
    "  tidemark-cli cohort report brains --bids brains-derivatives\n"};

struct ReportArguments {
  std::string folder, bids;
  std::optional<cohort::PagePictures> pictures;
};

// The page looks for pictures beside it: it lies in the cohort's folder.
Status write_reports(const cohort::CohortFolder& folder, const cohort::CohortPlan& plan,
                     const cohort::Review& review, const ReportArguments& arguments, Console& console) {
  const auto pictures = arguments.pictures.value_or(cohort::suitable_pictures(folder, review));
  const auto page = cohort::report_page(folder, plan, review, pictures, console.progress());
  if (!page) return pass_on(page);
  TIDEMARK_TRY(write_file(folder.path() / "report.csv", cohort::review_csv(review)));
  TIDEMARK_TRY(write_file(folder.path() / "report.json", cohort::review_json(review)));
  return write_file(folder.path() / "report.html", *page);
}

// Before anything is written.
Status check_bids(const cohort::CohortFolder& folder, const std::string& source, const std::string& to) {
  if (to.empty()) return {};
  const Status good = cohort::check_bids_folder(folder, source, to);
  if (!good) return fail(good.error().kind, "--bids {}", good.error().message);
  return {};
}

Status run(Program& program, const ReportArguments& arguments) {
  Console& console = program.console;
  const cohort::CohortFolder folder(std::filesystem::absolute(arguments.folder).lexically_normal());
  const auto plan = folder.load_plan();
  if (!plan) return pass_on(plan);
  TIDEMARK_TRY(check_bids(folder, plan->source, arguments.bids));
  const auto list = folder.load_work_list();
  if (!list) return pass_on(list);
  const auto review = cohort::review(folder, *list, console.progress());
  if (!review) return pass_on(review);
  TIDEMARK_TRY(write_reports(folder, *plan, *review, arguments, console));
  Json object;
  const std::int64_t done = review->count(cohort::CaseOutcome::done);
  object["cases"] = list->rows.size();
  object["done"] = done;
  object["without_result"] = review->cases.size() - static_cast<std::size_t>(done);
  object["not_done"] = review->not_done.size();
  object["unreadable"] = review->unreadable.size();
  object["page"] = (folder.path() / "report.html").string();
  console.say("Cases      {}: {} with a result, {} without, {} not computed yet", list->rows.size(), done,
              review->cases.size() - static_cast<std::size_t>(done), review->not_done.size());
  for (const std::string& problem : review->unreadable) console.warn(problem);
  console.say("Wrote      {}", (folder.path() / "report.html").string());
  if (!arguments.bids.empty()) {
    const auto masks = cohort::write_bids(folder, *review, {plan->source, TIDEMARK_VERSION}, arguments.bids,
                                          console.progress());
    if (!masks) return pass_on(masks);
    console.say("Wrote      {}: {} masks", arguments.bids, *masks);
    object["bids_masks"] = *masks;
  }
  console.result(object);
  return {};
}

}  // namespace

void add_cohort_report(CLI::App& cohort, Program& program) {
  auto arguments = std::make_shared<ReportArguments>();
  CLI::App& command =
      add_command(cohort, program, kCohortReport, [&program, arguments] { return run(program, *arguments); });
  add_cohort_folder(command, arguments->folder);
  add_choice<std::optional<cohort::PagePictures>>(
      command, "--pictures", arguments->pictures,
      {{"embed", cohort::PagePictures::embed}, {"link", cohort::PagePictures::link}},
      "In the page, or beside it (default: in the page up to 32 MB)");
  command
      .add_option("--bids", arguments->bids,
                  "Write the masks also as a dataset of BIDS derivatives, into this folder")
      ->type_name("DIR");
}

}  // namespace tidemark::cli
