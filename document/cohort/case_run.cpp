#include "document/cohort/case_run.h"

#include <stdlib.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <span>
#include <thread>

#include "core/atomic_file.h"
#include "core/stopwatch.h"
#include "core/text_file.h"
#include "core/unfinished.h"
#include "core/without_exceptions.h"
#include "document/checksum.h"
#include "document/cohort/case_files.h"
#include "document/cohort/lease.h"
#include "document/cohort/pacs_cases.h"
#include "document/evolution.h"
#include "document/speed_map.h"
#include "imaging/archive/private_folder.h"
#include "imaging/files/volume_file.h"
#include "imaging/filters/filters.h"
#include "imaging/filters/suggest_start.h"
#include "imaging/guard/guarded.h"
#include "imaging/load_study.h"
#include "imaging/results/results.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;

// The case while it is computed.
class Case {
 public:
  Case(const CaseRun& run, const WorkRow& row, fs::path folder, const Progress& progress)
      : run_(run), row_(row), folder_(std::move(folder)), progress_(progress) {}

  Status compute();
  [[nodiscard]] CaseStatus& status() { return status_; }
  // After a failure: it is the server's, or the way's to it.
  [[nodiscard]] bool is_server_away() const { return is_server_away_; }

 private:
  Status take_recipe();
  Status bring();
  Status blame_server(const Error& error);
  Result<imaging::LoadedSeries> load_series();
  Status load();
  Status fill_in();
  Status suggest();
  Status start_from_mask();
  Status set_seeds();
  Status set_drive();
  Status evolve();
  void warn(const document::Evolution& evolution);
  Status write();
  void remark_frame(const char* column, std::span<const std::string> named);

  const CaseRun& run_;
  const WorkRow& row_;
  fs::path folder_;
  Progress progress_;
  CaseStatus status_;
  bool is_server_away_ = false;
  std::optional<imaging::PrivateFolder> brought_;  // results refer to its files
  std::optional<SharedRecipe> own_recipe_;
  const SharedRecipe* shared_ = nullptr;  // null: none
  imaging::Series series_;
  std::shared_ptr<const Volume> source_;  // as the solver sees it
  document::Recipe recipe_;
  solver::Field phi_;
  solver::SurfaceStatistics surface_;
};

Status Case::compute() {
  for (const auto step : {&Case::take_recipe, &Case::load, &Case::fill_in, &Case::evolve, &Case::write}) {
    TIDEMARK_TRY((this->*step)());
    if (progress_.cancelled()) return cancelled_error();
  }
  return {};
}

Status Case::take_recipe() {
  status_.recipe_checksum = run_.plan.recipe_checksum;
  if (run_.plan.recipe) shared_ = &*run_.plan.recipe;
  if (row_.recipe.empty()) return {};
  const auto text = read_text_file(row_.recipe, document::Recipe::kLargestFile);
  if (!text) return pass_on(text);
  auto own = SharedRecipe::parse(*text, row_.recipe.string(), true);
  if (!own) return pass_on(own);
  status_.recipe_checksum = document::sha256(std::as_bytes(std::span(*text)));
  status_.remarks = own->remarks();
  own_recipe_ = std::move(*own);
  shared_ = &*own_recipe_;
  return {};
}

// A server may be busy for a while. What is not there is asked for once more; who answers nobody, for some
// seconds.
Status Case::bring() {
  const auto server = run_.servers.server(row_.server);
  if (!server) return blame_server(server.error());
  auto folder = imaging::PrivateFolder::create();
  if (!folder) return pass_on(folder);
  brought_.emplace(std::move(*folder));
  Status brought;
  bool answers = true;
  for (const int pause_s : {0, 1, 3, 6}) {
    std::this_thread::sleep_for(std::chrono::seconds(pause_s));
    brought = bring_series(run_.servers, row_, brought_->path(), progress_);
    if (brought) return {};
    // The port that the server sends to is somebody else's.
    if (brought.error().kind == ErrorKind::capability) return blame_server(brought.error());
    if (brought.error().kind != ErrorKind::input) return brought;
    answers = imaging::pacs_echo(*server, progress_).has_value();
    if (answers && pause_s > 0) return brought;
  }
  return answers ? brought : blame_server(brought.error());
}

Status Case::blame_server(const Error& error) {
  is_server_away_ = true;
  return fail(ErrorKind::input, "{}", error.message);
}

Result<imaging::LoadedSeries> Case::load_series() {
  if (row_.server.empty()) return imaging::load_with_series(row_.input, row_.series, progress_);
  TIDEMARK_TRY(bring());
  auto study = imaging::load_with_series(brought_->path(), row_.series, progress_);
  if (study) return study;
  // The folder has gone when somebody reads this.
  return fail(study.error().kind, "{}: {}", row_.place(),
              imaging::without_path(study.error().message, brought_->path()));
}

