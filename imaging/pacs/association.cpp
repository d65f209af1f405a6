#include "imaging/pacs/association.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dcmtrans.h>
#include <dcmtk/dcmnet/dimse.h>

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/progress.h"
#include "core/stopwatch.h"
#include "imaging/dicom/dicom_setup.h"
#include "imaging/pacs/transport.h"
#include "imaging/web/name_resolution.h"

namespace tidemark::imaging {
namespace {

constexpr std::int64_t kLongestHandshake = std::int64_t{1} << 20;
// One attempt to connect: it cannot be interrupted, so it is short and repeated.
constexpr int kConnectSeconds = 1;
constexpr std::chrono::seconds kGoodbyePatience(3);

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return text.substr(0, 300);
}

OFCondition propose(T_ASC_Parameters* parameters, const std::vector<Proposal>& proposals) {
  int number = 1;
  for (const Proposal& proposal : proposals) {
    std::vector<const char*> syntaxes;
    for (const std::string& syntax : proposal.transfer_syntaxes) syntaxes.push_back(syntax.c_str());
    const OFCondition added = ASC_addPresentationContext(
        parameters, static_cast<T_ASC_PresentationContextID>(number), proposal.abstract_syntax.c_str(),
        syntaxes.data(), static_cast<int>(syntaxes.size()),
        proposal.peer_stores ? ASC_SC_ROLE_SCP : ASC_SC_ROLE_DEFAULT);
    if (added.bad()) return added;
    number += 2;  // contexts have odd numbers
  }
  return EC_Normal;
}

}  // namespace

Status set_up_network() {
  TIDEMARK_TRY(set_up_dicom());
  static std::once_flag once;
  std::call_once(once, [] {
    dcmConnectionTimeout.set(kConnectSeconds);
    dcmDisableGethostbyaddr.set(OFTrue);  // it may take long, and the name is not needed
    // The watches are in charge of these.
    dcmSocketReceiveTimeout.set(0);
    dcmSocketSendTimeout.set(0);
  });
  return {};
}

Association::Association(std::shared_ptr<ConnectionWatch> watch) : watch_(std::move(watch)) {}

Association::Association(std::shared_ptr<ConnectionWatch> watch, T_ASC_Association* accepted)
    : watch_(std::move(watch)), association_(accepted) {}

Association::~Association() {
  if (association_ != nullptr) {
    if (!ended_) ASC_abortAssociation(association_);
    ASC_destroyAssociation(&association_);
  }
  if (network_ != nullptr) ASC_dropNetwork(&network_);
}

Result<std::unique_ptr<Association>> Association::open(const PacsServer& server,
                                                       const std::vector<Proposal>& proposals,
                                                       const std::stop_token& stop) {
  TIDEMARK_TRY(check_pacs_server(server));
  TIDEMARK_TRY(set_up_network());
  const std::string peer = fmt::format("PACS {} ({})", server.name, server.address());
  const std::chrono::seconds patience(server.timeout_seconds);
  const auto address = resolve_host(server.host, patience, stop);
  if (!address && address.error().kind == ErrorKind::cancelled) return pass_on(address);
  if (!address) return fail(ErrorKind::input, "{}: {}", peer, address.error().message);

  for (const Stopwatch stopwatch;;) {
    std::unique_ptr<Association> association(
        new Association(std::make_shared<ConnectionWatch>(peer, patience, stop)));
    bool may_try_again = false;
    const Status called = association->call(server, *address, proposals, may_try_again);
    if (called) return association;
    if (stop.stop_requested()) return cancelled_error();
    if (!may_try_again) return pass_on(called);
    if (stopwatch.seconds() > server.timeout_seconds) {
      return fail(ErrorKind::input, "{}: does not answer: no connection in {} s", peer,
                  server.timeout_seconds);
    }
  }
}

Status Association::call(const PacsServer& server, const std::string& address,
                         const std::vector<Proposal>& proposals, bool& may_try_again) {
  bool connected = false;
  auto transport = make_transport(server.tls, TransportRole::caller, server.host, [this, &connected] {
    connected = true;
    return watch_;
  });
  if (!transport) return pass_on(transport);
  transport_ = std::move(*transport);
  OFCondition made = ASC_initializeNetwork(NET_REQUESTOR, 0, kNetworkSeconds, &network_);
  if (made.good()) made = ASC_setTransportLayer(network_, transport_.get(), 0);
  T_ASC_Parameters* parameters = nullptr;
  if (made.good()) made = ASC_createAssociationParameters(&parameters, kLongestPdu);
  if (made.good()) {
    ASC_setAPTitles(parameters, server.own_ae_title.c_str(), server.ae_title.c_str(), nullptr);
    ASC_setTransportLayerType(parameters, server.tls.has_value());
    const std::string where = fmt::format("{}:{}", address, server.port);
    made = ASC_setPresentationAddresses(parameters, "localhost", where.c_str());
  }
  if (made.good()) made = propose(parameters, proposals);
  if (made.bad()) {
    if (parameters != nullptr) ASC_destroyAssociationParameters(&parameters);
    return fail(ErrorKind::internal, "{}: {}", watch_->peer(), one_line(made.text()));
  }

  watch_->allow(kLongestHandshake, "an answer to the call");
  const Stopwatch stopwatch;
  const OFCondition called = ASC_requestAssociation(network_, parameters, &association_);
  if (called.good() && ASC_countAcceptedPresentationContexts(association_->params) > 0) {
    watch_->completed_message();
    return {};
  }
  ended_ = called.bad();  // nobody is left to receive an abort
  may_try_again = called.bad() && !connected && stopwatch.seconds() >= 0.9 * kConnectSeconds;
  return tl::unexpected<Error>(refusal(called, server));
}

