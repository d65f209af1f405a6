#include "imaging/pacs/configuration.h"

#include <algorithm>
#include <system_error>

#include "core/atomic_file.h"
#include "core/json/json.h"
#include "core/json/json_field.h"
#include "core/json/json_text.h"
#include "core/user_folders.h"
#include "imaging/web/server_file.h"
#include "imaging/web/web_address.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "pacs.json";
constexpr std::int64_t kMebibyte = std::int64_t{1} << 20;

// A title of an application entity (DICOM PS3.5 6.2, AE).
bool is_ae_title(const std::string& title) {
  const auto allowed = [](char c) { return c >= 0x20 && c < 0x7f && c != '\\'; };
  return !title.empty() && title.size() <= 16 && title.front() != ' ' && title.back() != ' ' &&
         std::all_of(title.begin(), title.end(), allowed);
}

ServerFault fault_of_dicom(const PacsServer& server) {
  if (!is_host(server.host)) return {"host", "is neither a host name nor an IPv4 address"};
  if (server.port < 1 || server.port > 65535) return {"port", "is not within 1 to 65535"};
  if (!is_ae_title(server.ae_title)) return {"ae_title", "is not 1 to 16 ASCII characters"};
  if (!is_ae_title(server.own_ae_title)) return {"own_ae_title", "is not 1 to 16 ASCII characters"};
  if (server.move_port < 1 || server.move_port > 65535) return {"move_port", "is not within 1 to 65535"};
  if (server.retrieve == PacsServer::Retrieve::move && server.tls && server.tls->certificate.empty())
    return {"tls", "retrieving by move needs a certificate and its key"};
  return {};
}

ServerFault fault_of(const PacsServer& server) {
  ServerFault fault = fault_of_common(server.name, server.timeout_seconds, server.tls);
  if (*fault.field != '\0') return fault;
  return server.web ? fault_of(*server.web, server.tls.has_value()) : fault_of_dicom(server);
}

void read_dicom_server(const JsonField& field, PacsServer& server) {
  field.only({"name", "host", "port", "ae_title", "own_ae_title", "retrieve", "move_port", "timeout_seconds",
              "tls"});
  server.host = field.at("host").text(253);
  server.ae_title = field.at("ae_title").text(16);
  read_whole(field, "port", 65535, server.port);
  read_whole(field, "move_port", 65535, server.move_port);
  if (field.has("own_ae_title")) server.own_ae_title = field.at("own_ae_title").text(16);
  if (field.has("retrieve") && field.at("retrieve").word({"get", "move"}) == 1)
    server.retrieve = PacsServer::Retrieve::move;
}

PacsServer read_server(const JsonField& field, const fs::path& folder) {
  PacsServer server;
  server.name = field.at("name").text(100);
  if (field.has("url")) {
    field.only({"name", "url", "user", "secret", "timeout_seconds", "tls"});
    server.web = read_web_access(field, folder);
  } else {
    read_dicom_server(field, server);
  }
  read_whole(field, "timeout_seconds", 3600, server.timeout_seconds);
  if (field.has("tls")) server.tls = read_tls(field.at("tls"), folder);
  if (!field.good()) return server;
  if (const ServerFault fault = fault_of(server); *fault.field != '\0') {
    field.wrong(fmt::format("{}: {}", fault.field, fault.reason));
  }
  return server;
}

