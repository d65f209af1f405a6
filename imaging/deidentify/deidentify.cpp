#include "imaging/deidentify/deidentify.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <memory>
#include <system_error>
#include <tuple>
#include <utility>

#include "imaging/deidentify/cleaner.h"
#include "imaging/deidentify/risk.h"
#include "imaging/deidentify/shifted_date.h"
#include "imaging/dicom/detect.h"
#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/element_text.h"
#include "imaging/dicom/parsed_dicom.h"
#include "imaging/dicom/read_patient.h"
#include "imaging/dicom/write_dicom_file.h"
#include "imaging/guard/guarded.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// A name or an ID is written as it is, whatever character set a file has.
Status check_pseudonym(const char* what, const std::optional<std::string>& text) {
  if (!text) return {};
  const bool is_plain =
      std::all_of(text->begin(), text->end(), [](char c) { return c >= 0x20 && c <= 0x7e && c != '\\'; });
  if (!text->empty() && text->size() <= 64 && is_plain && text->find_first_not_of(' ') != std::string::npos) {
    return {};
  }
  return fail(ErrorKind::usage, "'{}' is no {}: 1 to 64 letters of ASCII, and no backslash", *text, what);
}

Status check_options(const DeidentifyOptions& options) {
  TIDEMARK_TRY(check_pseudonym("PatientID", options.patient_id));
  TIDEMARK_TRY(check_pseudonym("PatientName", options.patient_name));
  if (!options.shift_days) return {};
  const int days = *options.shift_days;
  if (days != 0 && std::abs(days) <= kMostShiftDays) return {};
  return fail(ErrorKind::usage, "dates cannot be moved by {} days: 1 to {} forward or back", days,
              kMostShiftDays);
}

// "(0008,1140)[2].(0008,1155)" without the number.
std::string without_items(const std::string& path) {
  std::string text;
  bool inside = false;
  for (const char c : path) {
    if (c == '[') inside = true;
    if (!inside) text += c;
    if (c == ']') inside = false;
  }
  return text;
}

class Run {
 public:
  Run(const DeidentifyOptions& options, Deidentified& result)
      : options_(options), pseudonyms_(options), cleaner_(options, pseudonyms_), result_(result) {}

  Status take(const fs::path& file);
  void finish() {
    result_.counts = cleaner_.counts();
    for (const auto& [key, values] : totals_) {
      const auto& [path, keyword, change] = key;
      result_.totals.push_back({{path, keyword, change}, values});
    }
    result_.series = static_cast<std::int64_t>(series_.size());
    result_.uids = pseudonyms_.known_uids();
    result_.patients = pseudonyms_.known_patients();
  }

 private:
  // Files of a series that have been written.
  struct SeriesFolder {
    std::size_t number = 0;
    std::size_t files = 0;
  };

  void leave_out(const fs::path& file, std::string reason, LeftOutFile::Kind kind) {
    result_.left_out.push_back({file, std::move(reason), kind});
  }
  Status write(ParsedDicom parsed, DeidentifiedFile written);
  Result<std::string> name_for(const std::string& series_uid);
  void record(std::vector<ChangedAttribute> changes, DeidentifiedFile& written);

  DeidentifyOptions options_;
  Pseudonyms pseudonyms_;
  Cleaner cleaner_;
  Deidentified& result_;
  std::map<std::string, SeriesFolder> series_;
  std::map<std::tuple<std::string, std::string, Change>, std::int64_t> totals_;  // by path and keyword
};

Status Run::take(const fs::path& file) {
  using Kind = LeftOutFile::Kind;
  auto bytes = FileBytes::open(file);
  if (!bytes) {
    leave_out(file, without_path(bytes.error().message, file), Kind::unreadable);
    return {};
  }
  if (!begins_as_dicom(*bytes)) {
    leave_out(file, "is no DICOM file", Kind::not_dicom);
    return {};
  }
  auto parsed = guarded(file, [&] { return ParsedDicom::open(file); });
  if (!parsed) {
    leave_out(file, without_path(parsed.error().message, file), Kind::unreadable);
    return {};
  }
  DcmDataset& dataset = parsed->dataset();
  if (parsed->checked().verdict == Preflight::Verdict::bad_pixels) {
    leave_out(file, describe(parsed->checked()), Kind::unreadable);
  } else if (is_directory_object(dataset)) {
    leave_out(file, "is a DICOMDIR", Kind::document);
  } else if (std::string reason = document_reason(dataset); !reason.empty()) {
    leave_out(file, std::move(reason), Kind::document);
  } else if (std::string risk = pixel_risk(dataset); !risk.empty() && !options_.with_risky_images) {
    leave_out(file, std::move(risk), Kind::risky);
  } else {
    return write(std::move(*parsed), {file, {}, std::move(risk), {}});
  }
  return {};
}

