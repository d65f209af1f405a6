// tidemark-cli ai: the group of its commands, and models.
#include "app/cli/ai_commands.h"
#include "imaging/ai/ai_services.h"

namespace tidemark::cli {
namespace {

constexpr const char* kAiSummary = "Asks models on a server of the site to segment a volume";
constexpr const char* kAiFooter =
    "\nServers are named in $XDG_CONFIG_HOME/tidemark/ai.json (else ~/.config/tidemark/ai.json, else the "
    "site's),\n"
    "like this; without such a file nothing is sent anywhere:\n"
    "  {\"servers\": [{\"name\": \"main\", \"protocol\": \"monai-label\", \"url\": "
    "\"https://ai.example:8000\"}]}\n"
    "The protocols are monai-label and dls, ITK-SNAP's Deep Learning Segmentation server.\n"
    "\nExamples:\n"
    "  tidemark-cli ai models main\n"
    "  tidemark-cli ai COMMAND --help\n";

constexpr CommandHelp kAiModels{
    "models", "Lists the models of a server",
    "Lists the models that work on volumes, with their labels and whether they need clicks.",
    "  tidemark-cli ai models main\n"
    "  tidemark-cli ai models main --servers ward.json --json\n"};

const char* text_of(imaging::AiModel::Clicks clicks) {
  switch (clicks) {
    case imaging::AiModel::Clicks::none:
      return "none";
    case imaging::AiModel::Clicks::optional:
      return "optional";
    default:
      return "required";
  }
}

Status run_models(Program& program, const ServerChoice& choice) {
  const auto server = chosen_ai_server(choice);
  if (!server) return pass_on(server);
  const auto models = imaging::ai_models(*server, program.console.progress());
  if (!models) return pass_on(models);
  Json list = Json::array();
  for (const imaging::AiModel& model : *models) {
    program.console.say("{}", model.name);
    if (!model.description.empty()) program.console.say("  {}", model.description);
    program.console.say("  clicks  {}", text_of(model.clicks));
    Json labels = Json::array();
    std::string names;
    for (const imaging::AiLabel& label : model.labels) {
      names += (names.empty() ? "" : ", ") + label.name;
      labels.push_back({{"number", label.number}, {"name", label.name}});
    }
    if (!names.empty()) program.console.say("  labels  {}", names);
    list.push_back({{"name", model.name},
                    {"description", model.description},
                    {"clicks", text_of(model.clicks)},
                    {"labels", labels}});
  }
  if (models->empty()) program.console.say("{} has no model for volumes", server->name);
  program.console.result({{"server", server->name}, {"models", list}});
  return {};
}

}  // namespace

Result<imaging::AiServer> chosen_ai_server(const ServerChoice& choice) {
  const auto configuration = imaging::read_chosen_ai_configuration(choice.file);
  if (!configuration) return pass_on(configuration);
  return configuration->server(choice.server);
}

std::string describe(const imaging::AiServer& server) {
  return fmt::format("{} ({}), {}", server.name, server.access.url,
                     server.is_encrypted()         ? "encrypted by TLS"
                     : server.is_on_this_machine() ? "on this machine"
                                                   : "not encrypted");
}

void add_ai(CLI::App& app, Program& program) {
  CLI::App& ai = *app.add_subcommand("ai", kAiSummary);
  ai.footer(kAiFooter);
  ai.require_subcommand(1);
  auto choice = std::make_shared<ServerChoice>();
  CLI::App& models =
      add_command(ai, program, kAiModels, [&program, choice] { return run_models(program, *choice); });
  add_server_choice(models, *choice);
  add_ai_segment(ai, program);
}

}  // namespace tidemark::cli
