// The files of an encrypted connection, in PEM, and their place in a configuration.
#pragma once

#include <filesystem>
#include <string>

namespace tidemark {
class JsonField;
}

namespace tidemark::imaging {

struct PacsTls {
  std::filesystem::path ca;  // who may have signed the peer's certificate; empty: the system's authorities
  std::filesystem::path
      certificate;            // ours, for servers that ask for one and for retrieval by move; may be empty
  std::filesystem::path key;  // of our certificate
  bool verify = true;         // the peer's certificate and, where we call, its host's name

  bool operator==(const PacsTls&) const = default;
};

// Relative ones are relative to `folder`; empty where there is none.
[[nodiscard]] std::filesystem::path read_path(const JsonField& parent, const char* key,
                                              const std::filesystem::path& folder);

[[nodiscard]] PacsTls read_tls(const JsonField& field, const std::filesystem::path& folder);

// Empty: none.
[[nodiscard]] std::string fault_of(const PacsTls& tls);

// Letters, digits, dots, hyphens and underlines: a host's name, or an IPv4 address.
[[nodiscard]] bool is_host(const std::string& text);

}  // namespace tidemark::imaging
