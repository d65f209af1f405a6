#include "tests/imaging/audit/syslog_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <QTest>
#include <QXmlStreamReader>
#include <chrono>
#include <cstdlib>

#include "tests/imaging/pacs/archives.h"

namespace tidemark::test {
namespace {

constexpr int kLookMs = 10;

bool is_readable(int socket) {
  pollfd one{socket, POLLIN, 0};
  return ::poll(&one, 1, kLookMs) > 0;
}

XmlElement read_element(QXmlStreamReader& reader) {
  XmlElement element;
  element.name = reader.name().toString();
  for (const auto& attribute : reader.attributes())
    element.attributes[attribute.name().toString()] = attribute.value().toString();
  while (reader.readNext() != QXmlStreamReader::EndElement && !reader.hasError()) {
    if (reader.isStartElement()) element.inside.push_back(read_element(reader));
    if (reader.isCharacters()) element.text += reader.text();
  }
  return element;
}

}  // namespace

SyslogServer::SyslogServer(Way way, int port, Manner manner) : way_(way), manner_(manner) {
  socket_ = ::socket(AF_INET, (way == Way::udp ? SOCK_DGRAM : SOCK_STREAM) | SOCK_CLOEXEC, 0);
  const int on = 1;
  ::setsockopt(socket_, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (manner == Manner::never_reads) {
    const int small = 4096;
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
  }
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  if (::bind(socket_, reinterpret_cast<sockaddr*>(&address), size) != 0) qFatal("cannot bind");
  if (way == Way::tcp) ::listen(socket_, 8);
  ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
  port_ = ntohs(address.sin_port);
  thread_ = std::thread([this] { way_ == Way::udp ? serve_datagrams() : serve(); });
}

SyslogServer::~SyslogServer() {
  quit_ = true;
  thread_.join();
  ::close(socket_);
}

imaging::AuditServer SyslogServer::server() const {
  using Protocol = imaging::AuditServer::Protocol;
  return {"localhost", port_, way_ == Way::udp ? Protocol::udp : Protocol::tcp, 2, {}};
}

void SyslogServer::serve_datagrams() {
  std::string room(std::size_t{1} << 16, '\0');
  while (!quit_) {
    if (!is_readable(socket_)) continue;
    const ssize_t got = ::recv(socket_, room.data(), room.size(), 0);
    const std::lock_guard lock(mutex_);
    if (got > 0) messages_.push_back(room.substr(0, static_cast<std::size_t>(got)));
  }
}

void SyslogServer::serve() {
  while (!quit_) {
    if (!is_readable(socket_)) continue;
    const int connection = ::accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
    if (connection < 0) continue;
    // Several programs may be connected at once.
    connections_.emplace_back([this, connection] {
      read_frames(connection);
      ::close(connection);
    });
  }
}

void SyslogServer::read_frames(int connection) {
  std::string bytes;
  while (!quit_) {
    if (manner_ == Manner::never_reads || !is_readable(connection)) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kLookMs));
      continue;
    }
    char room[4096];
    const ssize_t got = ::recv(connection, room, sizeof room, 0);
    if (got <= 0) return;
    bytes.append(room, static_cast<std::size_t>(got));
    for (std::size_t blank = 0; (blank = bytes.find(' ')) != std::string::npos;) {
      const std::size_t length = std::strtoul(bytes.substr(0, blank).c_str(), nullptr, 10);
      if (length == 0) return;  // no frame
      if (bytes.size() < blank + 1 + length) break;
      const std::lock_guard lock(mutex_);
      messages_.push_back(bytes.substr(blank + 1, length));
      bytes.erase(0, blank + 1 + length);
    }
  }
}

std::vector<std::string> SyslogServer::messages() const {
  const std::lock_guard lock(mutex_);
  return messages_;
}

std::vector<std::string> SyslogServer::wait_for(std::size_t count) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (messages().size() < count && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(kLookMs));
  return messages();
}

TlsFront::TlsFront(const SyslogServer& behind, const Certificates::Pair& own) : port_(free_port()) {
  const auto text = [](const std::filesystem::path& path) { return QString::fromStdString(path.string()); };
  process_.start("/usr/bin/python3", {TIDEMARK_TLS_FRONT, QString::number(port_),
                                      QString::number(behind.port()), text(own.certificate), text(own.key)});
  if (!process_.waitForReadyRead(20'000)) qFatal("the front does not start");
}

TlsFront::~TlsFront() {
  process_.kill();
  process_.waitForFinished();
}

imaging::AuditServer TlsFront::server(const Certificates& trusted) const {
  return {"localhost", port_, imaging::AuditServer::Protocol::tls, 5, {trusted.authority(), {}, {}, true}};
}

std::vector<XmlElement> XmlElement::all(const QString& wanted) const {
  std::vector<XmlElement> found;
  for (const XmlElement& element : inside) {
    if (element.name == wanted) found.push_back(element);
  }
  return found;
}

XmlElement XmlElement::one(const QString& wanted) const {
  const auto found = all(wanted);
  if (found.size() != 1) qFatal("%zu elements %s", found.size(), qPrintable(wanted));
  return found.front();
}

QString XmlElement::operator[](const QString& attribute) const {
  const auto found = attributes.find(attribute);
  return found == attributes.end() ? QString() : found->second;
}

XmlElement audit_in(const std::string& message) {
  QXmlStreamReader reader(QByteArray::fromStdString(message.substr(message.find("<?xml"))));
  if (!reader.readNextStartElement()) qFatal("no XML: %s", message.c_str());
  XmlElement root = read_element(reader);
  if (reader.hasError()) qFatal("%s: %s", qPrintable(reader.errorString()), message.c_str());
  return root;
}

QString codes_in(const std::vector<std::string>& messages) {
  QStringList codes;
  for (const std::string& message : messages)
    codes << audit_in(message).one("EventIdentification").one("EventID")["csd-code"];
  return codes.join(' ');
}

}  // namespace tidemark::test
