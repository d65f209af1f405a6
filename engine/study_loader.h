// The search for studies and their loading, beside the user interface.
#pragma once

#include <QString>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/bit_mask.h"
#include "core/volume.h"
#include "document/origin.h"
#include "engine/job_runner.h"
#include "engine/source_summary.h"
#include "imaging/audit/event.h"
#include "imaging/dicom/slice_number.h"
#include "imaging/patient.h"
#include "imaging/series.h"
#include "solver/parameters.h"

namespace tidemark::engine {

// The start that suits a phantom; where there are both, the threshold is the quick way.
struct PhantomStart {
  std::optional<std::array<double, 4>> seed;           // i, j, k (voxels), radius (mm)
  std::optional<std::pair<double, double>> threshold;  // low, high, in the volume's units
};

// All that a case begins with.
struct LoadedStudy {
  std::shared_ptr<const Volume> volume;
  document::StudyOrigin origin;
  std::vector<std::filesystem::path> dicom_files;   // in slice order: results refer to them; empty: not DICOM
  std::vector<imaging::SliceNumber> slice_numbers;  // of the volume's slices along k; empty: not DICOM
  SourceSummary summary;
  QString name;                        // for titles; never the patient's
  std::string frame_of_reference_uid;  // empty where it is not known
  imaging::Patient patient;
  imaging::AuditedStudy audited;  // the same patient and study, for audit messages
  std::string date;               // of the study: "2004-07-31"; empty when unknown
  solver::Parameters parameters;  // that suit some even, bright tissue in the middle, or the phantom
  std::optional<PhantomStart> start;
  std::shared_ptr<const BitMask> truth;  // of a phantom, on the volume's grid; null: not known
  std::shared_ptr<const imaging::StudyArchive>
      archive;  // keeps the files of a series that lies in an archive
};

class StudyLoader : public JobRunner {
  Q_OBJECT
 public:
  explicit StudyLoader(QObject* parent = nullptr);

  // Ends with found(), or with failed() where nothing can be loaded or the only series cannot, not even with
  // its gaps filled.
  void scan(const std::filesystem::path& path, const imaging::GridPolicy& policy = {});
  // End with loaded() or failed(). An empty uid: the only loadable series, or the one with the most voxels.
  void load(const std::filesystem::path& path, const std::string& uid,
            const imaging::GridPolicy& policy = {});
  // The remarks are shown with the changes that loading made.
  void load(const imaging::Series& series, const std::vector<std::string>& remarks = {});
  void make_phantom(const std::string& name);  // as imaging::parse_phantom_name() takes it

  void cancel() { give_up(); }

  // The folder or file under which a series is found again: the one folder that holds all its files, or its
  // archive.
  [[nodiscard]] static std::filesystem::path place_of(const imaging::Series& series);
  // The name of a series in titles: its description, else modality and date.
  [[nodiscard]] static QString name_of(const imaging::Series& series);

 signals:
  void found(std::shared_ptr<const tidemark::imaging::Catalogue> catalogue);
  void loaded(std::shared_ptr<const tidemark::engine::LoadedStudy> study);
};

}  // namespace tidemark::engine
