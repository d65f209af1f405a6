// The address of a service on the web: "https://pacs.example/dicom-web".
#pragma once

#include <string>

namespace tidemark::imaging {

// What is wrong with it; empty: nothing.
[[nodiscard]] std::string fault_of_address(const std::string& url);

// "pacs.example"
[[nodiscard]] std::string host_of(const std::string& url);
// By TLS.
[[nodiscard]] bool is_encrypted(const std::string& url);
// What goes there leaves this machine in no way.
[[nodiscard]] bool is_on_this_machine(const std::string& url);

// As a part of an address: what has a meaning there is escaped, but for the characters to keep. The wildcards
// * and ? have none in the question of an address: some servers do not look for escaped ones.
[[nodiscard]] std::string escaped(const std::string& text, const char* kept = "*?");

}  // namespace tidemark::imaging