Status Case::load() {
  auto study = load_series();
  if (!study) return pass_on(study);
  series_ = std::move(study->series);
  const std::vector<std::string>& changes = study->volume.changes;
  status_.remarks.insert(status_.remarks.end(), changes.begin(), changes.end());
  status_.input_checksum = document::checksum_of(study->volume);
  recipe_.source = {study->volume.geometry.size, study->volume.geometry.spacing_mm, row_.series,
                    status_.input_checksum, series_.policy};
  const double smooth_mm = row_.smooth_mm.value_or(shared_ != nullptr ? shared_->smoothed_mm() : 0.0);
  recipe_.smoothed_mm = smooth_mm;
  Result<Volume> volume = std::move(study->volume);
  if (smooth_mm > 0.0) volume = imaging::smooth(*volume, smooth_mm);
  if (!volume) return pass_on(volume);
  source_ = std::make_shared<const Volume>(std::move(*volume));
  return {};
}

Status Case::fill_in() {
  recipe_.parameters = parameters_of(row_, shared_);
  if (shared_ != nullptr && !row_.alpha) {
    std::string spacing = document::spacing_difference(shared_->spacing_mm(), *source_);
    if (!spacing.empty()) status_.remarks.push_back(std::move(spacing));
  }
  recipe_.steps = row_.steps.value_or(row_.max_steps.value_or(solver::kMostStepsToRest));
  if (shared_ != nullptr && !row_.has_start() && !row_.auto_start) recipe_.start = shared_->start();
  recipe_.start.levels =
      static_cast<int>(row_.levels.value_or(shared_ != nullptr ? shared_->start().levels : 1));
  if (row_.threshold) {
    recipe_.start.from = document::ThresholdStart{row_.threshold->first, row_.threshold->second};
  }
  TIDEMARK_TRY(start_from_mask());
  TIDEMARK_TRY(set_seeds());
  TIDEMARK_TRY(set_drive());
  return suggest();
}

// Where the file in that column names another frame of reference than the study.
void Case::remark_frame(const char* column, std::span<const std::string> named) {
  if (const auto remark = imaging::frame_remark(named, series_.frame_of_reference_uid))
    status_.remarks.push_back(fmt::format("{}: {}", column, *remark));
}

Status Case::start_from_mask() {
  if (row_.mask.empty()) return {};
  auto loaded = imaging::load_any_mask(row_.mask, &source_->geometry, progress_);
  if (!loaded) return pass_on(loaded);
  for (const std::string& change : loaded->changes) status_.remarks.push_back("mask: " + change);
  remark_frame("mask", loaded->frames_of_reference);
  document::MaskStart start{std::make_shared<const BitMask>(loaded->mask), row_.mask.filename().string()};
  const auto within_mm = row_.within_mm       ? row_.within_mm
                         : shared_ != nullptr ? shared_->within_mm()
                                              : std::nullopt;
  if (within_mm) {
    auto refined = document::limited(std::move(start), *within_mm);
    if (!refined) return pass_on(refined);
    start = std::move(*refined);
  }
  recipe_.start.from = std::move(start);
  return {};
}

Status Case::set_seeds() {
  for (const Seed& seed : row_.seeds) {
    recipe_.start.seeds.push_back({source_->geometry.to_patient(seed.centre), seed.radius_mm});
  }
  for (const Seed& seed : row_.seeds_mm) recipe_.start.seeds.push_back({seed.centre, seed.radius_mm});
  return document::check_spheres(recipe_.start, source_->geometry);
}

Status Case::set_drive() {
  document::Drive drive;
  if (shared_ != nullptr) drive.setting = shared_->setting();
  if (!row_.speed_map.empty()) {
    auto map = document::load_speed_map(row_.speed_map, source_->geometry, progress_);
    if (!map) return pass_on(map);
    remark_frame("speed_map", {&(*map)->frame_of_reference_uid, 1});
    drive.map = std::move(*map);
  }
  if (!is_plain(drive)) recipe_.drive = std::make_shared<const document::Drive>(std::move(drive));
  return {};
}

// What neither the row nor the recipe has, from the volume itself.
Status Case::suggest() {
  if (!row_.auto_start) return {};
  imaging::StartHints hints;
  if (row_.target || shared_ != nullptr) hints.target = recipe_.parameters.target;
  if (row_.range || shared_ != nullptr) hints.range = recipe_.parameters.range;
  if (!recipe_.start.seeds.empty()) {
    const glm::dvec3 voxel = source_->geometry.to_voxel(recipe_.start.seeds.front().centre_mm);
    hints.seed = glm::clamp(Index3(glm::round(voxel)), Index3(0), source_->geometry.size - Index3(1));
  }
  const auto found = imaging::suggest_start(*source_, hints, progress_);
  if (!found) return fail(found.error().kind, "{}: auto_start: {}", row_.place(), found.error().message);
  if (recipe_.start.empty()) {
    recipe_.start.seeds.push_back({source_->geometry.to_patient(glm::dvec3(found->voxel)), found->radius_mm});
  }
  if (!hints.target) recipe_.parameters.target = found->target;
  if (!hints.range) recipe_.parameters.range = found->range;
  if (!row_.alpha && shared_ == nullptr) recipe_.parameters.alpha = found->alpha;
  return {};
}

