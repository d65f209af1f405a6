#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dimse.h>

#include <algorithm>
#include <set>
#include <utility>

#include "core/without_exceptions.h"
#include "imaging/guard/dicom/transfer_syntaxes.h"
#include "imaging/guard/guarded.h"
#include "imaging/pacs/association.h"
#include "imaging/pacs/outgoing.h"
#include "imaging/pacs/services.h"
#include "imaging/pacs/web/web_services.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

bool is_compressed(const std::string& transfer_syntax) {
  const TransferSyntax* syntax = find_transfer_syntax(transfer_syntax);
  return syntax == nullptr || syntax->is_encapsulated() || syntax->is_deflated;
}

// The encodings that an object may be sent in. Values may be too long for the explicit form of what they are
// (a contour's points), and every server takes the implicit one (PS3.5 10.1).
std::vector<std::string> encodings(const std::string& transfer_syntax) {
  if (is_compressed(transfer_syntax) || transfer_syntax == UID_LittleEndianImplicitTransferSyntax)
    return {transfer_syntax};
  std::vector<std::string> all{UID_LittleEndianExplicitTransferSyntax,
                               UID_LittleEndianImplicitTransferSyntax};
  if (transfer_syntax == UID_BigEndianExplicitTransferSyntax) all.push_back(transfer_syntax);
  return all;
}

// The files that can be sent; the others go to `sent.unsent`.
Result<std::vector<Outgoing>> look_into(const std::vector<fs::path>& files, Sent& sent,
                                        const Progress& progress) {
  std::vector<Outgoing> outgoing;
  for (const fs::path& file : files) {
    if (progress.cancelled()) return cancelled_error();
    auto identity = check_object(file);
    if (identity) {
      outgoing.push_back({file, std::move(*identity)});
    } else {
      sent.unsent.push_back({file, without_path(identity.error().message, file)});
    }
    progress(0.2 * static_cast<double>(&file - files.data() + 1) / static_cast<double>(files.size()),
             "looking at the files");
  }
  return outgoing;
}

Result<std::vector<Proposal>> proposals_for(const std::vector<Outgoing>& outgoing) {
  std::set<std::pair<std::string, std::vector<std::string>>> kinds;
  for (const Outgoing& one : outgoing)
    kinds.emplace(one.identity.sop_class, encodings(one.identity.transfer_syntax));
  if (kinds.size() > kMostProposals) {
    return fail(ErrorKind::usage, "{} kinds of objects at once, more than {} cannot be agreed on",
                kinds.size(), kMostProposals);
  }
  std::vector<Proposal> proposals;
  for (const auto& [sop_class, syntaxes] : kinds) proposals.push_back({sop_class, syntaxes});
  return proposals;
}

int context_for(const Association& association, const ObjectIdentity& identity) {
  for (const std::string& syntax : encodings(identity.transfer_syntax)) {
    if (const int context = association.context(identity.sop_class, syntax); context != 0) return context;
  }
  return 0;
}

// The server's status; 0 is success. Fails where the conversation cannot go on.
Result<std::uint16_t> send_object(Association& association, int context, const ObjectIdentity& identity,
                                  DcmDataset& object) {
  T_DIMSE_Message message{};
  message.CommandField = DIMSE_C_STORE_RQ;
  T_DIMSE_C_StoreRQ& request = message.msg.CStoreRQ;
  request.MessageID = association.next_message_id();
  request.Priority = DIMSE_PRIORITY_MEDIUM;
  request.DataSetType = DIMSE_DATASET_PRESENT;
  OFStandard::strlcpy(request.AffectedSOPClassUID, identity.sop_class.c_str(), sizeof(DIC_UI));
  OFStandard::strlcpy(request.AffectedSOPInstanceUID, identity.sop_instance.c_str(), sizeof(DIC_UI));
  const auto id = request.MessageID;
  TIDEMARK_TRY(association.send(context, message, &object));
  message = {};
  const auto answered = association.receive(message);
  if (!answered) return pass_on(answered);
  if (message.CommandField != DIMSE_C_STORE_RSP || message.msg.CStoreRSP.MessageIDBeingRespondedTo != id) {
    return fail(ErrorKind::input, "{}: answers something that was not asked", association.watch().peer());
  }
  association.watch().completed_message();
  return message.msg.CStoreRSP.DimseStatus;
}

class DicomSender final : public ObjectSender {
 public:
  explicit DicomSender(std::unique_ptr<Association> association) : association_(std::move(association)) {}

