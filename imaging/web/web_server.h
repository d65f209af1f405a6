// A web server, and the way to it: what all files of servers say of one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tidemark::imaging {

// Encryption, with files in PEM.
struct TlsFiles {
  std::filesystem::path ca;  // who may have signed the peer's certificate; empty: the system's authorities
  std::filesystem::path certificate;  // ours, for servers that ask for one; may be empty
  std::filesystem::path key;          // of our certificate
  bool verify = true;                 // the peer's certificate and, where we call, its host's name

  bool operator==(const TlsFiles&) const = default;
};

struct WebAccess {
  std::string url;               // of the service: "https://pacs.example/dicom-web"
  std::string user;              // whose password the secret is; empty: it is a token
  std::filesystem::path secret;  // a file with a password or a token in its only line; may be empty

  bool operator==(const WebAccess&) const = default;
};

struct WebServer {
  std::string title;  // as messages begin: "PACS main"
  WebAccess access;
  std::optional<TlsFiles> tls;
  int timeout_seconds = 30;  // how long it may take to answer, and to send its next 64 KiB
};

// Empty: none.
[[nodiscard]] std::string fault_of(const TlsFiles& tls);
// Letters, digits, dots, hyphens and underlines: a host's name, or an IPv4 address.
[[nodiscard]] bool is_host(const std::string& text);

// The fault of an entry: the field and the reason; an empty field where there is none.
struct ServerFault {
  const char* field = "";
  std::string reason = {};
};
[[nodiscard]] ServerFault fault_of(const WebAccess& access, bool has_tls);
// What every server has, whatever it speaks.
[[nodiscard]] ServerFault fault_of_common(const std::string& name, int timeout_seconds,
                                          const std::optional<TlsFiles>& tls);

}  // namespace tidemark::imaging
