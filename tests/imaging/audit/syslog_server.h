// A syslog server for tests: by UDP, or by TCP with counted frames (RFC 5425 4.3).
#pragma once

#include <QByteArray>
#include <QProcess>
#include <atomic>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "imaging/audit/configuration.h"
#include "tests/imaging/pacs/certificates.h"

namespace tidemark::test {

class SyslogServer {
 public:
  enum class Way { udp, tcp };
  enum class Manner { reads, never_reads };
  // Port 0: any that is free.
  explicit SyslogServer(Way way = Way::tcp, int port = 0, Manner manner = Manner::reads);
  ~SyslogServer();
  SyslogServer(const SyslogServer&) = delete;
  SyslogServer& operator=(const SyslogServer&) = delete;

  [[nodiscard]] int port() const { return port_; }
  [[nodiscard]] imaging::AuditServer server() const;

  // Whole messages, in the order in which they came.
  [[nodiscard]] std::vector<std::string> messages() const;
  // The same, once there are so many, or ten seconds have passed.
  [[nodiscard]] std::vector<std::string> wait_for(std::size_t count) const;

 private:
  void serve();
  void serve_datagrams();
  void read_frames(int connection);

  const Way way_;
  const Manner manner_;
  int socket_ = -1;
  int port_ = 0;
  std::atomic<bool> quit_ = false;
  mutable std::mutex mutex_;
  std::vector<std::string> messages_;
  std::vector<std::jthread> connections_;  // of thread_ alone
  std::thread thread_;
};

// The same behind TLS, by a program of its own.
class TlsFront {
 public:
  TlsFront(const SyslogServer& behind, const Certificates::Pair& own);
  ~TlsFront();
  [[nodiscard]] imaging::AuditServer server(const Certificates& trusted) const;

 private:
  int port_;
  QProcess process_;
};

// An element of an XML document.
struct XmlElement {
  QString name;
  std::map<QString, QString> attributes;
  QString text;
  std::vector<XmlElement> inside;

  // All of that name, and the only one, below it. Ends the test program where there is not exactly one.
  [[nodiscard]] std::vector<XmlElement> all(const QString& wanted) const;
  [[nodiscard]] XmlElement one(const QString& wanted) const;
  [[nodiscard]] QString operator[](const QString& attribute) const;
};

// The root of the audit message in a syslog message. Ends the test program where it is no XML.
XmlElement audit_in(const std::string& message);
// The codes of the events in messages: "110100 110103".
QString codes_in(const std::vector<std::string>& messages);

}  // namespace tidemark::test
