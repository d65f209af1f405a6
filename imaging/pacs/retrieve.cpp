#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dimse.h>

#include <optional>

#include "core/without_exceptions.h"
#include "imaging/pacs/retrieval.h"
#include "imaging/pacs/services.h"
#include "imaging/pacs/storage_classes.h"
#include "imaging/pacs/web/web_services.h"

namespace tidemark::imaging {
namespace {

// The UIDs of all objects that failed may come along.
constexpr std::int64_t kLongestResponseData = std::int64_t{2} << 20;
// A server reports its progress at most once an object, of which it can count 65,535.
constexpr std::int64_t kMostResponses = 100'000;

struct Response {
  std::uint16_t status = 0;
  bool has_data = false;
  SubOperations counted;
};

template <class Said>
Response response_of(const Said& said) {
  return {said.DimseStatus,
          said.DataSetType != DIMSE_DATASET_NULL,
          {said.NumberOfRemainingSubOperations, said.NumberOfCompletedSubOperations,
           said.NumberOfFailedSubOperations, said.NumberOfWarningSubOperations}};
}

std::optional<Response> response_in(const T_DIMSE_Message& message) {
  if (message.CommandField == DIMSE_C_GET_RSP) return response_of(message.msg.CGetRSP);
  if (message.CommandField == DIMSE_C_MOVE_RSP) return response_of(message.msg.CMoveRSP);
  return std::nullopt;
}

Result<Retrieved> retrieve_into_folder(const PacsServer& server, const RetrieveRequest& request,
                                       const PacsLimits& limits, const Progress& progress) {
  if (!is_uid(request.study_uid))
    return fail(ErrorKind::usage, "'{}' is no UID of a study", request.study_uid.substr(0, 80));
  if (!request.series_uid.empty() && !is_uid(request.series_uid))
    return fail(ErrorKind::usage, "'{}' is no UID of a series", request.series_uid.substr(0, 80));
  TIDEMARK_TRY(check_pacs_server(server));
  auto retrieval_folder = RetrievalFolder::create(request, limits, progress);
  if (!retrieval_folder) return pass_on(retrieval_folder);
  progress(-1.0, "calling the server");
  const auto way = server.web                                     ? retrieve_by_web
                   : server.retrieve == PacsServer::Retrieve::get ? retrieve_by_get
                                                                  : retrieve_by_move;
  const auto missing = way(server, request, limits, **retrieval_folder, progress.stop);
  if (progress.cancelled()) return cancelled_error();
  if (!missing) return pass_on(missing);
  return (*retrieval_folder)->keep(*missing);
}

// What came, and what did not: each by itself, as DICOM PS3.15 A.5.2 wants it.
void audit(const PacsServer& server, const RetrieveRequest& request, const Result<Retrieved>& retrieved) {
  AuditEvent event{.kind = AuditEvent::Kind::received, .peer = audited_peer(server)};
  if (!retrieved && retrieved.error().kind == ErrorKind::usage) return;  // nobody was asked
  if (retrieved) {
    record_audit(event, retrieved->studies);
    if (retrieved->missing == 0 && retrieved->refused.empty()) return;
  }
  event.failure = retrieved ? fmt::format("{} objects could not be sent by the server, {} were not taken",
                                          retrieved->missing, retrieved->refused.size())
                            : retrieved.error().message;
  event.study.study_uid = request.study_uid;
  record_audit(event);
}

}  // namespace

std::unique_ptr<DcmDataset> identifier_of(const RetrieveRequest& request) {
  auto identifier = std::make_unique<DcmDataset>();
  identifier->putAndInsertString(DCM_QueryRetrieveLevel, request.series_uid.empty() ? "STUDY" : "SERIES");
  identifier->putAndInsertString(DCM_StudyInstanceUID, request.study_uid.c_str());
  if (!request.series_uid.empty())
    identifier->putAndInsertString(DCM_SeriesInstanceUID, request.series_uid.c_str());
  return identifier;
}

Result<bool> ResponseReader::read(const T_DIMSE_Message& message) {
  const auto response = response_in(message);
  if (!response) {
    return fail(ErrorKind::input, "{}: answers something that was not asked", association_.watch().peer());
  }
  if (++read_ > kMostResponses) {
    return fail(ErrorKind::input, "{}: answers without end", association_.watch().peer());
  }
  if (response->has_data) {
    auto data = association_.receive_data(kLongestResponseData);
    if (!data) return pass_on(data);
  }
  const std::uint16_t status = response->status;
  if (response->counted != counted_) association_.watch().completed_message();
  if (response->counted.total() > 0) {  // the last response need not say it
    counted_ = response->counted;
    retrieval_folder_.set_expected(counted_.total());
  }
  if (DICOM_PENDING_STATUS(status)) return false;
  missing_ = counted_.failed;
  if (status == STATUS_Success || DICOM_WARNING_STATUS(status)) return true;
  // Some servers report a failure when one object of many has failed, and give up the rest.
  missing_ += counted_.remaining;
  if (counted_.completed + counted_.warned > 0 &&
      status != STATUS_GET_Cancel_SubOperationsTerminatedDueToCancelIndication)
    return true;
  if (status == STATUS_MOVE_Failed_MoveDestinationUnknown) {
    return fail(ErrorKind::input,
                "{}: does not know where to send to: our AE title with host and port must be "
                "entered there",
                association_.watch().peer());
  }
  return fail(ErrorKind::input, "{}: cannot send the requested objects (status {:04X})",
              association_.watch().peer(), status);
}

Result<Retrieved> retrieve(const PacsServer& server, const RetrieveRequest& request, const PacsLimits& limits,
                           const Progress& progress) {
  auto retrieved =
      without_exceptions([&] { return retrieve_into_folder(server, request, limits, progress); });
  audit(server, request, retrieved);
  return retrieved;
}

}  // namespace tidemark::imaging
