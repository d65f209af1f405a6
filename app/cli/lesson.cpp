// tidemark-cli lesson: the lessons of the program, and lessons carried out as their authors expect them.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "app/cli/program.h"
#include "app/cli/solver_options.h"
#include "core/stopwatch.h"
#include "document/lesson_figure.h"
#include "document/lesson_run.h"

namespace tidemark::cli {
namespace {

constexpr const char* kLessonSummary = "Lists, shows and checks lessons";
constexpr const char* kLessonFooter =
    "\nExamples:\n"
    "  tidemark-cli lesson list\n"
    "  tidemark-cli lesson COMMAND --help\n";

constexpr CommandHelp kLessonList{
    "list", "Lists the program's own lessons",
    "One line a lesson: its name, the minutes that a student needs, and its title.",
    "  tidemark-cli lesson list\n"
    "  tidemark-cli lesson list --json\n"};

constexpr CommandHelp kLessonShow{
    "show", "Writes one of the program's own lessons, to begin another with",
    "Writes the lesson's file (JSON; lengths in mm) to standard output, with --json as without.",
    "  tidemark-cli lesson show 4-leaks >mine.json\n"};

constexpr CommandHelp kLessonCheck{
    "check", "Carries out every try of lessons and measures its figures",
    "Carries out every try of each LESSON, from its start (radii in mm), and holds each figure against its\n"
    "expected range. A LESSON is a file, or the name of one of the program's own; without any it is all of\n"
    "these. Ends with code 3 where a file is refused or a figure is out of its range.",
    "  tidemark-cli lesson check\n"
    "  tidemark-cli lesson check 2-curvature-flow --executor stream\n"
    "  tidemark-cli lesson check mine.json --json\n"};

struct CheckArguments {
  std::vector<std::string> lessons;
  SolverOptions solver;
};

// A lesson with where it is from.
struct NamedLesson {
  std::string name;  // as on the command line
  std::filesystem::path folder;
  document::Lesson lesson;
};

// Null: there is none of that name.
const document::OwnLesson* find_own(std::string_view name) {
  const auto lessons = document::own_lessons();
  const auto found = std::find_if(lessons.begin(), lessons.end(),
                                  [&](const document::OwnLesson& own) { return own.name == name; });
  return found == lessons.end() ? nullptr : &*found;
}

std::string own_names() {
  std::string names;
  for (const document::OwnLesson& own : document::own_lessons()) {
    names += fmt::format("{}{}", names.empty() ? "" : ", ", own.name);
  }
  return names;
}

Result<NamedLesson> own_lesson(const document::OwnLesson& own) {
  auto lesson = document::Lesson::parse(own.text, std::string(own.name));
  if (!lesson) return fail(ErrorKind::internal, "{}", lesson.error().message);
  return NamedLesson{std::string(own.name), {}, std::move(*lesson)};
}

Result<NamedLesson> find_lesson(const std::string& name) {
  if (const document::OwnLesson* own = find_own(name)) return own_lesson(*own);
  std::error_code ignored;
  if (!std::filesystem::exists(name, ignored)) {
    return fail(ErrorKind::input, "{}: there is no such file, and no lesson of that name; there are {}", name,
                own_names());
  }
  auto lesson = document::Lesson::load(name);
  if (!lesson) return pass_on(lesson);
  return NamedLesson{name, std::filesystem::path(name).parent_path(), std::move(*lesson)};
}

Result<std::vector<NamedLesson>> find_lessons(const std::vector<std::string>& names) {
  std::vector<NamedLesson> lessons;
  const auto add = [&](Result<NamedLesson> lesson) -> Status {
    if (!lesson) return pass_on(lesson);
    lessons.push_back(std::move(*lesson));
    return {};
  };
  for (const std::string& name : names) {
    TIDEMARK_TRY(add(find_lesson(name)));
  }
  if (!names.empty()) return lessons;
  for (const document::OwnLesson& own : document::own_lessons()) {
    TIDEMARK_TRY(add(own_lesson(own)));
  }
  return lessons;
}

Status run_list(Program& program) {
  auto lessons = find_lessons({});
  if (!lessons) return pass_on(lessons);
  Json list = Json::array();
  for (const auto& [name, folder, lesson] : *lessons) {
    program.console.say("{:<22} {:>3} min  {}", name, lesson.minutes, lesson.title);
    list.push_back({{"name", name},
                    {"title", lesson.title},
                    {"about", lesson.about},
                    {"minutes", lesson.minutes},
                    {"parts", lesson.parts.size()}});
  }
  Json object;
  object["lessons"] = std::move(list);
  program.console.result(object);
  return {};
}

Status run_show(Program& program, const std::string& name) {
  const document::OwnLesson* own = find_own(name);
  if (own == nullptr) return fail(ErrorKind::usage, "unknown lesson '{}'; there are {}", name, own_names());
  program.console.print(std::string(own->text));
  return {};
}

// One run of the command.
class CheckCommand {
 public:
  CheckCommand(Program& program, const CheckArguments& arguments)
      : console_(program.console), arguments_(arguments) {}