Status Case::evolve() {
  const double smoothed_mm = std::exchange(recipe_.smoothed_mm, 0.0);  // by load(): evolve() smooths nothing
  solver::ExecutorOptions options;
  options.threads = run_.threads;
  if (run_.memory_bytes > 0) options.memory_budget_bytes = run_.memory_bytes;
  auto evolution =
      document::evolve(recipe_, source_, {solver::ExecutorKind::host, options, !row_.steps}, progress_);
  if (!evolution) return pass_on(evolution);
  recipe_.smoothed_mm = smoothed_mm;
  recipe_.executor = evolution->executor;
  recipe_.steps = evolution->advance.steps;
  CaseFigures figures;
  figures.steps = evolution->advance.steps;
  figures.solver_seconds = evolution->advance.seconds;
  figures.solver_outcome = document::name_of(evolution->outcome);
  status_.figures = figures;
  surface_ = evolution->surface;
  phi_ = std::move(evolution->phi);
  warn(*evolution);
  return {};
}

void Case::warn(const document::Evolution& evolution) {
  using document::Outcome;
  const auto when = [&](bool holds, CaseWarning warning) {
    if (holds) status_.warnings.push_back(warning);
  };
  const Outcome outcome = evolution.outcome;
  when(outcome == Outcome::vanished || outcome == Outcome::seeded_outside, CaseWarning::vanished);
  when(outcome == Outcome::filled_volume, CaseWarning::filled);
  when(!row_.steps && outcome == Outcome::unfinished, CaseWarning::not_converged);
}

Status Case::write() {
  const CaseResult result{*source_, phi_, surface_, recipe_, imaging::dicom_files_of(series_), run_.threads};
  return imaging::exported(write_case_files(run_.plan, row_, result, folder_, status_, progress_),
                           imaging::audited_study(series_),
                           {run_.cases.empty() ? folder_ : run_.cases / row_.id});
}

CaseOutcome outcome_of(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::usage:
    case ErrorKind::input:
      return CaseOutcome::refused;
    case ErrorKind::capability:
      return CaseOutcome::out_of_memory;
    default:
      return CaseOutcome::failed;
  }
}

std::int64_t peak_memory_bytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::int64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

Result<CaseStatus> run_case(const CaseRun& run, const WorkRow& row, const fs::path& folder,
                            const Progress& progress) {
  const Stopwatch watch;
  Case one(run, row, folder, progress);
  const Status computed = without_exceptions([&]() -> Status { return one.compute(); });
  CaseStatus& status = one.status();
  if (!computed) {
    const Error& error = computed.error();
    const bool is_no_fault_of_it =
        error.kind == ErrorKind::write || error.kind == ErrorKind::cancelled || one.is_server_away();
    if (is_no_fault_of_it) return tl::unexpected(error);
    status.outcome = outcome_of(error.kind);
    status.reason = error.message;
    status.figures.reset();
    status.warnings.clear();
    status.files.clear();
  } else {
    status.outcome = CaseOutcome::done;
  }
  status.id = row.id;
  status.input = row.place();
  status.series = row.series;
  status.program = run.program;
  status.machine = this_machine();
  status.finished = utc_now();
  status.seconds = watch.seconds();
  status.peak_memory_bytes = peak_memory_bytes();
  return std::move(status);
}

void warm_up(const CaseRun& run) {
  std::error_code error;
  std::string name = (fs::temp_directory_path(error) / "tidemark-XXXXXX").string();
  if (error || ::mkdtemp(name.data()) == nullptr) return;
  const fs::path folder = name;
  const Unfinished unfinished(folder);
  {
    const SyncLater later;
    Volume volume;
    volume.geometry.size = Index3(8);
    std::vector<std::int16_t> voxels(512);
    for (std::size_t i = 0; i < voxels.size(); ++i) voxels[i] = i % 8 < 4 ? 100 : 0;
    volume.voxels = std::move(voxels);
    const fs::path input = folder / "volume.nii.gz";
    WorkRow row;
    row.input = input;
    row.seeds.push_back({glm::dvec3(2.0), 2.0});
    row.target = 100.0;
    row.range = 50.0;
    row.steps = 4;
    const CohortPlan plan{{}, {}, {}, run.plan.pictures, {}, {}, {}};
    // What goes wrong here goes wrong in each case, too, and is noted there.
    if (imaging::write_volume_file(volume, input)) {
      const auto status = run_case({plan, 1, 0, {}}, row, folder);
      if (status) static_cast<void>(status->to_text());
    }
  }
  fs::remove_all(folder, error);
}

}  // namespace tidemark::cohort
