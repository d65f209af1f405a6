// Measures the host executor beside its peers on the same phantoms in one run. See docs/performance.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <filesystem>
#include <iostream>

#include "bench/peers/measurements.h"

namespace tidemark::bench {

std::vector<ContestantKind> all_contestants() {
  return {itk_threshold(), itk_parallel_sparse(), openvdb_tracker(),
          dense_stencil(), tidemark_host(true),   tidemark_host(false)};
}

bool wanted(const Settings& settings, const std::string& name) {
  return settings.only.empty() ||
         std::find(settings.only.begin(), settings.only.end(), name) != settings.only.end();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

namespace {

struct Arguments {
  Settings settings;
  std::string which;  // empty: all
  std::string memory_of;
  bool json = false;
  bool markdown = false;
  bool simd = false;
};

Status measure(const Arguments& arguments, Report& report) {
  const Settings& settings = arguments.settings;
  for (const char* name : {"tumour", "cortex"}) {
    if (!arguments.which.empty() && arguments.which != name) continue;
    const auto problem = make_problem(name);
    if (!problem) return pass_on(problem);
    if (!arguments.memory_of.empty()) return print_memory_of(*problem, arguments.memory_of);
    if (arguments.simd) {
      TIDEMARK_TRY(measure_instruction_sets(*problem, report));
      continue;
    }
    TIDEMARK_TRY(measure_stages(*problem, settings, report));
    if (problem->seed) {
      TIDEMARK_TRY(measure_convergence(*problem, settings, report));
    }
    TIDEMARK_TRY(measure_memory(*problem, settings, report));
  }
  if (arguments.simd || !(arguments.which.empty() || arguments.which == "scaling")) return {};
  return measure_scaling(settings, report);
}

int run(int argc, char** argv) {
  CLI::App app("Measures Tidemark's host executor beside its peers, all in one run.", "peers");
  Arguments arguments;
  Settings& settings = arguments.settings;
  settings.program = std::filesystem::read_symlink("/proc/self/exe").string();
  std::vector<std::string> names;
  for (const ContestantKind& kind : all_contestants()) names.push_back(kind.name);
  app.add_option("--case", arguments.which, "only this case (all when left out)")
      ->check(CLI::IsMember({"tumour", "cortex", "scaling"}));
  app.add_option("--only", settings.only, "only these contestants")->check(CLI::IsMember(names));
  app.add_option("--rounds", settings.rounds, "turns of each contestant; medians are reported")
      ->check(CLI::Range(1, 100))
      ->capture_default_str();
  app.add_flag("--quick", settings.quick, "one short round, to see that everything works");
  app.add_flag("--simd", arguments.simd, "compare the results of the instruction sets instead");
  CLI::Option* json = app.add_flag("--json", arguments.json, "print JSON instead of tables");
  app.add_flag("--markdown", arguments.markdown, "print the tables as docs/performance.md has them")
      ->excludes(json);
  app.add_option("--memory-of", arguments.memory_of)->group("");
  CLI11_PARSE(app, argc, argv);
  if (settings.quick) settings.rounds = 1;
  if (!arguments.memory_of.empty() && arguments.which.empty()) arguments.which = "tumour";

  ReportStyle style = arguments.markdown ? ReportStyle::markdown : ReportStyle::text;
  if (arguments.json || !arguments.memory_of.empty()) style = ReportStyle::none;
  Report report(style);
  describe_machine(report);
  if (auto status = measure(arguments, report); !status) {
    fmt::print(stderr, "peers: {}\n", status.error().message);
    return exit_code(status.error().kind);
  }
  if (!arguments.memory_of.empty()) return 0;
  report.goals();
  if (arguments.json) std::cout << report.json().dump(2) << '\n';
  return 0;
}

}  // namespace
}  // namespace tidemark::bench

int main(int argc, char** argv) {
  try {
    return tidemark::bench::run(argc, argv);
  } catch (const std::exception& exception) {
    fmt::print(stderr, "peers: {}\n", exception.what());
    return 1;
  }
}
