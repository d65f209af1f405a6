#include "imaging/ai/ai_server.h"

#include "core/user_folders.h"
#include "imaging/web/server_file.h"
#include "imaging/web/web_address.h"

namespace tidemark::imaging {
namespace {

constexpr const char* kAiFile = "ai.json";

ServerFault fault_of(const AiServer& server) {
  ServerFault fault = fault_of_common(server.name, server.timeout_seconds, server.tls);
  return *fault.field != '\0' ? fault : fault_of(server.access, server.tls.has_value());
}

AiServer read_ai_server(const JsonField& field, const std::filesystem::path& folder) {
  field.only({"name", "protocol", "url", "user", "secret", "timeout_seconds", "tls"});
  AiServer server;
  server.name = field.at("name").text(100);
  if (field.at("protocol").word({"monai-label", "dls"}) == 1) server.protocol = AiServer::Protocol::dls;
  server.access = read_web_access(field, folder);
  read_whole(field, "timeout_seconds", 3600, server.timeout_seconds);
  if (field.has("tls")) server.tls = read_tls(field.at("tls"), folder);
  if (!field.good()) return server;
  if (const ServerFault fault = fault_of(server); *fault.field != '\0') {
    field.wrong(fmt::format("{}: {}", fault.field, fault.reason));
  }
  return server;
}

}  // namespace

bool AiServer::is_encrypted() const {
  return imaging::is_encrypted(access.url);
}

bool AiServer::is_on_this_machine() const {
  return imaging::is_on_this_machine(access.url);
}

Result<AiServer> AiConfiguration::server(const std::string& name) const {
  std::string known;
  for (const AiServer& server : servers) {
    if (server.name == name) return server;
    known += (known.empty() ? "" : ", ") + server.name;
  }
  return fail(ErrorKind::usage, "there is no AI server '{}': {}", name,
              known.empty() ? "none is configured" : "those that are configured are " + known);
}

std::filesystem::path ai_configuration_file() {
  return server_file_to_read(user_configuration_file(kAiFile), kAiFile);
}

Result<AiConfiguration> read_ai_configuration(const std::filesystem::path& file) {
  const auto text = text_of_server_file(file, "it says which AI servers there are");
  if (!text) return pass_on(text);
  const auto json = JsonDocument::parse(*text, file.string(), kServerFileLimits);
  if (!json) return pass_on(json);
  const JsonField root = root_of(*json, file.string());
  root.only({"servers", "locked"});
  static_cast<void>(read_locked(root));  // a value of another type is a fault
  AiConfiguration configuration;
  const JsonField servers = root.at("servers");
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  for (std::size_t i = 0; i < servers.size(kMostServers); ++i) {
    AiServer server = read_ai_server(servers.at(i), folder);
    if (configuration.server(server.name)) servers.at(i).at("name").wrong("another server has the same");
    configuration.servers.push_back(std::move(server));
  }
  if (!root.good()) return pass_on(root.status());
  return configuration;
}

Result<AiConfiguration> read_chosen_ai_configuration(const std::filesystem::path& chosen) {
  const auto file = chosen_server_file(chosen, user_configuration_file(kAiFile), kAiFile);
  if (!file) return pass_on(file);
  return read_ai_configuration(*file);
}

Status check_ai_server(const AiServer& server) {
  const ServerFault fault = fault_of(server);
  if (*fault.field == '\0') return {};
  return fail(ErrorKind::input, "AI server {}: {}: {}", server.name, fault.field, fault.reason);
}

}  // namespace tidemark::imaging
