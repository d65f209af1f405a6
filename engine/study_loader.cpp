#include "engine/study_loader.h"

#include <QStringList>
#include <algorithm>

#include "engine/phantom_text.h"
#include "imaging/archive/study_archive.h"
#include "imaging/filters/suggest_start.h"
#include "imaging/load_study.h"
#include "imaging/phantom/phantom_name.h"

namespace tidemark::engine {
namespace {

namespace fs = std::filesystem;

// The first T and epsilon of a study.
solver::Parameters suggest_parameters(const Volume& volume, const Progress& progress) {
  solver::Parameters parameters;
  if (const auto suggestion = imaging::suggest_start(volume, {}, progress)) {
    parameters.target = suggestion->target;
    parameters.range = suggestion->range;
    parameters.alpha = suggestion->alpha;
  } else {
    parameters.target = static_cast<double>(volume.range().first);  // all voxels have this value
  }
  return parameters;
}

Result<LoadedStudy> load_study(const imaging::ChosenSeries& chosen, const Progress& progress) {
  const imaging::Series& series = chosen.series;
  auto volume = imaging::load_series(chosen, progress);
  if (!volume) return pass_on(volume);
  LoadedStudy study;
  study.volume = std::make_shared<const Volume>(std::move(*volume));
  study.origin.path = StudyLoader::place_of(series);
  study.origin.series_uid = series.uid;
  study.origin.policy = series.policy;
  study.dicom_files = imaging::dicom_files_of(series);
  study.slice_numbers = imaging::slice_numbers(series);
  study.name = StudyLoader::name_of(series);
  study.frame_of_reference_uid = series.frame_of_reference_uid;
  study.patient = series.patient;
  study.audited = imaging::audited_study(series);
  study.date = series.date;
  study.archive = series.archive;
  study.origin.name = study.name.toStdString();
  study.origin.date = series.date;
  progress(0.0, "measuring values");
  study.summary = summarise(*study.volume, progress);
  study.parameters = suggest_parameters(*study.volume, progress);
  if (progress.cancelled()) return cancelled_error();
  return study;
}

// What there is to choose from. A single series that cannot be loaded is no choice: its reason is the answer.
Result<imaging::Catalogue> find_choice(const fs::path& path, const imaging::GridPolicy& policy,
                                       const Progress& progress) {
  auto catalogue = find_series(path, progress, policy);
  if (!catalogue || catalogue->series.size() != 1) return catalogue;
  const imaging::Series& only = catalogue->series.front();
  if (only.loadable || only.fillable()) return catalogue;
  return fail(ErrorKind::input, "{}", imaging::reason_under(path, only));
}

// The series to load of what lies under the path.
Result<LoadedStudy> find_and_load(const fs::path& path, const std::string& uid,
                                  const imaging::GridPolicy& policy, const Progress& progress) {
  const auto catalogue = find_series(path, progress, policy);
  if (!catalogue) return pass_on(catalogue);
  const auto chosen = imaging::choose_series(*catalogue, uid, path);
  if (!chosen) return pass_on(chosen);
  return load_study(*chosen, progress);
}

Result<LoadedStudy> make_phantom_study(const std::string& name, const Progress& progress) {
  progress(0.0, "making the phantom");
  const auto wanted = imaging::parse_phantom_name(name);
  if (!wanted) return pass_on(wanted);
  auto phantom = imaging::make_phantom(wanted->kind, wanted->options, progress);
  if (!phantom) return pass_on(phantom);
  LoadedStudy study;
  study.origin.phantom = name;
  study.name = phantom_text(name).title;  // as it was chosen
  study.patient.name = "Phantom";
  study.origin.name = study.name.toStdString();
  study.volume = std::make_shared<const Volume>(std::move(phantom->volume));
  study.parameters.target = phantom->target;
  study.parameters.range = phantom->range;
  study.parameters.alpha = phantom->alpha;
  study.truth = std::make_shared<const BitMask>(phantom->truth);
  study.start = PhantomStart{phantom->seed, phantom->init_threshold};
  progress(0.0, "measuring values");
  study.summary = summarise(*study.volume, progress);
  if (progress.cancelled()) return cancelled_error();
  return study;
}

}  // namespace

StudyLoader::StudyLoader(QObject* parent) : JobRunner(parent) {}

void StudyLoader::scan(const fs::path& path, const imaging::GridPolicy& policy) {
  run([path, policy](const Progress& progress) { return find_choice(path, policy, progress); },
      [this](imaging::Catalogue&& catalogue) {
        emit found(std::make_shared<const imaging::Catalogue>(std::move(catalogue)));
      });
}

void StudyLoader::load(const fs::path& path, const std::string& uid, const imaging::GridPolicy& policy) {
  run([path, uid, policy](const Progress& progress) { return find_and_load(path, uid, policy, progress); },
      [this](LoadedStudy&& study) { emit loaded(std::make_shared<const LoadedStudy>(std::move(study))); });
}

void StudyLoader::load(const imaging::Series& series, const std::vector<std::string>& remarks) {
  run(
      [series, remarks](const Progress& progress) {
        return load_study({series, remarks}, progress);
      },
      [this](LoadedStudy&& study) { emit loaded(std::make_shared<const LoadedStudy>(std::move(study))); });
}

void StudyLoader::make_phantom(const std::string& name) {
  run([name](const Progress& progress) { return make_phantom_study(name, progress); },
      [this](LoadedStudy&& study) { emit loaded(std::make_shared<const LoadedStudy>(std::move(study))); });
}

fs::path StudyLoader::place_of(const imaging::Series& series) {
  if (series.files.empty()) return {};
  if (series.archive) return series.archive->file();
  if (series.transfer_syntaxes.empty()) return series.files.front();  // a volume file
  fs::path folder = series.files.front().parent_path();
  for (const fs::path& file : series.files) {
    while (std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first != folder.end()) {
      folder = folder.parent_path();
    }
  }
  return folder;
}

QString StudyLoader::name_of(const imaging::Series& series) {
  const QString description = QString::fromStdString(series.description).trimmed();
  const bool is_file = series.transfer_syntaxes.empty();
  // A series without a description lists the name of one of its files, which may be the patient's.
  const auto is_description = [&](const fs::path& file) {
    return file.filename().string() == series.description;
  };
  const bool is_described = is_file || std::none_of(series.files.begin(), series.files.end(), is_description);
  if (is_described && !description.isEmpty()) return description;
  const QStringList known{QString::fromStdString(series.modality), QString::fromStdString(series.date)};
  const QString text = known.join(QLatin1Char(' ')).trimmed();
  return text.isEmpty() ? tr("Series without a description") : text;
}

}  // namespace tidemark::engine
