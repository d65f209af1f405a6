// The headless program: its commands, and main() with the exit codes of the contract.
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>

#include "app/cli/console.h"
#include "core/result.h"

namespace tidemark::cli {

// Exit codes: 0, 1 internal error, 2 wrong usage, 3 unreadable input, 4 missing capability or memory budget,
// 5 a write failed, 130 interrupted. A failure is one line on standard error. Nothing is thrown.
int run_program(int argc, char** argv);

// The state that the commands share while the program runs.
struct Program {
  Console console;
  std::function<Status()> chosen;  // the command that was asked for, ready to run
};

// The help of a command.
struct CommandHelp {
  const char* name;
  const char* summary;      // one line for the list of commands
  const char* description;  // meaning and units, below the summary
  const char* examples;     // whole command lines, one a line
};

// A command before its options are added. --json and --verbose are added here; `run` is called once all
// options are parsed.
CLI::App& add_command(CLI::App& app, Program& program, const CommandHelp& help, std::function<Status()> run);

void add_info(CLI::App& app, Program& program);
void add_segment(CLI::App& app, Program& program);
void add_sweep(CLI::App& app, Program& program);
void add_replay(CLI::App& app, Program& program);
void add_distance(CLI::App& app, Program& program);
void add_convert(CLI::App& app, Program& program);
void add_deidentify(CLI::App& app, Program& program);
void add_compare(CLI::App& app, Program& program);
void add_measure(CLI::App& app, Program& program);
void add_render(CLI::App& app, Program& program);
void add_film(CLI::App& app, Program& program);
void add_phantom(CLI::App& app, Program& program);
void add_lesson(CLI::App& app, Program& program);
void add_cohort(CLI::App& app, Program& program);
void add_bench(CLI::App& app, Program& program);
void add_pacs(CLI::App& app, Program& program);
void add_ai(CLI::App& app, Program& program);

}  // namespace tidemark::cli
