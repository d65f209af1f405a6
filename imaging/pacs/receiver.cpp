#include "imaging/pacs/receiver.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dimse.h>

#include <algorithm>
#include <array>
#include <utility>

#include "core/without_exceptions.h"
#include "imaging/pacs/storage_classes.h"
#include "imaging/pacs/storage_request.h"
#include "imaging/pacs/transport.h"

namespace tidemark::imaging {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t kLongestCall = std::int64_t{1} << 20;
constexpr std::size_t kMostConversations = 4;
// A silent caller keeps others waiting, so it has less time at first than later on.
constexpr std::chrono::milliseconds kGreetingPatience = 5s;

Status answer_echo(Association& association, int context, const T_DIMSE_Message& request) {
  T_DIMSE_Message message{};
  message.CommandField = DIMSE_C_ECHO_RSP;
  T_DIMSE_C_EchoRSP& response = message.msg.CEchoRSP;
  response.MessageIDBeingRespondedTo = request.msg.CEchoRQ.MessageID;
  response.DimseStatus = STATUS_Success;
  response.DataSetType = DIMSE_DATASET_NULL;
  response.opts = O_ECHO_AFFECTEDSOPCLASSUID;
  OFStandard::strlcpy(response.AffectedSOPClassUID, UID_VerificationSOPClass, sizeof(DIC_UI));
  return association.send(context, message);
}

std::vector<const char*> c_texts(const std::vector<std::string>& texts) {
  std::vector<const char*> result;
  for (const std::string& text : texts) result.push_back(text.c_str());
  return result;
}

}  // namespace

Result<std::unique_ptr<Receiver>> Receiver::start(const PacsServer& server, RetrievalFolder& retrieval_folder,
                                                  const PacsLimits& limits) {
  TIDEMARK_TRY(set_up_network());
  std::unique_ptr<Receiver> receiver(new Receiver(server, retrieval_folder, limits));
  auto transport = make_transport(server.tls, TransportRole::called, server.host,
                                  [self = receiver.get()] { return self->next_watch_; });
  if (!transport) return pass_on(transport);
  receiver->transport_ = std::move(*transport);
  const OFCondition listening =
      ASC_initializeNetwork(NET_ACCEPTOR, server.move_port, kNetworkSeconds, &receiver->network_);
  if (listening.bad()) {
    return fail(ErrorKind::capability, "port {} of this machine cannot be listened on: {}", server.move_port,
                listening.text());
  }
  ASC_setTransportLayer(receiver->network_, receiver->transport_.get(), 0);
  receiver->listener_ =
      std::jthread([self = receiver.get()](const std::stop_token& quit) { self->listen(quit); });
  return receiver;
}

Receiver::Receiver(const PacsServer& server, RetrievalFolder& retrieval_folder, const PacsLimits& limits)
    : server_(server), retrieval_folder_(retrieval_folder), limits_(limits) {}

Receiver::~Receiver() {
  stop_.request_stop();
  if (listener_.joinable()) {
    listener_.request_stop();
    listener_.join();
  }
  conversations_.clear();
  if (network_ != nullptr) ASC_dropNetwork(&network_);
}

void Receiver::listen(const std::stop_token& quit) {
  while (!quit.stop_requested()) {
    std::erase_if(conversations_, [](const Conversation& one) { return one.ended->load(); });
    if (conversations_.size() >= kMostConversations) {
      std::this_thread::sleep_for(50ms);
      continue;
    }
    const Status accepted = without_exceptions([&]() -> Status {
      accept(quit);
      return {};
    });
    if (!accepted) return note(accepted.error());
  }
}

void Receiver::accept(const std::stop_token& quit) {
  if (!ASC_associationWaiting(network_, 0)) {
    std::this_thread::sleep_for(20ms);
    return;
  }
  const std::chrono::milliseconds patience = std::chrono::seconds(server_.timeout_seconds);
  const auto watch =
      std::make_shared<ConnectionWatch>(fmt::format("the caller on port {}", server_.move_port),
                                        std::min(patience, kGreetingPatience), stop_.get_token());
  watch->allow(kLongestCall, "a call");
  next_watch_ = watch;
  T_ASC_Association* called = nullptr;
  const OFCondition received =
      ASC_receiveAssociation(network_, &called, kLongestPdu, nullptr, nullptr, server_.tls.has_value());
  if (called == nullptr) return;
  auto association = std::make_unique<Association>(watch, called);
  if (received.bad() || quit.stop_requested() || !greet(*called)) return;
  watch->set_patience(patience);
  watch->completed_message();
  auto ended = std::make_shared<std::atomic<bool>>(false);
  std::jthread thread([this, ended, taken = std::move(association)]() mutable {
    const Status conversed = without_exceptions([&] { return converse(*taken); });
    if (!conversed) note(conversed.error());
    taken.reset();
    ended->store(true);
  });
  conversations_.push_back({ended, std::move(thread)});
}

Status Receiver::greet(T_ASC_Association& association) const {
  std::array<char, 17> caller{};
  std::array<char, 17> called{};
  ASC_getAPTitles(association.params, caller.data(), caller.size(), called.data(), called.size(), nullptr, 0);
  if (server_.own_ae_title != called.data()) {
    const T_ASC_RejectParameters why{ASC_RESULT_REJECTEDPERMANENT, ASC_SOURCE_SERVICEUSER,
                                     ASC_REASON_SU_CALLEDAETITLENOTRECOGNIZED};
    ASC_rejectAssociation(&association, &why);
    return fail(ErrorKind::input, "a call to another");
  }
  std::vector<const char*> classes = c_texts(storage_classes());
  classes.push_back(UID_VerificationSOPClass);
  std::vector<const char*> syntaxes = c_texts(storage_syntaxes());
  const OFCondition agreed = ASC_acceptContextsWithPreferredTransferSyntaxes(
      association.params, classes.data(), static_cast<int>(classes.size()), syntaxes.data(),
      static_cast<int>(syntaxes.size()));
  if (agreed.bad() || ASC_acknowledgeAssociation(&association).bad()) {
    return fail(ErrorKind::input, "a call that cannot be answered");
  }
  return {};
}

Status Receiver::converse(Association& association) {
  for (;;) {
    T_DIMSE_Message request{};
    bool released = false;
    const auto context = association.receive(request, &released);
    if (released) {
      association.acknowledge_release();
      return {};
    }
    // A caller that breaks off between objects does no harm: the server itself reports missing objects.
    if (!context) return {};
    Status answered;
    if (request.CommandField == DIMSE_C_STORE_RQ) {
      answered = answer_storage_request(association, *context, request, retrieval_folder_, limits_);
    } else if (request.CommandField == DIMSE_C_ECHO_RQ) {
      answered = answer_echo(association, *context, request);
    } else {
      return {};
    }
    if (!answered) return answered;
  }
}

void Receiver::note(const Error& error) {
  const std::lock_guard lock(mutex_);
  if (!trouble_ && !stop_.stop_requested()) trouble_ = error;
}

Status Receiver::trouble() {
  const std::lock_guard lock(mutex_);
  if (trouble_) return tl::unexpected<Error>(*trouble_);
  return {};
}

}  // namespace tidemark::imaging
