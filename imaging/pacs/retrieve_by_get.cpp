#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dimse.h>

#include "imaging/pacs/retrieval.h"
#include "imaging/pacs/storage_classes.h"
#include "imaging/pacs/storage_request.h"

namespace tidemark::imaging {
Result<std::int64_t> retrieve_by_get(const PacsServer& server, const RetrieveRequest& request,
                                     const PacsLimits& limits, RetrievalFolder& retrieval_folder,
                                     const std::stop_token& stop) {
  std::vector<Proposal> proposals = storage_proposals();
  const Proposal get{UID_GETStudyRootQueryRetrieveInformationModel,
                     {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax}};
  proposals.insert(proposals.begin(), get);
  auto opened = Association::open(server, proposals, stop);
  if (!opened) return pass_on(opened);
  Association& association = **opened;
  const int context = association.context(get.abstract_syntax);
  if (context == 0) {
    return fail(ErrorKind::input, "{}: does not offer retrieval by get; most servers do so by move",
                association.watch().peer());
  }

  T_DIMSE_Message message{};
  message.CommandField = DIMSE_C_GET_RQ;
  message.msg.CGetRQ.MessageID = association.next_message_id();
  message.msg.CGetRQ.Priority = DIMSE_PRIORITY_MEDIUM;
  message.msg.CGetRQ.DataSetType = DIMSE_DATASET_PRESENT;
  OFStandard::strlcpy(message.msg.CGetRQ.AffectedSOPClassUID, get.abstract_syntax.c_str(), sizeof(DIC_UI));
  const auto identifier = identifier_of(request);
  TIDEMARK_TRY(association.send(context, message, identifier.get()));

  for (ResponseReader responses(association, retrieval_folder);;) {
    message = {};
    const auto received = association.receive(message);
    if (!received) return pass_on(received);
    if (message.CommandField == DIMSE_C_STORE_RQ) {
      Status taken = answer_storage_request(association, *received, message, retrieval_folder, limits);
      if (!taken) return pass_on(taken);
      continue;
    }
    const auto last = responses.read(message);
    if (!last) return pass_on(last);
    if (!*last) continue;
    association.release();
    return responses.missing();
  }
}

}  // namespace tidemark::imaging