Result<std::string> Run::name_for(const std::string& series_uid) {
  SeriesFolder& series = series_[series_uid];
  if (series.number == 0) series.number = series_.size();
  const std::string folder = fmt::format("series-{:03}", series.number);
  std::error_code error;
  fs::create_directory(result_.folder.temporary_path() / folder, error);
  if (error) return fail(ErrorKind::write, "{}: cannot write: {}", folder, error.message());
  return fmt::format("{}/{:06}.dcm", folder, ++series.files);
}

void Run::record(std::vector<ChangedAttribute> changes, DeidentifiedFile& written) {
  for (const ChangedAttribute& one : changes) ++totals_[{without_items(one.path), one.keyword, one.change}];
  if (options_.record == RecordedChanges::each) written.changes = std::move(changes);
}

Status Run::write(ParsedDicom parsed, DeidentifiedFile written) {
  const E_TransferSyntax syntax = parsed.syntax().is_deflated
                                      ? EXS_LittleEndianExplicit
                                      : DcmXfer(std::string(parsed.syntax().uid).c_str()).getXfer();
  const auto name = name_for(element_text(parsed.dataset(), DCM_SeriesInstanceUID));
  if (!name) return pass_on(name);
  written.name = *name;
  const std::unique_ptr<DcmFileFormat> whole = parsed.take();
  std::unique_ptr<DcmDataset> dataset(whole->getAndRemoveDataset());
  const AuditedStudy study = read_audited_study(*dataset);
  if (Status clean = cleaner_.clean(*dataset); !clean) {
    return fail(clean.error().kind, "{}: {}", written.source.string(), clean.error().message);
  }
  record(cleaner_.take_changes(), written);
  // With a preamble and a meta header of its own, which say nothing of where the file comes from.
  constexpr OFBool kNoCopy = OFFalse;
  DcmFileFormat object(dataset.release(), kNoCopy);
  TIDEMARK_TRY(write_dicom_file(object, syntax, result_.folder.temporary_path() / written.name));
  result_.files.push_back(std::move(written));
  add_study(result_.studies, study);
  return {};
}

Result<Deidentified> deidentify_all(const std::vector<fs::path>& files, const fs::path& folder,
                                    const DeidentifyOptions& options, const Progress& progress) {
  TIDEMARK_TRY(check_options(options));
  TIDEMARK_TRY(set_up_dicom());
  auto whole = AtomicFolder::create(folder);
  if (!whole) return pass_on(whole);
  Deidentified result{std::move(*whole), {}, {}, {}, {}, 0, {}, {}, {}};
  const SyncLater later;
  Run run(options, result);
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (progress.cancelled()) return cancelled_error();
    if (Status taken = run.take(files[i]); !taken) {
      const std::string inside = result.folder.temporary_path().string();
      std::string told = taken.error().message;
      if (told.starts_with(inside)) told.replace(0, inside.size(), folder.string());
      return fail(taken.error().kind, "{}", told);
    }
    progress(static_cast<double>(i + 1) / static_cast<double>(files.size()), "de-identifying files");
  }
  run.finish();
  if (result.files.empty()) {
    const auto told =
        std::find_if(result.left_out.begin(), result.left_out.end(),
                     [](const LeftOutFile& file) { return file.kind != LeftOutFile::Kind::not_dicom; });
    if (told == result.left_out.end()) return fail(ErrorKind::input, "there is no DICOM file to de-identify");
    return fail(ErrorKind::input, "{}: {}", told->file.string(), told->reason);
  }
  TIDEMARK_TRY(sync_file_system(result.folder.temporary_path()));
  return result;
}

}  // namespace

Result<Deidentified> deidentify(const std::vector<fs::path>& files, const fs::path& folder,
                                const DeidentifyOptions& options, const Progress& progress) {
  return guarded_writing(folder, [&] { return deidentify_all(files, folder, options, progress); });
}

}  // namespace tidemark::imaging
