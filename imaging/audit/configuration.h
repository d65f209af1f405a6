// The configuration of audit messages: whether there are any, and where they go.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/result.h"
#include "imaging/web/web_server.h"

namespace tidemark::imaging {

// An audit record repository, as the standards call it.
struct AuditServer {
  enum class Protocol {
    udp,  // RFC 5426; what is lost, is lost
    tcp,  // in the clear, with the frames of RFC 5425: for relays of one's own
    tls,  // RFC 5425
  };

  std::string host;
  int port = 6514;  // 514 by UDP
  Protocol protocol = Protocol::tls;
  int timeout_seconds = 10;  // for the connection, and for each message
  TlsFiles tls;

  // "audit.example:6514"
  [[nodiscard]] std::string address() const;
};

struct AuditConfiguration {
  // One of both.
  std::optional<AuditServer> server;
  std::filesystem::path file;  // gets a line for each message

  std::string site;              // AuditEnterpriseSiteID (DICOM PS3.15 A.5.2); may be empty
  std::string source;            // AuditSourceID; empty: the host's name
  std::size_t waiting = 10'000;  // messages that may wait for the server; more are lost
};

// audit.json in site_folder(), else of user_configuration_file(); the site's comes first, so that no user's
// file takes its place. Nothing: there is none, and nothing is audited.
[[nodiscard]] std::optional<std::filesystem::path> audit_configuration_to_read();

// Files are relative to the configuration's folder. Fails (ErrorKind::input) naming the file and the field at
// fault.
Result<AuditConfiguration> read_audit_configuration(const std::filesystem::path& file);

}  // namespace tidemark::imaging
