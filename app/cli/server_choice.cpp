#include "app/cli/server_choice.h"

namespace tidemark::cli {

void add_server_choice(CLI::App& command, ServerChoice& choice) {
  command.add_option("SERVER", choice.server, "The name of a server in the file of servers")
      ->required()
      ->type_name("");
  command.add_option("--servers", choice.file, "The file of servers, instead of the usual one")
      ->type_name("FILE.json");
}

}  // namespace tidemark::cli
