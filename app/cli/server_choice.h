// The choice of a server on the command line, by its name in a file of servers.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace tidemark::cli {

struct ServerChoice {
  std::string server;
  std::string file;  // empty: the usual one
};

void add_server_choice(CLI::App& command, ServerChoice& choice);

}  // namespace tidemark::cli