PacsLimits read_limits(const JsonField& field) {
  field.only({"object_mib", "retrieval_mib", "objects", "free_mib", "answers"});
  PacsLimits limits;
  const auto mebibytes = [&](const char* key, std::int64_t& bytes) {
    if (field.has(key)) bytes = field.at(key).integer(1, std::int64_t{1} << 24) * kMebibyte;
  };
  mebibytes("object_mib", limits.object_bytes);
  mebibytes("retrieval_mib", limits.retrieval_bytes);
  mebibytes("free_mib", limits.free_bytes);
  if (field.has("objects")) limits.objects = field.at("objects").integer(1, 1'000'000);
  if (field.has("answers")) limits.answers = field.at("answers").integer(1, 100'000);
  return limits;
}

Json to_json(const PacsServer& server) {
  Json json{{"name", server.name}, {"timeout_seconds", server.timeout_seconds}};
  if (server.web) {
    json.update(
        {{"url", server.web->url}, {"user", server.web->user}, {"secret", server.web->secret.string()}});
  } else {
    json.update({{"host", server.host},
                 {"port", server.port},
                 {"ae_title", server.ae_title},
                 {"own_ae_title", server.own_ae_title},
                 {"retrieve", server.retrieve == PacsServer::Retrieve::get ? "get" : "move"},
                 {"move_port", server.move_port}});
  }
  if (server.tls) {
    json["tls"] = {{"ca", server.tls->ca.string()},
                   {"certificate", server.tls->certificate.string()},
                   {"key", server.tls->key.string()},
                   {"verify", server.tls->verify}};
  }
  return json;
}

Json to_json(const PacsLimits& limits) {
  return {{"object_mib", limits.object_bytes / kMebibyte},
          {"retrieval_mib", limits.retrieval_bytes / kMebibyte},
          {"objects", limits.objects},
          {"free_mib", limits.free_bytes / kMebibyte},
          {"answers", limits.answers}};
}

}  // namespace

std::string PacsServer::address() const {
  return web ? web->url : fmt::format("{}:{}", host, port);
}

Result<PacsServer> PacsConfiguration::server(const std::string& name) const {
  std::string known;
  for (const PacsServer& server : servers) {
    if (server.name == name) return server;
    known += (known.empty() ? "" : ", ") + server.name;
  }
  return fail(ErrorKind::usage, "there is no PACS server '{}': {}", name,
              known.empty() ? "none is configured" : "those that are configured are " + known);
}

Status check_pacs_server(const PacsServer& server) {
  const ServerFault fault = fault_of(server);
  if (*fault.field == '\0') return {};
  return fail(ErrorKind::input, "PACS server {}: {}: {}", server.name, fault.field, fault.reason);
}

AuditedPeer audited_peer(const PacsServer& server) {
  if (!server.web) return {server.host, {}, server.ae_title, server.own_ae_title};
  return {host_of(server.web->url), server.web->url, {}, {}};
}

fs::path pacs_configuration_file() {
  return user_configuration_file(kFile);
}

fs::path pacs_configuration_to_read(const fs::path& own) {
  return server_file_to_read(own, kFile);
}

Result<PacsConfiguration> read_chosen_pacs_configuration(const fs::path& chosen) {
  const auto file = chosen_server_file(chosen, pacs_configuration_file(), kFile);
  if (!file) return pass_on(file);
  return read_pacs_configuration(*file);
}

Result<PacsConfiguration> read_pacs_configuration(const fs::path& file) {
  const auto text = text_of_server_file(file, "it says which PACS servers there are");
  if (!text) return pass_on(text);
  const auto json = JsonDocument::parse(*text, file.string(), kServerFileLimits);
  if (!json) return pass_on(json);
  const JsonField root = root_of(*json, file.string());
  root.only({"servers", "limits", "locked"});
  PacsConfiguration configuration;
  const JsonField servers = root.at("servers");
  const fs::path folder = fs::absolute(file).parent_path();
  for (std::size_t i = 0; i < servers.size(kMostServers); ++i) {
    PacsServer server = read_server(servers.at(i), folder);
    if (configuration.server(server.name)) servers.at(i).at("name").wrong("another server has the same");
    configuration.servers.push_back(std::move(server));
  }
  configuration.locked = read_locked(root);
  if (root.has("limits")) configuration.limits = read_limits(root.at("limits"));
  if (!root.good()) return pass_on(root.status());
  return configuration;
}

Status write_pacs_configuration(const PacsConfiguration& configuration, const fs::path& file) {
  Json servers = Json::array();
  for (const PacsServer& server : configuration.servers) servers.push_back(to_json(server));
  const Json json{{"servers", servers}, {"limits", to_json(configuration.limits)}};
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error)
    return fail(ErrorKind::write, "{}: cannot be made: {}", file.parent_path().string(), error.message());
  return write_file(file, json_text(json));
}

}  // namespace tidemark::imaging