Error Association::refusal(const OFCondition& condition, const PacsServer& server) const {
  if (condition.good()) {
    return {ErrorKind::input, fmt::format("{}: offers nothing of what is asked for", watch_->peer())};
  }
  if (condition != DUL_ASSOCIATIONREJECTED) return error(condition, "cannot be called");
  T_ASC_RejectParameters rejected{};
  ASC_getRejectParameters(association_->params, &rejected);
  std::string why = "refuses the call";
  if (rejected.reason == ASC_REASON_SU_CALLEDAETITLENOTRECOGNIZED) {
    why += fmt::format(": it is not called '{}' (ae_title)", server.ae_title);
  } else if (rejected.reason == ASC_REASON_SU_CALLINGAETITLENOTRECOGNIZED) {
    why += fmt::format(": it does not know us as '{}' (own_ae_title)", server.own_ae_title);
  } else if (rejected.result == ASC_RESULT_REJECTEDTRANSIENT) {
    why += " for now";
  }
  return {ErrorKind::input, fmt::format("{}: {}", watch_->peer(), why)};
}

void Association::release() {
  if (std::exchange(ended_, true)) return;
  watch_->allow(kLongestCommand, "an answer to the goodbye");
  watch_->set_patience(kGoodbyePatience);
  ASC_releaseAssociation(association_);
}

void Association::acknowledge_release() {
  if (std::exchange(ended_, true)) return;
  ASC_acknowledgeRelease(association_);
}

int Association::context(const std::string& abstract_syntax, const std::string& transfer_syntax) const {
  if (transfer_syntax.empty()) {
    return ASC_findAcceptedPresentationContextID(association_, abstract_syntax.c_str());
  }
  // Where there is none of that transfer syntax, DCMTK gives one of another.
  const int found =
      ASC_findAcceptedPresentationContextID(association_, abstract_syntax.c_str(), transfer_syntax.c_str());
  return this->transfer_syntax(found) == transfer_syntax ? found : 0;
}

std::string Association::transfer_syntax(int context) const {
  T_ASC_PresentationContext found{};
  const auto number = static_cast<T_ASC_PresentationContextID>(context);
  if (ASC_findAcceptedPresentationContext(association_->params, number, &found).bad()) return {};
  return found.acceptedTransferSyntax;
}

std::string Association::abstract_syntax(int context) const {
  T_ASC_PresentationContext found{};
  const auto number = static_cast<T_ASC_PresentationContextID>(context);
  if (ASC_findAcceptedPresentationContext(association_->params, number, &found).bad()) return {};
  return found.abstractSyntax;
}

std::uint16_t Association::next_message_id() {
  return association_->nextMsgID++;
}

Status Association::send(int context, T_DIMSE_Message& message, DcmDataset* data) {
  const OFCondition sent =
      DIMSE_sendMessageUsingMemoryData(association_, static_cast<T_ASC_PresentationContextID>(context),
                                       &message, nullptr, data, nullptr, nullptr);
  if (sent.bad()) return tl::unexpected<Error>(error(sent, "takes no message"));
  watch_->completed_message();
  return {};
}

Result<int> Association::receive(T_DIMSE_Message& message, bool* released) {
  watch_->allow(kLongestCommand, "a command");
  T_ASC_PresentationContextID context = 0;
  const OFCondition got = DIMSE_receiveCommand(association_, DIMSE_BLOCKING, 0, &context, &message, nullptr);
  if (released != nullptr && got == DUL_PEERREQUESTEDRELEASE) {
    *released = true;
    return 0;
  }
  if (got.bad()) return tl::unexpected<Error>(error(got, "breaks off"));
  return context;
}

Result<std::unique_ptr<DcmDataset>> Association::receive_data(std::int64_t longest) {
  watch_->allow(longest, "the data of a command");
  T_ASC_PresentationContextID context = 0;
  DcmDataset* data = nullptr;
  const OFCondition got =
      DIMSE_receiveDataSetInMemory(association_, DIMSE_BLOCKING, 0, &context, &data, nullptr, nullptr);
  std::unique_ptr<DcmDataset> owner(data);
  if (got.bad()) return tl::unexpected<Error>(error(got, "breaks off"));
  return owner;
}

Error Association::error(const OFCondition& condition, std::string_view doing) const {
  if (const Status trouble = watch_->trouble(); !trouble) return trouble.error();
  std::string why = one_line(condition.text());
  if (const std::string prefix = "TCP Initialization Error: "; why.starts_with(prefix))
    why.erase(0, prefix.size());
  if (condition == DUL_PEERREQUESTEDRELEASE) why = "it hangs up before it has answered";
  if (condition == DUL_PEERABORTEDASSOCIATION) why = "it aborts the conversation";
  return {ErrorKind::input, fmt::format("{}: {}: {}", watch_->peer(), doing, why)};
}

}  // namespace tidemark::imaging
