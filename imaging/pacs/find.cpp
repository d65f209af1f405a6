#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dimse.h>

#include <algorithm>

#include "core/without_exceptions.h"
#include "imaging/dicom/character_sets.h"
#include "imaging/dicom/element_text.h"
#include "imaging/pacs/answer_text.h"
#include "imaging/pacs/association.h"
#include "imaging/pacs/found_answer.h"
#include "imaging/pacs/services.h"
#include "imaging/pacs/storage_classes.h"
#include "imaging/pacs/web/web_services.h"
#include "imaging/web/clean_text.h"

namespace tidemark::imaging {
namespace {

constexpr std::size_t kLongestKey = 64;  // characters (DICOM PS3.5 6.2, LO)

// The query: attributes to match, and empty ones to be returned.
class Question {
 public:
  Question(const char* level, const QueryKeys& keys) {
    put(DCM_QueryRetrieveLevel, level);
    for (const auto& [key, value] : keys) put(key, value);
  }
  DcmDataset& dataset() {
    if (!is_ascii_) dataset_.putAndInsertString(DCM_SpecificCharacterSet, "ISO_IR 192");
    return dataset_;
  }
  // In explicit little endian.
  std::string bytes() {
    constexpr auto kSyntax = EXS_LittleEndianExplicit;
    constexpr auto kLengths = EET_ExplicitLength;
    DcmDataset& whole = dataset();
    std::string bytes(whole.getLength(kSyntax, kLengths), '\0');
    DcmOutputBufferStream stream(bytes.data(), static_cast<offile_off_t>(bytes.size()));
    whole.transferInit();
    const bool is_written = whole.write(stream, kSyntax, kLengths, nullptr).good();
    whole.transferEnd();
    return is_written ? bytes : std::string();
  }

 private:
  void put(const DcmTagKey& key, const std::string& value) {
    dataset_.putAndInsertString(DcmTag(key), value.c_str());
    is_ascii_ = is_ascii_ && std::all_of(value.begin(), value.end(), [](char c) { return (c & 0x80) == 0; });
  }

  DcmDataset dataset_;
  bool is_ascii_ = true;
};

// An answer, in UTF-8 as far as its character sets are known.
class DatasetAnswer final : public FoundAnswer {
 public:
  explicit DatasetAnswer(DcmDataset& dataset)
      : dataset_(dataset),
        character_set_(element_text(dataset, DCM_SpecificCharacterSet).substr(0, kLongestCharacterSet)) {}
  [[nodiscard]] std::string text(const DcmTagKey& key) const override {
    const std::string value = element_text(dataset_, key).substr(0, kLongestRead);
    if (character_set_.empty()) return clean_text(value);
    return clean_text(in_utf8(value, character_set_, DcmTag(key).getEVR() == EVR_PN ? "^=\\" : "\\"));
  }

 private:
  static constexpr std::size_t kLongestCharacterSet = 512;  // bytes: two dozen values
  static constexpr std::size_t kLongestRead = 8192;         // of what clean_text() keeps 512

