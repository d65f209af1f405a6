// The commands under tidemark-cli ai.
#pragma once

#include <string>

#include "app/cli/program.h"
#include "imaging/ai/ai_server.h"

namespace tidemark::cli {

// The choice of a server, common to all of them.
struct AiServerChoice {
  std::string server;
  std::string file;  // empty: ai_configuration_file()

  [[nodiscard]] Result<imaging::AiServer> choose() const;
};
void add_ai_server_choice(CLI::App& command, AiServerChoice& choice);

// "main (https://ai.example), encrypted by TLS", for people.
std::string describe(const imaging::AiServer& server);

void add_ai_segment(CLI::App& ai, Program& program);

}  // namespace tidemark::cli
