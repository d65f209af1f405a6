#include "imaging/audit/destination.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/file_lock.h"
#include "imaging/audit/stream_connection.h"
#include "imaging/audit/syslog_frame.h"
#include "imaging/web/name_resolution.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// A descriptor that is closed with it.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

tl::unexpected<Error> cannot_write(const fs::path& file) {
  return fail(ErrorKind::write, "{}: no audit message can be written to it: {}", file.string(),
              std::strerror(errno));
}

// Each message is a line. Other programs may write to the file, too, and a message is in it whole or not at
// all.
class AuditFile final : public AuditDestination {
 public:
  explicit AuditFile(fs::path file) : file_(std::move(file)) {}

  Status deliver(const std::string& message, const std::stop_token& stop) override {
    const FileLock lock = FileLock::wait(file_, FileLock::Missing::make, stop);
    const Descriptor out(::open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600));
    const off_t before = out.number() < 0 ? -1 : ::lseek(out.number(), 0, SEEK_END);
    if (before < 0) return cannot_write(file_);
    const std::string line = message + "\n";
    const ssize_t put = ::write(out.number(), line.data(), line.size());
    if (put == static_cast<ssize_t>(line.size()) && ::fdatasync(out.number()) == 0) return {};
    if (put >= 0 && put < static_cast<ssize_t>(line.size())) errno = ENOSPC;
    auto failed = cannot_write(file_);
    static_cast<void>(!::ftruncate(out.number(), before));
    return failed;
  }

  // Whether it can be written to.
  [[nodiscard]] Status check() const {
    const Descriptor out(::open(file_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600));
    if (out.number() < 0) return cannot_write(file_);
    return {};
  }

 private:
  fs::path file_;
};

// RFC 5426: a message is a datagram.
class UdpServer final : public AuditDestination {
 public:
  explicit UdpServer(AuditServer server) : server_(std::move(server)) {}

  Status deliver(const std::string& message, const std::stop_token& stop) override {
    const auto address = resolve_host(server_.host, std::chrono::seconds(server_.timeout_seconds), stop);
    if (!address) return pass_on(address);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(server_.port));
    ::inet_pton(AF_INET, address->c_str(), &to.sin_addr);
    const Descriptor out(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    const ssize_t put = ::sendto(out.number(), message.data(), message.size(), MSG_NOSIGNAL | MSG_DONTWAIT,
                                 reinterpret_cast<const sockaddr*>(&to), sizeof to);
    if (put == static_cast<ssize_t>(message.size())) return {};
    return fail(ErrorKind::input, "audit server {}: cannot be called: {}", server_.address(),
                std::strerror(errno));
  }

 private:
  AuditServer server_;
};

// By TCP or TLS. The connection stays open for the next message.
class StreamServer final : public AuditDestination {
 public:
  StreamServer(AuditServer server, TlsContext tls) : server_(std::move(server)), tls_(std::move(tls)) {}

  Status deliver(const std::string& message, const std::stop_token& stop) override {
    if (connection_ && !connection_->is_open()) connection_.reset();
    if (!connection_) {
      auto opened = StreamConnection::open(server_, tls_, stop);
      if (!opened) return pass_on(opened);
      connection_ = std::move(*opened);
    }
    Status sent = connection_->send(counted_frame(message), stop);
    if (!sent) connection_.reset();
    return sent;
  }

 private:
  AuditServer server_;
  TlsContext tls_;
  std::unique_ptr<StreamConnection> connection_;
};

}  // namespace

Result<std::unique_ptr<AuditDestination>> AuditDestination::open(const AuditConfiguration& configuration) {
  if (!configuration.server) {
    auto file = std::make_unique<AuditFile>(configuration.file);
    TIDEMARK_TRY(file->check());
    return file;
  }
  const AuditServer& server = *configuration.server;
  if (server.protocol == AuditServer::Protocol::udp) return std::make_unique<UdpServer>(server);
  TlsContext tls;
  if (server.protocol == AuditServer::Protocol::tls) {
    auto made = make_tls_context(server.tls, server.host);
    if (!made) return pass_on(made);
    tls = std::move(*made);
  }
  return std::make_unique<StreamServer>(server, std::move(tls));
}

}  // namespace tidemark::imaging
