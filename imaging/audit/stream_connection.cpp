#include "imaging/audit/stream_connection.h"

#include <arpa/inet.h>
#include <linux/sockios.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/err.h>
#include <openssl/ssl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <thread>

#include "core/progress.h"
#include "imaging/web/name_resolution.h"

namespace tidemark::imaging {
namespace {

constexpr int kSliceMs = 50;  // of waiting, between looks at the request to stop

bool is_number(const std::string& host) {
  return host.find_first_not_of("0123456789.") == std::string::npos;
}

}  // namespace

Result<std::unique_ptr<StreamConnection>> StreamConnection::open(const AuditServer& server,
                                                                 const TlsContext& tls,
                                                                 const std::stop_token& stop) {
  std::unique_ptr<StreamConnection> connection(new StreamConnection(server));
  connection->set_deadline();
  TIDEMARK_TRY(connection->connect(stop));
  if (tls) TIDEMARK_TRY(connection->encrypt(*tls, stop));
  return connection;
}

StreamConnection::~StreamConnection() {
  if (socket_ < 0) return;
  if (is_broken_) {
    // What the server has not confirmed must not come later: it is sent again.
    const linger none{1, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &none, sizeof none);
  } else if (tls_ != nullptr) {
    SSL_shutdown(tls_);
  }
  SSL_free(tls_);
  ::close(socket_);
}

void StreamConnection::set_deadline() {
  deadline_ = Clock::now() + std::chrono::seconds(server_.timeout_seconds);
}

tl::unexpected<Error> StreamConnection::broken(const std::string& why) {
  is_broken_ = true;
  return fail(ErrorKind::input, "audit server {}: {}", server_.address(), why);
}

tl::unexpected<Error> StreamConnection::broken_tls(const char* what, int result) {
  const int kind = SSL_get_error(tls_, result);
  const long verdict = SSL_get_verify_result(tls_);
  const char* reason = ERR_reason_error_string(ERR_get_error());
  ERR_clear_error();
  if (verdict != X509_V_OK)
    return broken(
        fmt::format("its certificate is not to be trusted: {}", X509_verify_cert_error_string(verdict)));
  if (kind == SSL_ERROR_SYSCALL) return broken(fmt::format("{}: {}", what, std::strerror(errno)));
  return broken(fmt::format("{}: {}", what, reason != nullptr ? reason : "it hangs up"));
}

Status StreamConnection::wait(short events, const std::stop_token& stop) {
  for (;;) {
    if (stop.stop_requested()) {
      is_broken_ = true;
      return cancelled_error();
    }
    pollfd waited{socket_, events, 0};
    const int ready = ::poll(&waited, 1, kSliceMs);
    if (ready > 0 || (ready < 0 && errno != EINTR)) return {};  // the next call says what is wrong
    if (Clock::now() >= deadline_)
      return broken(fmt::format("does not answer within {} s", server_.timeout_seconds));
  }
}

Status StreamConnection::connect(const std::stop_token& stop) {
  const auto address = resolve_host(server_.host, std::chrono::seconds(server_.timeout_seconds), stop);
  if (!address) return pass_on(address);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(server_.port));
  ::inet_pton(AF_INET, address->c_str(), &to.sin_addr);
  socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  int error = 0;
  if (::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) error = errno;
  if (error == EINPROGRESS) {
    TIDEMARK_TRY(wait(POLLOUT, stop));
    socklen_t size = sizeof error;
    ::getsockopt(socket_, SOL_SOCKET, SO_ERROR, &error, &size);
  }
  if (error != 0) return broken(fmt::format("cannot be called: {}", std::strerror(error)));
  const int on = 1;
  ::setsockopt(socket_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return {};
}

Status StreamConnection::encrypt(ssl_ctx_st& context, const std::stop_token& stop) {
  tls_ = SSL_new(&context);
  if (tls_ == nullptr) return broken("no encrypted conversation comes about");
  SSL_set_fd(tls_, socket_);
  if (!is_number(server_.host)) SSL_set_tlsext_host_name(tls_, server_.host.c_str());
  for (;;) {
    ERR_clear_error();
    const int result = SSL_connect(tls_);
    if (result == 1) break;
    const int kind = SSL_get_error(tls_, result);
    if (kind != SSL_ERROR_WANT_READ && kind != SSL_ERROR_WANT_WRITE) {
      return broken_tls("no encrypted conversation comes about", result);
    }
    TIDEMARK_TRY(wait(kind == SSL_ERROR_WANT_READ ? POLLIN : POLLOUT, stop));
  }
  if (SSL_CTX_get0_certificate(&context) == nullptr) return {};
  // By TLS 1.3 a server judges our certificate only now. Those that take it say something, most of them.
  constexpr int kJudgementMs = 200;
  pollfd waited{socket_, POLLIN, 0};
  ::poll(&waited, 1, kJudgementMs);
  return look();
}

Status StreamConnection::look() {
  std::array<char, 512> room{};
  for (;;) {
    ERR_clear_error();
    const auto got = tls_ != nullptr
                         ? static_cast<ssize_t>(SSL_read(tls_, room.data(), static_cast<int>(room.size())))
                         : ::recv(socket_, room.data(), room.size(), 0);
    if (got > 0) continue;  // nothing that it could say means anything
    if (tls_ != nullptr) {
      const int kind = SSL_get_error(tls_, static_cast<int>(got));
      if (kind == SSL_ERROR_WANT_READ || kind == SSL_ERROR_WANT_WRITE) return {};
      if (kind != SSL_ERROR_ZERO_RETURN) return broken_tls("breaks off", static_cast<int>(got));
    } else if (got < 0) {
      if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return {};
      return broken(fmt::format("breaks off: {}", std::strerror(errno)));
    }
    has_hung_up_ = true;
    return {};
  }
}

bool StreamConnection::is_open() {
  return look().has_value() && !has_hung_up_;
}

Result<std::size_t> StreamConnection::write_some(std::string_view bytes, short& events) {
  events = POLLOUT;
  if (tls_ == nullptr) {
    const ssize_t put = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (put >= 0) return static_cast<std::size_t>(put);
    if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR) return 0;
    return broken(fmt::format("breaks off: {}", std::strerror(errno)));
  }
  ERR_clear_error();
  const int put = SSL_write(tls_, bytes.data(), static_cast<int>(bytes.size()));
  if (put > 0) return static_cast<std::size_t>(put);
  const int kind = SSL_get_error(tls_, put);
  if (kind == SSL_ERROR_WANT_READ) events = POLLIN;
  if (kind == SSL_ERROR_WANT_READ || kind == SSL_ERROR_WANT_WRITE) return 0;
  return broken_tls("breaks off", put);
}

// The kernel knows what the other side's has confirmed; syslog itself has no receipts.
Status StreamConnection::wait_for_confirmation(const std::stop_token& stop) {
  auto pause = std::chrono::microseconds(50);
  for (;;) {
    int unconfirmed = 0;
    if (::ioctl(socket_, SIOCOUTQ, &unconfirmed) != 0) return broken(std::strerror(errno));
    TIDEMARK_TRY(look());  // a connection that was reset has nothing unconfirmed, either
    if (unconfirmed == 0) return {};
    if (stop.stop_requested()) {
      is_broken_ = true;
      return cancelled_error();
    }
    if (Clock::now() >= deadline_)
      return broken(fmt::format("does not take a message within {} s", server_.timeout_seconds));
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, std::chrono::microseconds(5000));
  }
}

Status StreamConnection::send(std::string_view bytes, const std::stop_token& stop) {
  set_deadline();
  while (!bytes.empty()) {
    short events = 0;
    const auto put = write_some(bytes, events);
    if (!put) return pass_on(put);
    bytes.remove_prefix(*put);
    if (*put == 0) TIDEMARK_TRY(wait(events, stop));
  }
  return wait_for_confirmation(stop);
}

}  // namespace tidemark::imaging
