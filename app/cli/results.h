// The results of commands that run the level set: masks, segments, surfaces, phi, figures, pictures, recipes.
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>
#include <vector>

#include "app/cli/label_argument.h"
#include "app/cli/outputs.h"
#include "app/cli/renderer_option.h"
#include "app/cli/report.h"
#include "app/cli/study_input.h"
#include "document/evolution.h"
#include "imaging/results/results.h"
#include "imaging/series.h"
#include "renderer/picture.h"

namespace tidemark::cli {

struct ResultOptions {
  std::vector<std::string> out;
  std::string out_phi, out_speed, rtstruct, stats, picture, recipe;
  renderer::RendererKind renderer = renderer::RendererKind::automatic;  // of the picture
  LabelArgument label;                                                  // the segment in DICOM results
};
void add_result_options(CLI::App& app, ResultOptions& options);

// A finished run.
struct RunResults {
  std::shared_ptr<const Volume> source;            // as the solver saw it
  std::vector<std::filesystem::path> dicom_files;  // that it was read from, in slice order; empty: not DICOM
  std::shared_ptr<const imaging::StudyArchive> archive;  // in which they lie, if they do
  std::shared_ptr<const solver::SpeedFunction> speed;    // at the end; null: the tent
  solver::Field phi;
  RunFigures figures;
  document::Recipe recipe;

  // The end of the evolution by `recipe`: the results, their figures, and the recipe as it was carried out.
  void take(document::Evolution evolution);
};

class ResultWriter {
 public:
  ResultWriter(ResultOptions options, Console& console) : options_(std::move(options)), console_(console) {}

  // All checks that are possible before the long work: names, folders, whether pictures can be drawn.
  Status prepare();
  // Fails as spare_study() and spare_inputs() do.
  [[nodiscard]] Status spare(const StudyInput& study, const std::vector<std::string>& inputs,
                             const imaging::GridPolicy& otherwise = {}) const;
  [[nodiscard]] bool wants_recipe() const;

  // Writes all files, or none, and prints their names. The results' source is given up on the way: files of
  // masks and surfaces are then written in its memory.
  Status write(RunResults& results);

 private:
  Status stage(RunResults& results);
  Status stage_out(const RunResults& results);
  Status stage_dicom(const std::string& file, imaging::ResultForm form, const RunResults& results);
  Status stage_phi(const RunResults& results);
  Status stage_speed(const RunResults& results);
  Status stage_text(const std::string& file, const std::string& text);
  Result<renderer::Picture> draw(const RunResults& results);

  ResultOptions options_;
  Console& console_;
  Outputs outputs_;
  ChosenRenderer renderer_;  // of the picture
};

}  // namespace tidemark::cli
