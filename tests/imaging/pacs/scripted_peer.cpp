#include "tests/imaging/pacs/scripted_peer.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <QtGlobal>

#include "tests/imaging/pacs/wire.h"

namespace tidemark::test {
namespace {

constexpr int kLook = 20;  // ms

bool is_ready(int socket, short events) {
  pollfd one{socket, events, 0};
  return ::poll(&one, 1, kLook) > 0;
}

}  // namespace

bool PeerEnd::write(const std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    if (quit_) return false;
    if (!is_ready(socket_, POLLOUT)) continue;
    const ssize_t put = ::send(socket_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (put <= 0) return false;
    at += static_cast<std::size_t>(put);
  }
  return true;
}

bool PeerEnd::read_exactly(std::string& bytes) {
  for (std::size_t at = 0; at < bytes.size();) {
    if (quit_) return false;
    if (!is_ready(socket_, POLLIN)) continue;
    const ssize_t got = ::recv(socket_, bytes.data() + at, bytes.size() - at, 0);
    if (got <= 0) return false;
    at += static_cast<std::size_t>(got);
  }
  return true;
}

std::string PeerEnd::read_pdu(int* type) {
  std::string head(6, '\0');
  if (!read_exactly(head)) return {};
  std::size_t length = 0;
  for (std::size_t i = 2; i < 6; ++i) length = length << 8 | static_cast<unsigned char>(head[i]);
  if (type != nullptr) *type = static_cast<unsigned char>(head[0]);
  std::string body(length, '\0');
  return read_exactly(body) ? body : std::string();
}

void PeerEnd::accept_call() {
  const auto contexts = contexts_of(read_pdu());
  for (const ProposedContext& one : contexts) contexts_.emplace(one.abstract_syntax, one.id);
  write(accept_all(contexts));
}

int PeerEnd::context(const std::string& abstract_syntax) const {
  const auto found = contexts_.find(abstract_syntax);
  return found == contexts_.end() ? 1 : found->second;
}

std::string PeerEnd::read_command() {
  std::string command;
  for (bool command_ended = false, data_ended = false; !command_ended || !data_ended;) {
    int type = 0;
    const std::string body = read_pdu(&type);
    if (type == 5) write(pdu(6, std::string(4, '\0')));
    if (body.size() < 6 || type != 4) return {};
    for (std::size_t at = 0; at + 6 <= body.size();) {
      std::size_t length = 0;
      for (std::size_t i = 0; i < 4; ++i) length = length << 8 | static_cast<unsigned char>(body[at + i]);
      const bool is_command = (body[at + 5] & 1) != 0;
      const bool is_last = (body[at + 5] & 2) != 0;
      if (is_command) command += body.substr(at + 6, length - 2);
      if (is_last && !is_command) data_ended = true;
      if (is_last && is_command) {
        command_ended = true;
        data_ended = short_value(command, 0x0800) == 0x0101;  // none follow
      }
      at += 4 + length;
    }
  }
  return command;
}

bool PeerEnd::send_command(int context, const std::string& command) {
  return write(data_pdus(context, true, command));
}

bool PeerEnd::send_data(int context, const std::string& data, bool is_last) {
  return write(data_pdus(context, false, data, is_last));
}

std::string PeerEnd::read_request(std::string* wanted_body) {
  std::string head;
  std::string byte(1, '\0');
  while (!head.ends_with("\r\n\r\n")) {
    if (!read_exactly(byte)) return {};
    head += byte;
  }
  const std::string name = "Content-Length: ";
  const std::size_t at = head.find(name);
  if (at != std::string::npos) {
    std::string body(std::stoul(head.substr(at + name.size())), '\0');
    if (!read_exactly(body)) return {};
    if (wanted_body != nullptr) *wanted_body = std::move(body);
  }
  return head;
}

void PeerEnd::say_nothing() {
  std::string byte(1, '\0');
  while (read_exactly(byte)) {
  }
}

ScriptedPeer::ScriptedPeer(Behaviour behave) : behave_(std::move(behave)) {
  listening_ = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  if (::bind(listening_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(listening_, 8) != 0 ||
      ::getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    qFatal("cannot listen on the loopback interface");
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { serve(); });
}

ScriptedPeer::~ScriptedPeer() {
  quit_ = true;
  thread_.join();
  ::close(listening_);
}

void ScriptedPeer::serve() {
  while (!quit_) {
    if (!is_ready(listening_, POLLIN)) continue;
    const int socket = ::accept(listening_, nullptr, nullptr);
    if (socket < 0) continue;
    PeerEnd end(socket, quit_);
    behave_(end);
    ::close(socket);
  }
}

imaging::PacsServer ScriptedPeer::server() const {
  imaging::PacsServer server;
  server.name = "peer";
  server.host = "127.0.0.1";
  server.port = port_;
  server.ae_title = "PEER";
  server.timeout_seconds = 1;
  return server;
}

imaging::PacsServer ScriptedPeer::web_server() const {
  imaging::PacsServer server;
  server.name = "peer";
  server.web = imaging::WebAccess{fmt::format("http://127.0.0.1:{}/web", port_), {}, {}};
  server.timeout_seconds = 1;
  return server;
}

}  // namespace tidemark::test
