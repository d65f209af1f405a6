// The configuration of PACS servers: which there are, and how they are reached.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"
#include "imaging/audit/event.h"
#include "imaging/web/web_server.h"

namespace tidemark::imaging {

struct PacsServer {
  enum class Retrieve {
    get,   // objects come on our own connection (C-GET)
    move,  // the server connects to move_port of this machine (C-MOVE), which it must know by our AE title
  };

  std::string name;  // by which users choose it
  std::string host;
  int port = 104;
  std::string ae_title;                   // of the server, 1 to 16 characters
  std::string own_ae_title = "TIDEMARK";  // by which the server knows us
  Retrieve retrieve = Retrieve::get;
  int move_port = 11112;
  int timeout_seconds = 30;     // how long the server may take to answer, and to send its next 64 KiB
  std::optional<TlsFiles> tls;  // retrieval by move needs our certificate
  std::optional<WebAccess> web =
      {};  // DICOMweb, instead of DICOM's own protocol: host to move_port count for nothing

  // "pacs.example:104", or the url.
  [[nodiscard]] std::string address() const;

  bool operator==(const PacsServer&) const = default;
};

// The limits on a server's demands.
struct PacsLimits {
  std::int64_t object_bytes = std::int64_t{4} << 30;      // of one object
  std::int64_t retrieval_bytes = std::int64_t{64} << 30;  // of all objects of a retrieval
  std::int64_t objects = 20'000;                          // of a retrieval
  std::int64_t free_bytes = std::int64_t{2} << 30;        // stay free on the disk
  std::int64_t answers = 2'000;                           // of a query

  bool operator==(const PacsLimits&) const = default;
};

struct PacsConfiguration {
  std::vector<PacsServer> servers;
  PacsLimits limits;
  bool locked = false;  // of a site whose users have no others

  // Fails (ErrorKind::usage) naming the servers that there are.
  [[nodiscard]] Result<PacsServer> server(const std::string& name) const;
};

// pacs.json of user_configuration_file().
[[nodiscard]] std::filesystem::path pacs_configuration_file();

// Which of both to read: `own` where it is there, else the site's, pacs.json in site_folder(), where that is.
// A site's that is locked comes first.
[[nodiscard]] std::filesystem::path pacs_configuration_to_read(const std::filesystem::path& own);

// Files of certificates are relative to the configuration's folder. Fails (ErrorKind::input) naming the file
// and the field at fault.
Result<PacsConfiguration> read_pacs_configuration(const std::filesystem::path& file);

// The file that a user has chosen; where none is (empty), the user's own or the site's. Fails, too, as
// chosen_server_file().
Result<PacsConfiguration> read_chosen_pacs_configuration(const std::filesystem::path& chosen);

// Makes the folder where it is missing. Fails (ErrorKind::write).
Status write_pacs_configuration(const PacsConfiguration& configuration, const std::filesystem::path& file);

// The server as the other side of what is audited.
[[nodiscard]] AuditedPeer audited_peer(const PacsServer& server);

// Whether a conversation can be tried at all. Fails (ErrorKind::input) naming the field.
Status check_pacs_server(const PacsServer& server);

}  // namespace tidemark::imaging
