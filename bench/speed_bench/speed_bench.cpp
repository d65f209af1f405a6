// How fast speed functions are evaluated, and how soon a stroke is answered. Pictures need a screen: without
// one, run it by xvfb-run -a. See docs/performance.md.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <QGuiApplication>

#include "engine/engine.h"
#include "rates.h"
#include "response.h"

using namespace tidemark;

namespace {

constexpr int kMoreImages = 2;  // as of a study with T1, T2 and FLAIR

Status measure(engine::Engine& engine, const Study& study) {
  TIDEMARK_TRY(measure_response(engine, study, 0));
  return measure_response(engine, study, kMoreImages);
}

Status run(const std::string& path, bool rates, bool response) {
  auto study = path.empty() ? phantom_study() : study_of(path);
  if (!study) return pass_on(study);
  if (rates) {
    TIDEMARK_TRY(measure_rates(**study));
  }
  if (!response) return {};
  engine::Engine engine;
  TIDEMARK_TRY(measure(engine, *study));
  if (!path.empty()) return {};
  study = large_phantom_study();
  if (!study) return pass_on(study);
  return measure(engine, *study);
}

}  // namespace

int main(int argc, char** argv) {
  const QGuiApplication application(argc, argv);
  CLI::App app("Times the evaluation of speed functions, and the answer to a stroke.");
  std::string study;
  bool rates = false;
  bool response = false;
  app.add_option("study", study, "A study to take instead of the phantoms");
  app.add_flag("--rates", rates, "Only voxels a second");
  app.add_flag("--response", response, "Only the answer to a stroke");
  CLI11_PARSE(app, argc, argv);
  if (const Status status = run(study, rates || !response, response || !rates); !status) {
    fmt::print(stderr, "speed_bench: {}\n", status.error().message);
    return exit_code(status.error().kind);
  }
}