  Status run();

 private:
  Result<Json> check_lesson(const NamedLesson& named);
  Json check_part(const NamedLesson& named, const document::LessonPart& part,
                  const document::LessonOutcome& outcome);
  Json check_figure(const NamedLesson& named, const document::LessonPart& part,
                    const document::LessonMeasure& measure, const std::optional<double>& value);

  Console& console_;
  const CheckArguments& arguments_;
  int figures_ = 0;
  int out_of_range_ = 0;
  std::string first_problem_;
};

Status CheckCommand::run() {
  TIDEMARK_TRY(check(arguments_.solver));
  auto lessons = find_lessons(arguments_.lessons);
  if (!lessons) return pass_on(lessons);
  Json list = Json::array();
  for (const NamedLesson& named : *lessons) {
    auto checked = check_lesson(named);
    if (!checked) return pass_on(checked);
    list.push_back(std::move(*checked));
  }
  Json object;
  object["figures"] = figures_;
  object["out_of_range"] = out_of_range_;
  object["lessons"] = std::move(list);
  console_.result(object);
  if (out_of_range_ == 0) return {};
  return fail(ErrorKind::input, "{} of {} figures are out of their ranges, first {}", out_of_range_, figures_,
              first_problem_);
}

Result<Json> CheckCommand::check_lesson(const NamedLesson& named) {
  console_.say("Lesson     {}: {}", named.name, named.lesson.title);
  Json parts = Json::array();
  Stopwatch watch;
  const auto done = [&](const document::LessonPart& part, const document::LessonOutcome& outcome) {
    const double seconds = watch.seconds();
    console_.say("Part {:<5} {} ({:.1f} s)", parts.size() + 1, part.title, seconds);
    parts.push_back(check_part(named, part, outcome));
    parts.back()["seconds"] = seconds;
    watch.restart();
  };
  const auto outcomes = document::carry_out(named.lesson, named.folder,
                                            arguments_.solver.kind.value_or(solver::ExecutorKind::automatic),
                                            arguments_.solver.executor_options(), console_.progress(), done);
  if (!outcomes) return fail(outcomes.error().kind, "{}: {}", named.name, outcomes.error().message);
  Json object;
  object["lesson"] = named.name;
  object["title"] = named.lesson.title;
  object["parts"] = std::move(parts);
  return object;
}

Json CheckCommand::check_part(const NamedLesson& named, const document::LessonPart& part,
                              const document::LessonOutcome& outcome) {
  Json object;
  object["title"] = part.title;
  object["holds"] = outcome.holds(part);
  object["figures"] = Json::array();
  for (std::size_t i = 0; i < outcome.figures.size(); ++i) {
    object["figures"].push_back(check_figure(named, part, part.measures[i], outcome.figures[i]));
  }
  return object;
}

Json CheckCommand::check_figure(const NamedLesson& named, const document::LessonPart& part,
                                const document::LessonMeasure& measure, const std::optional<double>& value) {
  const document::LessonFigure& figure = *document::lesson_figure(measure.figure);
  const bool holds = value && measure.holds(*value);
  const std::string measured = value ? fmt::format("{:.{}f}", *value, figure.digits + 1) : "none";
  console_.say("  {:<20} {:>12} {:<4} expected {} to {}: {}", figure.name, measured, figure.unit, measure.low,
               measure.high, holds ? "ok" : "NOT OK");
  ++figures_;
  if (!holds && ++out_of_range_ == 1) {
    first_problem_ = fmt::format("{}, part '{}': {} is {}, expected {} to {}", named.name, part.title,
                                 figure.name, measured, measure.low, measure.high);
  }
  Json object;
  object["figure"] = figure.name;
  object["unit"] = figure.unit;
  object["value"] = value ? Json(*value) : Json();
  object["low"] = measure.low;
  object["high"] = measure.high;
  object["holds"] = holds;
  return object;
}

}  // namespace

void add_lesson(CLI::App& app, Program& program) {
  CLI::App& lesson = *app.add_subcommand("lesson", kLessonSummary);
  lesson.footer(kLessonFooter);
  lesson.require_subcommand(1);
  add_command(lesson, program, kLessonList, [&program] { return run_list(program); });
  auto name = std::make_shared<std::string>();
  CLI::App& show =
      add_command(lesson, program, kLessonShow, [&program, name] { return run_show(program, *name); });
  show.add_option("NAME", *name, "A name that lesson list shows")->required()->type_name("");
  auto arguments = std::make_shared<CheckArguments>();
  CLI::App& check = add_command(lesson, program, kLessonCheck,
                                [&program, arguments] { return CheckCommand(program, *arguments).run(); });
  check.add_option("LESSON", arguments->lessons, "Files, or names that lesson list shows")->type_name("");
  add_solver_options(check, arguments->solver);
}

}  // namespace tidemark::cli
