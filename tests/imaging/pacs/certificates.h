// Certificates made for a test, by openssl's own program.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/support.h"

namespace tidemark::test {

// An authority and its certificates. Everything lies in one folder, which is removed with the object.
class Certificates {
 public:
  Certificates();

  struct Pair {
    std::filesystem::path certificate;
    std::filesystem::path key;
  };
  // For a host (a DNS name or an IPv4 address).
  Pair signed_for(const std::string& host) const;
  [[nodiscard]] std::filesystem::path authority() const { return folder_ / "ca.pem"; }

 private:
  TemporaryFolder folder_;
};

}  // namespace tidemark::test
