#include "imaging/audit/configuration.h"

#include <system_error>

#include "core/json/json_field.h"
#include "core/site_folder.h"
#include "core/text_file.h"
#include "core/user_folders.h"
#include "imaging/web/server_file.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr JsonLimits kAuditLimits{.bytes = std::size_t{1} << 16, .depth = 4};
constexpr const char* kName = "audit.json";
constexpr int kUdpPort = 514;  // RFC 5426 3.3

AuditServer read_audit_server(const JsonField& field, const fs::path& folder) {
  using Protocol = AuditServer::Protocol;
  field.only({"host", "port", "protocol", "timeout_seconds", "tls"});
  AuditServer server;
  server.host = field.at("host").text(253);
  if (field.has("protocol")) {
    constexpr Protocol kProtocols[] = {Protocol::udp, Protocol::tcp, Protocol::tls};
    server.protocol = kProtocols[field.at("protocol").word({"udp", "tcp", "tls"})];
  }
  if (server.protocol == Protocol::udp) server.port = kUdpPort;
  if (field.has("port")) server.port = static_cast<int>(field.at("port").integer(1, 65535));
  if (field.has("timeout_seconds"))
    server.timeout_seconds = static_cast<int>(field.at("timeout_seconds").integer(1, 600));
  if (field.has("tls")) server.tls = read_tls(field.at("tls"), folder);
  if (!field.good()) return server;
  if (!is_host(server.host)) field.at("host").wrong("is neither a host name nor an IPv4 address");
  if (field.has("tls") && server.protocol != Protocol::tls)
    field.at("tls").wrong("the protocol is another one");
  if (const std::string fault = fault_of(server.tls); !fault.empty()) field.at("tls").wrong(fault);
  return server;
}

}  // namespace

std::string AuditServer::address() const {
  return fmt::format("{}:{}", host, port);
}

std::optional<fs::path> audit_configuration_to_read() {
  std::error_code error;
  for (fs::path file : {site_folder() / kName, user_configuration_file(kName)}) {
    // What is there and cannot be looked at is asked for, too.
    const fs::file_status status = fs::status(file, error);
    if (status.type() != fs::file_type::not_found) return file;
  }
  return std::nullopt;
}

Result<AuditConfiguration> read_audit_configuration(const fs::path& file) {
  const auto text = read_text_file(file, kAuditLimits.bytes);
  if (!text) return pass_on(text);
  const auto json = JsonDocument::parse(*text, file.string(), kAuditLimits);
  if (!json) return pass_on(json);
  const JsonField root = root_of(*json, file.string());
  root.only({"server", "file", "site", "source", "waiting"});
  const fs::path folder = fs::absolute(file).parent_path();
  AuditConfiguration configuration;
  if (root.has("server")) configuration.server = read_audit_server(root.at("server"), folder);
  configuration.file = read_path(root, "file", folder);
  if (root.has("site")) configuration.site = root.at("site").text(200);
  if (root.has("source")) configuration.source = root.at("source").text(200);
  if (root.has("waiting"))
    configuration.waiting = static_cast<std::size_t>(root.at("waiting").integer(1, 1'000'000));
  if (root.good() && configuration.server.has_value() != configuration.file.empty()) {
    root.wrong("one of the fields server and file is needed, and not both");
  }
  if (!root.good()) return pass_on(root.status());
  return configuration;
}

}  // namespace tidemark::imaging