  Result<std::string> send(const Outgoing& one, const CheckedObject& object) override {
    const std::string& syntax = one.identity.transfer_syntax;
    const int context = context_for(*association_, one.identity);
    if (context == 0) {
      const char* name = dcmFindNameOfUID(syntax.c_str());
      return fmt::format("the server does not take it as it is encoded ({})",
                         name != nullptr ? name : syntax.c_str());
    }
    const auto status = send_object(*association_, context, one.identity, object.parsed.dataset());
    if (!status) return pass_on(status);
    if (*status == STATUS_Success || DICOM_WARNING_STATUS(*status)) return std::string();
    return fmt::format("the server refuses it (status {:04X})", *status);
  }
  void end() override { association_->release(); }

 private:
  std::unique_ptr<Association> association_;
};

Result<std::unique_ptr<ObjectSender>> open_dicom_sender(const PacsServer& server,
                                                        const std::vector<Outgoing>& outgoing,
                                                        const std::stop_token& stop) {
  const auto proposals = proposals_for(outgoing);
  if (!proposals) return pass_on(proposals);
  auto opened = Association::open(server, *proposals, stop);
  if (!opened) return pass_on(opened);
  return std::make_unique<DicomSender>(std::move(*opened));
}

// The reason why the object was not sent; empty when it was, and `bytes` has grown by its file's. Fails where
// the conversation cannot go on.
Result<std::string> send_one(ObjectSender& sender, const Outgoing& one, std::int64_t& bytes) {
  // Of many files not all can stay open since they were looked into.
  const auto object = load_checked_object(one.file);
  if (!object) return without_path(object.error().message, one.file);
  if (object->identity != one.identity) return std::string("it is not what it was a moment ago");
  auto reason = sender.send(one, *object);
  if (reason && reason->empty()) bytes += object->parsed.bytes().size();
  return reason;
}

// Sends one after the other, and notes in `went` which the server has taken.
Status send_outgoing(const PacsServer& server, const std::vector<Outgoing>& outgoing, Sent& sent,
                     std::vector<bool>& went, const Progress& progress) {
  const auto sender = server.web ? open_web_sender(server, progress.stop)
                                 : open_dicom_sender(server, outgoing, progress.stop);
  if (!sender) return pass_on(sender);
  for (std::size_t i = 0; i < outgoing.size(); ++i) {
    if (progress.cancelled()) return cancelled_error();
    auto reason = send_one(**sender, outgoing[i], sent.bytes);
    if (!reason) return pass_on(reason);
    went[i] = reason->empty();
    if (went[i]) {
      ++sent.objects;
    } else {
      sent.unsent.push_back({outgoing[i].file, std::move(*reason)});
    }
    progress(0.2 + 0.8 * static_cast<double>(i + 1) / static_cast<double>(outgoing.size()),
             "sending objects");
  }
  (*sender)->end();
  return {};
}

// What went, and what did not: each by itself, as DICOM PS3.15 A.5.2 wants it.
void audit(const PacsServer& server, const std::vector<Outgoing>& outgoing, const Sent& sent,
           const std::vector<bool>& went, const Status& done) {
  std::vector<AuditedStudy> gone, kept;
  for (std::size_t i = 0; i < outgoing.size(); ++i) {
    add_study(went[i] ? gone : kept, outgoing[i].identity.audited);
  }
  AuditEvent event{.kind = AuditEvent::Kind::sent, .peer = audited_peer(server)};
  record_audit(event, gone);
  event.failure = !done ? done.error().message : sent.unsent.empty() ? "" : sent.unsent.back().reason;
  record_audit(event, kept);
}

Result<Sent> send_all(const PacsServer& server, const std::vector<fs::path>& files,
                      const Progress& progress) {
  TIDEMARK_TRY(set_up_network());
  Sent sent;
  const auto outgoing = look_into(files, sent, progress);
  if (!outgoing) return pass_on(outgoing);
  if (outgoing->empty()) return sent;
  std::vector<bool> went(outgoing->size());
  const Status done = send_outgoing(server, *outgoing, sent, went, progress);
  audit(server, *outgoing, sent, went, done);
  if (!done) return pass_on(done);
  return sent;
}

}  // namespace

Result<Sent> send_files(const PacsServer& server, const std::vector<fs::path>& files,
                        const Progress& progress) {
  return without_exceptions([&] { return send_all(server, files, progress); });
}

}  // namespace tidemark::imaging
