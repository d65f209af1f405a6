// A connection to a syslog server by TCP or TLS, on which nobody waits longer than is allowed.
#pragma once

#include <chrono>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>

#include "core/result.h"
#include "imaging/audit/configuration.h"

struct ssl_ctx_st;
struct ssl_st;

namespace tidemark::imaging {

// OpenSSL's, with the certificates of a configuration; null: no encryption.
using TlsContext = std::shared_ptr<ssl_ctx_st>;

// TLS 1.2 and later (DICOM PS3.15 A.6); the peer must be `host`. Fails (ErrorKind::input) naming a file of a
// certificate or a key that is not usable.
Result<TlsContext> make_tls_context(const TlsFiles& tls, const std::string& host);

class StreamConnection {
 public:
  // All fail with ErrorKind::input, naming the server, when it takes longer than it may, and with
  // ErrorKind::cancelled soon after a request to stop.
  static Result<std::unique_ptr<StreamConnection>> open(const AuditServer& server, const TlsContext& tls,
                                                        const std::stop_token& stop);
  ~StreamConnection();
  StreamConnection(const StreamConnection&) = delete;
  StreamConnection& operator=(const StreamConnection&) = delete;

  // Returns when the server's machine has confirmed all bytes. After a failure the connection is of no use,
  // and what was not confirmed is not sent later.
  Status send(std::string_view bytes, const std::stop_token& stop);

  // False when the server has hung up.
  [[nodiscard]] bool is_open();

 private:
  using Clock = std::chrono::steady_clock;
  explicit StreamConnection(const AuditServer& server) : server_(server) {}
  Status connect(const std::stop_token& stop);
  Status encrypt(ssl_ctx_st& context, const std::stop_token& stop);
  Status wait(short events, const std::stop_token& stop);
  Status wait_for_confirmation(const std::stop_token& stop);
  // How many bytes went; 0 where `events` have to be waited for first.
  Result<std::size_t> write_some(std::string_view bytes, short& events);
  Status look();  // takes what the server says, and whether it has hung up
  [[nodiscard]] tl::unexpected<Error> broken(const std::string& why);
  [[nodiscard]] tl::unexpected<Error> broken_tls(const char* what, int result);
  void set_deadline();

  const AuditServer server_;
  int socket_ = -1;
  ssl_st* tls_ = nullptr;
  bool is_broken_ = false;
  bool has_hung_up_ = false;
  Clock::time_point deadline_;
};

}  // namespace tidemark::imaging