  DcmDataset& dataset_;
  std::string character_set_;
};

Status check_key(const char* name, const std::string& value) {
  const auto control = [](unsigned char c) { return c < 0x20 || c == '\\' || c == 0x7f; };
  if (value.size() <= 4 * kLongestKey && std::none_of(value.begin(), value.end(), control)) return {};
  return fail(ErrorKind::usage, "{}: is too long, or holds a backslash or control characters", name);
}

// "20040101-20041231", with an open end where a date is empty.
Result<std::string> date_range(const std::string& from, const std::string& to) {
  if (from.empty() && to.empty()) return std::string();
  for (const std::string& date : {from, to}) {
    if (!date.empty() && !dicom_date(date))
      return fail(ErrorKind::usage, "'{}' is no date: 2004-07-31 is one", date.substr(0, 40));
  }
  return dicom_date(from).value_or("") + "-" + dicom_date(to).value_or("");
}

// Asks and takes answer by answer. True when the server had more answers than were taken.
Result<bool> ask(const PacsServer& server, Question question, const TakeAnswer& take,
                 const Progress& progress) {
  progress(-1.0, "asking the server");
  const Proposal proposal{UID_FINDStudyRootQueryRetrieveInformationModel,
                          {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax}};
  auto opened = Association::open(server, {proposal}, progress.stop);
  if (!opened) return pass_on(opened);
  Association& association = **opened;

  T_DIMSE_Message request{};
  request.CommandField = DIMSE_C_FIND_RQ;
  T_DIMSE_C_FindRQ& find = request.msg.CFindRQ;
  find.MessageID = association.next_message_id();
  find.Priority = DIMSE_PRIORITY_MEDIUM;
  find.DataSetType = DIMSE_DATASET_PRESENT;
  OFStandard::strlcpy(find.AffectedSOPClassUID, proposal.abstract_syntax.c_str(), sizeof(DIC_UI));
  const int context = association.context(proposal.abstract_syntax);
  TIDEMARK_TRY(association.send(context, request, &question.dataset()));

  for (;;) {
    T_DIMSE_Message message{};
    auto received = association.receive(message);
    if (!received) return pass_on(received);
    if (message.CommandField != DIMSE_C_FIND_RSP ||
        message.msg.CFindRSP.MessageIDBeingRespondedTo != find.MessageID)
      return fail(ErrorKind::input, "{}: answers something that was not asked", association.watch().peer());
    const T_DIMSE_C_FindRSP& response = message.msg.CFindRSP;
    const bool has_data = response.DataSetType != DIMSE_DATASET_NULL;
    if (!DICOM_PENDING_STATUS(response.DimseStatus)) {
      if (response.DimseStatus != STATUS_Success) {
        return fail(ErrorKind::input, "{}: cannot answer the query (status {:04X})",
                    association.watch().peer(), response.DimseStatus);
      }
      if (!has_data) association.release();
      return false;
    }
    if (!has_data)
      return fail(ErrorKind::input, "{}: answers without saying anything", association.watch().peer());
    auto data = association.receive_data();
    if (!data) return pass_on(data);
    association.watch().completed_message();
    if (!take(DatasetAnswer(**data))) return true;  // the association is aborted
  }
}

PacsStudy study_of(const FoundAnswer& answer) {
  PacsStudy study;
  study.uid = answer.uid(DCM_StudyInstanceUID);
  study.patient_name = answer.text(DCM_PatientName);
  study.patient_id = answer.text(DCM_PatientID);
  study.birth_date = date_text(answer.text(DCM_PatientBirthDate));
  study.date = date_text(answer.text(DCM_StudyDate));
  study.description = answer.text(DCM_StudyDescription);
  study.modalities = split(answer.text(DCM_ModalitiesInStudy), '\\');
  std::erase(study.modalities, "");
  study.series = count_of(answer.text(DCM_NumberOfStudyRelatedSeries));
  study.objects = count_of(answer.text(DCM_NumberOfStudyRelatedInstances));
  return study;
}

PacsSeries series_of(const FoundAnswer& answer, const std::string& study_uid) {
  PacsSeries series;
  series.uid = answer.uid(DCM_SeriesInstanceUID);
  series.study_uid = study_uid;
  series.number = answer.text(DCM_SeriesNumber);
  series.modality = answer.text(DCM_Modality);
  series.description = answer.text(DCM_SeriesDescription);
  series.date = date_text(answer.text(DCM_SeriesDate));
  series.body_part = answer.text(DCM_BodyPartExamined);
  series.objects = count_of(answer.text(DCM_NumberOfSeriesRelatedInstances));
  return series;
}

// What is asked, for both ways of asking.
struct Query {
  const char* level;     // "STUDY"
  std::string resource;  // "studies"
  QueryKeys keys;
};

void audit(const PacsServer& server, const Query& query, std::int64_t most, const Result<bool>& asked) {
  AuditEvent event{.kind = AuditEvent::Kind::queried, .peer = audited_peer(server)};
  if (!asked) event.failure = asked.error().message;
  if (server.web) {
    event.query = question(query.resource, query.keys, most + 1);
  } else {
    event.query = Question(query.level, query.keys).bytes();
    event.query_class = UID_FINDStudyRootQueryRetrieveInformationModel;
  }
  record_audit(event);
}

template <class Entry, class Read>
Result<Found<Entry>> collect(const PacsServer& server, const Query& query, const PacsLimits& limits,
                             const Progress& progress, const Read& read) {
  Found<Entry> found;
  std::int64_t answers = 0;
  const TakeAnswer take = [&](const FoundAnswer& answer) {
    if (++answers > limits.answers) return false;
    Entry entry = read(answer);
    if (!entry.uid.empty()) found.entries.push_back(std::move(entry));
    return true;
  };
  const auto more = server.web
                        ? ask_by_web(server, query.resource, query.keys, limits.answers, take, progress)
                        : ask(server, Question(query.level, query.keys), take, progress);
  audit(server, query, limits.answers, more);
  if (!more) return pass_on(more);
  found.more = *more;
  return found;
}

}  // namespace

bool is_uid(const std::string& text) {
  return !text.empty() && text.size() <= 64 && text.front() != '.' &&
         std::all_of(text.begin(), text.end(), [](char c) { return (c >= '0' && c <= '9') || c == '.'; });
}

Result<Found<PacsStudy>> find_studies(const PacsServer& server, const StudyQuery& query,
                                      const PacsLimits& limits, const Progress& progress) {
  return without_exceptions([&]() -> Result<Found<PacsStudy>> {
    for (const auto& [name, value] : {std::pair{"study UID", &query.uid},
                                      {"patient name", &query.patient_name},
                                      {"patient ID", &query.patient_id},
                                      {"modality", &query.modality},
                                      {"description", &query.description}}) {
      TIDEMARK_TRY(check_key(name, *value));
    }
    auto dates = date_range(query.date_from, query.date_to);
    if (!dates) return pass_on(dates);
    const Query asked{"STUDY",
                      "studies",
                      {{DCM_StudyInstanceUID, query.uid},
                       {DCM_PatientName, query.patient_name},
                       {DCM_PatientID, query.patient_id},
                       {DCM_StudyDate, *dates},
                       {DCM_ModalitiesInStudy, query.modality},
                       {DCM_StudyDescription, query.description},
                       {DCM_PatientBirthDate, ""},
                       {DCM_NumberOfStudyRelatedSeries, ""},
                       {DCM_NumberOfStudyRelatedInstances, ""}}};
    return collect<PacsStudy>(server, asked, limits, progress, study_of);
  });
}

Result<Found<PacsSeries>> find_pacs_series(const PacsServer& server, const SeriesQuery& query,
                                           const PacsLimits& limits, const Progress& progress) {
  return without_exceptions([&]() -> Result<Found<PacsSeries>> {
    if (!is_uid(query.study_uid))
      return fail(ErrorKind::usage, "'{}' is no UID", query.study_uid.substr(0, 80));
    for (const auto& [name, value] :
         {std::pair{"modality", &query.modality}, {"description", &query.description}}) {
      TIDEMARK_TRY(check_key(name, *value));
    }
    const Query asked{"SERIES",
                      "studies/" + query.study_uid + "/series",
                      {{DCM_StudyInstanceUID, query.study_uid},
                       {DCM_SeriesInstanceUID, ""},
                       {DCM_Modality, query.modality},
                       {DCM_SeriesDescription, query.description},
                       {DCM_SeriesNumber, ""},
                       {DCM_SeriesDate, ""},
                       {DCM_BodyPartExamined, ""},
                       {DCM_NumberOfSeriesRelatedInstances, ""}}};
    return collect<PacsSeries>(server, asked, limits, progress,
                               [&](const FoundAnswer& answer) { return series_of(answer, query.study_uid); });
  });
}

}  // namespace tidemark::imaging
