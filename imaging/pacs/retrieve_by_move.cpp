#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dimse.h>

#include <unistd.h>

#include "core/file_lock.h"
#include "imaging/pacs/receiver.h"
#include "imaging/pacs/retrieval.h"

namespace tidemark::imaging {
namespace {

Result<std::int64_t> move(Association& association, const Proposal& proposal, const PacsServer& server,
                          const RetrieveRequest& request, RetrievalFolder& retrieval_folder,
                          Receiver& receiver) {
  T_DIMSE_Message message{};
  message.CommandField = DIMSE_C_MOVE_RQ;
  T_DIMSE_C_MoveRQ& asked = message.msg.CMoveRQ;
  asked.MessageID = association.next_message_id();
  asked.Priority = DIMSE_PRIORITY_MEDIUM;
  asked.DataSetType = DIMSE_DATASET_PRESENT;
  OFStandard::strlcpy(asked.AffectedSOPClassUID, proposal.abstract_syntax.c_str(), sizeof(DIC_UI));
  OFStandard::strlcpy(asked.MoveDestination, server.own_ae_title.c_str(), sizeof(DIC_AE));
  const auto identifier = identifier_of(request);
  const int context = association.context(proposal.abstract_syntax);
  TIDEMARK_TRY(association.send(context, message, identifier.get()));

  for (ResponseReader responses(association, retrieval_folder);;) {
    message = {};
    const auto received = association.receive(message);
    TIDEMARK_TRY(receiver.trouble());
    if (!received) return pass_on(received);
    const auto last = responses.read(message);
    if (!last) return pass_on(last);
    if (!*last) continue;
    association.release();
    return responses.missing();
  }
}

// A port has one listener: the programs of a user wait for each other. TMPDIR may differ among them.
FileLock lock_port(int port, const std::stop_token& stop) {
  const std::string file = fmt::format("/tmp/tidemark-port-{}-of-{}", port, ::geteuid());
  return FileLock::wait(file, FileLock::Missing::make, stop);
}

}  // namespace

Result<std::int64_t> retrieve_by_move(const PacsServer& server, const RetrieveRequest& request,
                                      const PacsLimits& limits, RetrievalFolder& retrieval_folder,
                                      const std::stop_token& stop) {
  const FileLock port = lock_port(server.move_port, stop);
  auto receiver = Receiver::start(server, retrieval_folder, limits);
  if (!receiver) return pass_on(receiver);
  const Proposal proposal{UID_MOVEStudyRootQueryRetrieveInformationModel,
                          {UID_LittleEndianExplicitTransferSyntax, UID_LittleEndianImplicitTransferSyntax}};
  auto opened = Association::open(server, {proposal}, stop);
  if (!opened) return pass_on(opened);
  retrieval_folder.excuse((*opened)->shared_watch());
  return move(**opened, proposal, server, request, retrieval_folder, **receiver);
}

}  // namespace tidemark::imaging
