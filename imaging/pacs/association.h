// A conversation with a DICOM application: an association of DCMTK's that never waits in vain.
#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"
#include "imaging/pacs/configuration.h"
#include "imaging/web/connection_watch.h"

class DcmDataset;
class DcmTransportLayer;
class OFCondition;
struct T_ASC_Association;
struct T_ASC_Network;
struct T_DIMSE_Message;

namespace tidemark::imaging {

// Before the first use of DCMTK's network in the process: time-outs are ours, names are not asked for, logs
// are off.
Status set_up_network();

// DCMTK's own time-out for calls: so long that the watch ends them first, with a better message.
constexpr int kNetworkSeconds = 86'400;
constexpr long kLongestPdu = 131072;  // the largest that DCMTK takes

// One presentation context of ours.
struct Proposal {
  std::string abstract_syntax;
  std::vector<std::string> transfer_syntaxes;
  bool peer_stores = false;  // the peer is to send us objects of this class (C-GET)
};
constexpr std::size_t kMostProposals = 128;  // an association has no more context numbers

// The most bytes that may come with a command, apart from objects.
constexpr std::int64_t kLongestCommand = std::int64_t{16} << 10;
constexpr std::int64_t kLongestIdentifier = std::int64_t{64} << 10;

class Association {
 public:
  // Calls the server. Fails (ErrorKind::input) naming the server and what went wrong; with `stop`, within a
  // second.
  static Result<std::unique_ptr<Association>> open(const PacsServer& server,
                                                   const std::vector<Proposal>& proposals,
                                                   const std::stop_token& stop);
  // One that the peer called for and that was accepted.
  Association(std::shared_ptr<ConnectionWatch> watch, T_ASC_Association* accepted);
  ~Association();  // aborts an association that was not released
  Association(const Association&) = delete;
  Association& operator=(const Association&) = delete;

  // Ends the association; its outcome does not change earlier results.
  void release();
  void acknowledge_release();

  // The number of an accepted context; 0 when the peer accepted none. Without a transfer syntax any will do.
  [[nodiscard]] int context(const std::string& abstract_syntax,
                            const std::string& transfer_syntax = {}) const;
  [[nodiscard]] std::string transfer_syntax(int context) const;
  [[nodiscard]] std::string abstract_syntax(int context) const;
  [[nodiscard]] std::uint16_t next_message_id();

  // A command and the data that belongs to it, if any.
  Status send(int context, T_DIMSE_Message& message, DcmDataset* data = nullptr);
  // The next command, and the context that it came on. `released` (where one may be expected) says that the
  // peer wants to end instead.
  Result<int> receive(T_DIMSE_Message& message, bool* released = nullptr);
  // The data that belongs to the command just received.
  Result<std::unique_ptr<DcmDataset>> receive_data(std::int64_t longest = kLongestIdentifier);

  // The error for a failure of DCMTK's: the reason why the connection was shut, if it was.
  [[nodiscard]] Error error(const OFCondition& condition, std::string_view doing) const;
  [[nodiscard]] ConnectionWatch& watch() const { return *watch_; }
  [[nodiscard]] const std::shared_ptr<ConnectionWatch>& shared_watch() const { return watch_; }
  [[nodiscard]] T_ASC_Association* get() const { return association_; }

 private:
  explicit Association(std::shared_ptr<ConnectionWatch> watch);
  Status call(const PacsServer& server, const std::string& address, const std::vector<Proposal>& proposals,
              bool& may_try_again);
  Error refusal(const OFCondition& condition, const PacsServer& server) const;

  std::shared_ptr<ConnectionWatch> watch_;
  std::unique_ptr<DcmTransportLayer> transport_;
  T_ASC_Network* network_ = nullptr;
  T_ASC_Association* association_ = nullptr;
  bool ended_ = false;
};

}  // namespace tidemark::imaging
