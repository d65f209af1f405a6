// The file of a site's servers with models, ai.json: which there are, and how they are reached.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "imaging/web/web_server.h"

namespace tidemark::imaging {

struct AiServer {
  enum class Protocol {
    monai_label,  // the REST interface of MONAI Label
    dls,          // ITK-SNAP's Deep Learning Segmentation server
  };

  std::string name;  // by which users choose it
  Protocol protocol = Protocol::monai_label;
  WebAccess access;
  std::optional<TlsFiles> tls;
  int timeout_seconds = 300;  // how long a model may take

  // By TLS, so that nobody on the way reads the voxels.
  [[nodiscard]] bool is_encrypted() const;
  // What is sent stays on this machine.
  [[nodiscard]] bool is_on_this_machine() const;

  bool operator==(const AiServer&) const = default;
};

struct AiConfiguration {
  std::vector<AiServer> servers;

  // Fails (ErrorKind::usage) naming the servers that there are.
  [[nodiscard]] Result<AiServer> server(const std::string& name) const;
};

// The file to read: the user's own, $XDG_CONFIG_HOME/tidemark/ai.json, else ~/.config/tidemark/ai.json, where
// it is there; else the site's, ai.json in site_folder(). A site's that is locked comes first.
[[nodiscard]] std::filesystem::path ai_configuration_file();

// Files of secrets and certificates are relative to the configuration's folder. Fails (ErrorKind::input)
// naming the file and the field at fault.
Result<AiConfiguration> read_ai_configuration(const std::filesystem::path& file);
// The file that a user has chosen; where none is (empty), ai_configuration_file(). Fails, too, as
// chosen_server_file().
Result<AiConfiguration> read_chosen_ai_configuration(const std::filesystem::path& chosen);

// Whether a conversation can be tried at all. Fails (ErrorKind::input) naming the field.
Status check_ai_server(const AiServer& server);

}  // namespace tidemark::imaging
