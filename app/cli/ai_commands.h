// The commands under tidemark-cli ai.
#pragma once

#include <string>

#include "app/cli/program.h"
#include "app/cli/server_choice.h"
#include "imaging/ai/ai_server.h"

namespace tidemark::cli {

// Of ai_configuration_file() where no file was chosen.
Result<imaging::AiServer> chosen_ai_server(const ServerChoice& choice);

// "main (https://ai.example), encrypted by TLS", for people.
std::string describe(const imaging::AiServer& server);

void add_ai_segment(CLI::App& ai, Program& program);

}  // namespace tidemark::cli
