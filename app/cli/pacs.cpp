// tidemark-cli pacs: the group of its commands, and echo.
#include "app/cli/pacs_commands.h"

#include "imaging/pacs/services.h"

namespace tidemark::cli {
namespace {

constexpr const char* kPacsSummary = "Asks a PACS, brings series from it and sends files to it";
constexpr const char* kPacsFooter =
    "\nServers are named in $XDG_CONFIG_HOME/tidemark/pacs.json (else ~/.config/tidemark/pacs.json), like "
    "this:\n"
    "  {\"servers\": [{\"name\": \"main\", \"host\": \"pacs.example\", \"port\": 104, \"ae_title\": "
    "\"ARCHIVE\"}]}\n"
    "\nExamples:\n"
    "  tidemark-cli pacs echo main\n"
    "  tidemark-cli pacs COMMAND --help\n";

constexpr CommandHelp kPacsEcho{"echo", "Asks whether a server answers",
                                "Calls the server and says how long its answer took.",
                                "  tidemark-cli pacs echo main\n"
                                "  tidemark-cli pacs echo main --servers ward.json --json\n"};

Status run_echo(Program& program, const ServerChoice& choice) {
  const auto chosen = chosen_pacs(choice);
  if (!chosen) return pass_on(chosen);
  const imaging::PacsServer& server = chosen->server;
  const auto seconds = imaging::pacs_echo(server, program.console.progress());
  if (!seconds) return pass_on(seconds);
  const std::string address = server.web ? server.address() : server.address() + ", " + server.ae_title;
  program.console.say("{} ({}) answers in {:.0f} ms", server.name, address, *seconds * 1000.0);
  Json object;
  object["server"] = server.name;
  if (server.web) {
    object["url"] = server.web->url;
  } else {
    object["host"] = server.host;
    object["port"] = server.port;
    object["ae_title"] = server.ae_title;
  }
  object["seconds"] = *seconds;
  program.console.result(object);
  return {};
}

}  // namespace

Result<ChosenPacs> chosen_pacs(const ServerChoice& choice) {
  const auto configuration = imaging::read_chosen_pacs_configuration(choice.file);
  if (!configuration) return pass_on(configuration);
  auto chosen = configuration->server(choice.server);
  if (!chosen) return pass_on(chosen);
  return ChosenPacs{std::move(*chosen), configuration->limits};
}

void add_pacs(CLI::App& app, Program& program) {
  CLI::App& pacs = *app.add_subcommand("pacs", kPacsSummary);
  pacs.footer(kPacsFooter);
  pacs.require_subcommand(1);
  auto choice = std::make_shared<ServerChoice>();
  CLI::App& echo =
      add_command(pacs, program, kPacsEcho, [&program, choice] { return run_echo(program, *choice); });
  add_server_choice(echo, *choice);
  add_pacs_find(pacs, program);
  add_pacs_get(pacs, program);
  add_pacs_send(pacs, program);
}

}  // namespace tidemark::cli
