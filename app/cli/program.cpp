#include "app/cli/program.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "app/cli/audit.h"
#include "app/cli/interrupt.h"
#include "core/out_of_memory.h"
#include "core/without_exceptions.h"

namespace tidemark::cli {
namespace {

constexpr const char* kDescription =
    "tidemark-cli segments medical volumes with a level set: a surface that grows from a seed while the\n"
    "brightness around it attracts it and its own curvature smooths it.";

constexpr const char* kFooter = R"(
Units: I,J,K are voxel indices, 0-based, along columns, rows and slices; radii are in mm; X,Y,Z are patient
coordinates in mm (LPS: x to the patient's left, y to posterior, z to the head).
INPUT is a DICOM folder, file or DICOMDIR, a .nii .nii.gz .nrrd .nhdr .mha .mhd .gipl .gipl.gz file, a picture
(.png .jpg .jpeg .tif .tiff), or a zip archive of these.

Examples:
  tidemark-cli phantom head --out head
  tidemark-cli info head/series
  tidemark-cli segment head/series --target 800 --range 120 --alpha 0.6 --seed 90,110,80,5 --out mask.nii.gz
  tidemark-cli COMMAND --help

Exit codes: 0 done, 1 internal error, 2 wrong usage, 3 unreadable or inconsistent input, 4 missing capability
or memory budget, 5 a write failed, 130 interrupted.

Research use only. Not for diagnostic use.
)";

// The list of commands shows summaries alone; a command's own help adds its description.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_description(const CLI::App* app) const override {
    const auto found = descriptions_.find(app);
    return Formatter::make_description(app) +
           (found != descriptions_.end() ? found->second + std::string("\n\n") : "");
  }

  // Groups may have commands of one name.
  void add(const CLI::App& command, const char* description) { descriptions_[&command] = description; }

 private:
  std::map<const CLI::App*, const char*> descriptions_;
};

void add_all(CLI::App& app, Program& program) {
  add_info(app, program);
  add_segment(app, program);
  add_sweep(app, program);
  add_replay(app, program);
  add_distance(app, program);
  add_convert(app, program);
  add_deidentify(app, program);
  add_compare(app, program);
  add_measure(app, program);
  add_render(app, program);
  add_film(app, program);
  add_phantom(app, program);
  add_lesson(app, program);
  add_cohort(app, program);
  add_bench(app, program);
  add_pacs(app, program);
  add_ai(app, program);
}

// A first word that is no command gets a better answer than the parser's.
Status check_command_word(const CLI::App& app, int argc, char** argv) {
  std::string known;
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  for (const CLI::App* command : commands) known += (known.empty() ? "" : ", ") + command->get_name();
  if (argc < 2) return fail(ErrorKind::usage, "a command is needed: {} (see tidemark-cli --help)", known);
  const std::string_view word = argv[1];
  if (word.starts_with('-')) return {};
  const bool found = std::any_of(commands.begin(), commands.end(),
                                 [&](const CLI::App* command) { return command->get_name() == word; });
  if (!found) return fail(ErrorKind::usage, "unknown command '{}': the commands are {}", word, known);
  return {};
}

// The program, and the group and the command that its words have named so far.
std::vector<const CLI::App*> named_by_words(const CLI::App& app) {
  std::vector<const CLI::App*> named{&app};
  while (!named.back()->get_subcommands().empty()) named.push_back(named.back()->get_subcommands().front());
  return named;
}

// A script makes an empty word of a variable that is not set, and would not learn that the option counts for
// nothing. Only a text that has a default can be emptied.
void refuse_empty_values(const CLI::App& app) {
  for (const CLI::App* named : named_by_words(app)) {
    for (const CLI::Option* option : named->get_options()) {
      const std::vector<std::string>& values = option->results();
      const bool has_empty = std::find(values.begin(), values.end(), "") != values.end();
      if (has_empty && option->get_default_str().empty())
        throw CLI::ValidationError(option->get_name(), "the value is empty");
    }
  }
}

// One of the unparsed words says more than all of them.
std::string describe(const CLI::App& app, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) == nullptr) return error.what();
  const std::vector<std::string> extras = app.remaining(true);
  for (const std::string& word : extras) {
    if (word.starts_with("--")) return "unknown option " + word;
  }
  return extras.empty() ? error.what() : "unexpected argument '" + extras.back() + "'";
}

// Help and version end the program well, everything else the parser throws is wrong usage.
int answer_parser(const CLI::App& app, Program& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    program.console.print(error.get_name() == "CallForVersion" ? std::string(error.what()) + "\n"
                                                               : app.help());
    return program.console.finish({});
  }
  std::string message = describe(app, error);
  const std::vector<const CLI::App*> named = named_by_words(app);
  std::string words;
  for (const CLI::App* one : named) words += one->get_name() + " ";
  if (named.size() > 1) message += " (see " + words + "--help)";
  return program.console.finish(fail(ErrorKind::usage, "{}", message));
}

int run_unguarded(int argc, char** argv, Program& program) {
  CLI::App app(kDescription, "tidemark-cli");
  app.footer(kFooter);
  app.set_version_flag("--version", "tidemark-cli " TIDEMARK_VERSION);
  app.require_subcommand(1);
  auto formatter = std::make_shared<HelpFormatter>();
  formatter->column_width(32);
  app.formatter(formatter);
  add_all(app, program);
  if (const Status known = check_command_word(app, argc, argv); !known) return program.console.finish(known);
  try {
    app.parse(argc, argv);
    refuse_empty_values(app);
  } catch (const CLI::ParseError& error) {
    return answer_parser(app, program, error);
  }
  const auto audit = CommandAudit::begin(program.console);
  if (!audit) return program.console.finish(tl::unexpected<Error>(audit.error()));
  const Status done = without_exceptions(program.chosen);
  if (*audit) (*audit)->finish(program.console);
  return program.console.finish(done);
}

}  // namespace

CLI::App& add_command(CLI::App& app, Program& program, const CommandHelp& help, std::function<Status()> run) {
  CLI::App& command = *app.add_subcommand(help.name, help.summary);
  if (const auto formatter = std::dynamic_pointer_cast<HelpFormatter>(app.get_formatter()))
    formatter->add(command, help.description);
  command.footer(std::string("\nExamples:\n") + help.examples);
  command.add_flag_callback(
      "--json", [&program] { program.console.set_json(true); },
      "Machine-readable JSON on standard output; words for people come with --verbose, on standard error");
  command.add_flag_callback(
      "--verbose", [&program] { program.console.set_verbose(true); },
      "Say on standard error what is being done");
  command.callback([&program, run = std::move(run)] { program.chosen = run; });
  return command;
}

int run_program(int argc, char** argv) {
  Interrupt interrupt;  // before any thread: they inherit the signal mask
  try {
    Program program{Console(interrupt), {}};
    try {
      return run_unguarded(argc, argv, program);
    } catch (const std::bad_alloc& error) {
      return program.console.finish(out_of_memory(error));
    } catch (const std::exception& error) {
      return program.console.finish(fail(ErrorKind::internal, "{}", error.what()));
    }
  } catch (...) {
    return exit_code(ErrorKind::internal);
  }
}

}  // namespace tidemark::cli
