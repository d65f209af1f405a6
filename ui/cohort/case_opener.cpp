#include "ui/cohort/case_opener.h"

#include <span>
#include <system_error>

#include "document/checksum.h"
#include "document/cohort/pacs_cases.h"
#include "document/evolution.h"
#include "document/replay.h"
#include "document/speed_map.h"
#include "document/truth.h"
#include "engine/job_runner.h"
#include "solver/inside_region.h"
#include "ui/settings.h"

namespace tidemark::ui {
namespace {

using Contents = std::shared_ptr<const document::SessionContents>;

// Null where there is none.
Result<std::shared_ptr<const document::Recipe>> recipe_of(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return nullptr;
  auto recipe = document::Recipe::load(file);
  if (!recipe) return pass_on(recipe);
  return std::make_shared<const document::Recipe>(std::move(*recipe));
}

// The recipe names its map by a checksum; the row says where it is.
Status give_map(document::Recipe& recipe, const std::filesystem::path& file, const Geometry& grid,
                const Progress& progress) {
  if (file.empty()) return {};
  const auto map = document::load_speed_map(file, grid, progress);
  if (!map) return pass_on(map);
  recipe.change_drives([&](document::Drive& drive) {
    if (drive.map && drive.map->checksum == (*map)->checksum) drive.map = *map;
  });
  return {};
}

// Named by what it holds, without saying whose it is.
std::filesystem::path folder_for(const cohort::WorkRow& row) {
  constexpr std::size_t kLetters = 32;
  const std::string name = row.server + "/" + row.study + "/" + row.series;
  const std::filesystem::path kept = settings::retrieval_folder().get().toStdString();
  return kept / document::sha256(std::as_bytes(std::span(name))).substr(0, kLetters);
}

// The series of a row on a server. It comes whole, once, and is the same for each cohort.
Result<std::filesystem::path> brought(const cohort::WorkRow& row, const std::filesystem::path& servers_file,
                                      const std::filesystem::path& folder, const Progress& progress) {
  std::error_code error;
  if (!std::filesystem::is_empty(folder, error) && !error) return folder;
  const auto servers = cohort::servers_of(servers_file, {&row, 1});
  if (!servers) return pass_on(servers);
  const std::string problem = cohort::problem_with_server(row, *servers);
  if (!problem.empty()) return fail(ErrorKind::input, "{}: {}", row.id, problem);
  std::filesystem::create_directories(folder.parent_path(), error);
  TIDEMARK_TRY(cohort::bring_series(*servers, row, folder, progress));
  return folder;
}

// A surface that is another one than the cohort has must not be taken for it.
Result<Contents> result_of(document::Recipe recipe, const engine::LoadedStudy& study,
                           const cohort::ReviewEntry& entry, const Progress& progress) {
  const cohort::WorkRow& row = entry.row;
  const auto differences = document::differences(recipe, *study.volume);
  if (!differences.empty()) return fail(ErrorKind::input, "{}: {}", row.place(), differences.front());
  TIDEMARK_TRY(give_map(recipe, row.speed_map, study.volume->geometry, progress));
  auto contents = document::replay(std::move(recipe), study.volume, study.origin, progress);
  if (!contents) return pass_on(contents);
  const std::int64_t voxels = solver::inside_region(*contents->phi).count();
  if (entry.status->figures && voxels != entry.status->figures->voxels_inside) {
    return fail(ErrorKind::input, "{}: its recipe makes {} voxels now, its result has {}", row.id, voxels,
                entry.status->figures->voxels_inside);
  }
  if (!row.truth.empty()) {
    auto truth = document::load_truth(row.truth, row.truth_label, study.volume->geometry, progress);
    if (!truth) return pass_on(truth);
    contents->truth = std::make_shared<const BitMask>(std::move(*truth));
  }
  return std::make_shared<const document::SessionContents>(std::move(*contents));
}

}  // namespace

class CaseOpener::Work : public engine::JobRunner {
 public:
  using JobRunner::give_up;
  using JobRunner::run;
};

CaseOpener::CaseOpener() : work_(std::make_unique<Work>()) {
  connect(&loader_, &engine::StudyLoader::loaded, this, &CaseOpener::replay);
  for (engine::JobRunner* runner :
       {static_cast<engine::JobRunner*>(&loader_), static_cast<engine::JobRunner*>(work_.get())}) {
    connect(runner, &engine::JobRunner::progressed, this, &CaseOpener::progressed);
    connect(runner, &engine::JobRunner::failed, this, &CaseOpener::failed);
  }
}

CaseOpener::~CaseOpener() = default;

void CaseOpener::open(const cohort::CohortFolder& folder, const cohort::CohortPlan& plan,
                      const cohort::ReviewEntry& entry) {
  cancel();
  entry_ = entry;
  servers_file_ = plan.servers_file;
  recipe_ = nullptr;
  if (!entry.status || entry.status->outcome != cohort::CaseOutcome::done) return load({});
  work_->run([file = folder.case_recipe(entry_.row.id)](const Progress&) { return recipe_of(file); },
             [this](std::shared_ptr<const document::Recipe> recipe) {
               recipe_ = std::move(recipe);
               load(recipe_ ? recipe_->source.policy : imaging::GridPolicy());
             });
}

void CaseOpener::cancel() {
  loader_.cancel();
  work_->give_up();
}

void CaseOpener::load(const imaging::GridPolicy& policy) {
  if (!entry_.row.server.empty()) return bring(policy);
  loader_.load(entry_.row.input, entry_.row.series, policy);
}

void CaseOpener::bring(const imaging::GridPolicy& policy) {
  work_->run([row = entry_.row, file = servers_file_, folder = folder_for(entry_.row)](
                 const Progress& progress) { return brought(row, file, folder, progress); },
             [this, policy](const std::filesystem::path& folder) {
               loader_.load(folder, entry_.row.series, policy);
             });
}

void CaseOpener::replay(const std::shared_ptr<const engine::LoadedStudy>& study) {
  if (!recipe_) return emit opened(study, nullptr);
  work_->run([study, entry = entry_, recipe = recipe_](
                 const Progress& progress) { return result_of(*recipe, *study, entry, progress); },
             [this, study](const Contents& contents) { emit opened(study, contents); });
}

}  // namespace tidemark::ui
