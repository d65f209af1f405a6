// tidemark-cli pacs get and send.
#include <filesystem>
#include <map>
#include <system_error>

#include "app/cli/deidentify_options.h"
#include "app/cli/pacs_commands.h"
#include "core/files_below.h"
#include "imaging/archive/private_folder.h"
#include "imaging/dicom/detect.h"
#include "imaging/pacs/services.h"

namespace tidemark::cli {
namespace {

namespace fs = std::filesystem;

constexpr CommandHelp kPacsGet{
    "get", "Brings a series or a study from a server",
    "Brings the objects of a series, or of all series of a study, into DIR, as the server's entry says: on "
    "one\n"
    "connection (\"retrieve\": \"get\"), or by the server's own calls to this machine (\"move\"). Where some "
    "objects\n"
    "could not come, those that came stay and the command ends with code 3; otherwise a failure leaves "
    "nothing.",
    "  tidemark-cli pacs get main --study 1.2.840.99.7 --series 1.2.840.99.7.2 --out series\n"
    "  tidemark-cli info series\n"};

constexpr CommandHelp kPacsSend{
    "send", "Sends DICOM files to a server",
    "Sends DICOM files, and those in folders, as they are: a server that does not take a file's compression "
    "does\n"
    "not get that file. Where some files could not be sent, the command names them and ends with code 3.\n"
    "With --deidentify anonymous copies are sent, as the command deidentify makes them without an option.",
    "  tidemark-cli pacs send main series/\n"
    "  tidemark-cli pacs send main mask.dcm --json\n"
    "  tidemark-cli pacs send research series/ --deidentify\n"};

struct GetOptions {
  ServerChoice choice;
  imaging::RetrieveRequest request;
};

struct SendOptions {
  ServerChoice choice;
  std::vector<std::string> paths;
  bool deidentify = false;
};

Status run_get(Program& program, const GetOptions& options) {
  const auto chosen = chosen_pacs(options.choice);
  if (!chosen) return pass_on(chosen);
  Console& console = program.console;
  const auto retrieved =
      imaging::retrieve(chosen->server, options.request, chosen->limits, console.progress());
  if (!retrieved) return pass_on(retrieved);
  const std::string folder = options.request.folder.string();
  console.say("Wrote      {}: {} objects, {:.1f} MB", folder, retrieved->files.size(),
              static_cast<double>(retrieved->bytes) / 1e6);
  for (const std::string& reason : retrieved->refused) console.warn(reason);
  Json object;
  object["folder"] = folder;
  object["objects"] = retrieved->files.size();
  object["bytes"] = retrieved->bytes;
  object["missing"] = retrieved->missing;
  object["refused"] = retrieved->refused;
  console.result(object);
  if (retrieved->missing == 0 && retrieved->refused.empty()) return {};
  return fail(ErrorKind::input,
              "{}: is not complete: {} objects could not be sent by the server, {} were not taken", folder,
              retrieved->missing, retrieved->refused.size());
}

// What cannot be opened may be one: to send it says why it is not sent.
bool may_be_dicom(const fs::path& file) {
  auto bytes = imaging::FileBytes::open(file);
  return !bytes || imaging::begins_as_dicom(*bytes);
}

// The files themselves, and the DICOM files in folders.
Result<std::vector<fs::path>> files_of(const std::vector<std::string>& paths) {
  std::vector<fs::path> files;
  for (const fs::path path : paths) {
    auto inside = files_below(path);
    if (!inside) return pass_on(inside);
    std::error_code error;
    if (fs::is_directory(path, error)) {
      std::erase_if(*inside, [](const fs::path& file) { return !may_be_dicom(file); });
    }
    if (inside->empty()) return fail(ErrorKind::input, "{}: holds no DICOM file", path.string());
    files.insert(files.end(), inside->begin(), inside->end());
  }
  return files;
}

// De-identified copies for as long as they are sent, and what they are made of.
struct AnonymousCopies {
  imaging::PrivateFolder folder;
  imaging::Deidentified made;
  std::vector<fs::path> files;
  std::map<fs::path, fs::path> sources;  // by copy
};

Result<AnonymousCopies> make_copies(const std::vector<fs::path>& files, Console& console) {
  auto folder = imaging::PrivateFolder::create();
  if (!folder) return pass_on(folder);
  const fs::path place = folder->path() / "anonymous";
  auto made = imaging::deidentify(files, place, {}, console.progress());
  if (!made) return pass_on(made);
  TIDEMARK_TRY(made->folder.commit());
  AnonymousCopies copies{std::move(*folder), std::move(*made), {}, {}};
  for (const imaging::DeidentifiedFile& file : copies.made.files) {
    copies.files.push_back(place / file.name);
    copies.sources[copies.files.back()] = file.source;
  }
  return copies;
}

// `copies`: what the files are, if they are such.
Status send_all(const ChosenPacs& chosen, const std::vector<fs::path>& files, const AnonymousCopies* copies,
                Console& console) {
  const auto sent = imaging::send_files(chosen.server, files, console.progress());
  if (!sent) return pass_on(sent);
  console.say("Sent       {} objects, {:.1f} MB", sent->objects, static_cast<double>(sent->bytes) / 1e6);
  Json object;
  object["objects"] = sent->objects;
  object["bytes"] = sent->bytes;
  object["unsent"] = Json::array();
  for (const imaging::Unsent& one : sent->unsent) {
    const fs::path& file = copies != nullptr ? copies->sources.at(one.file) : one.file;
    console.warn(fmt::format("{}: was not sent: {}", file.string(), one.reason));
    object["unsent"].push_back({{"file", file.string()}, {"reason", one.reason}});
  }
  if (copies != nullptr) {
    say_deidentified(console, copies->made, {});
    object["deidentified"] = deidentified_json(copies->made, {});
  }
  console.result(object);
  if (!sent->unsent.empty()) {
    return fail(ErrorKind::input, "{} of {} files were not sent", sent->unsent.size(), files.size());
  }
  return copies != nullptr ? require_complete(copies->made) : Status();
}

Status run_send(Program& program, const SendOptions& options) {
  const auto chosen = chosen_pacs(options.choice);
  if (!chosen) return pass_on(chosen);
  const auto files = files_of(options.paths);
  if (!files) return pass_on(files);
  if (!options.deidentify) return send_all(*chosen, *files, nullptr, program.console);
  const auto copies = make_copies(*files, program.console);
  if (!copies) return pass_on(copies);
  const Status sent = send_all(*chosen, copies->files, &*copies, program.console);
  imaging::record_audit({.kind = imaging::AuditEvent::Kind::exported,
                         .failure = imaging::failure_of(sent),
                         .peer = imaging::audited_peer(chosen->server),
                         .is_deidentified = true},
                        copies->made.studies);
  return sent;
}

}  // namespace

void add_pacs_get(CLI::App& pacs, Program& program) {
  auto options = std::make_shared<GetOptions>();
  CLI::App& command =
      add_command(pacs, program, kPacsGet, [&program, options] { return run_get(program, *options); });
  add_server_choice(command, options->choice);
  command.add_option("--study", options->request.study_uid, "The study (see find)")
      ->required()
      ->type_name("UID");
  command.add_option("--series", options->request.series_uid, "The series in it (default: all)")
      ->type_name("UID");
  const auto set_folder = [options](const std::string& folder) { options->request.folder = folder; };
  command
      .add_option_function<std::string>("--out", set_folder, "The folder to write to: a new or an empty one")
      ->required()
      ->type_name("DIR");
}

void add_pacs_send(CLI::App& pacs, Program& program) {
  auto options = std::make_shared<SendOptions>();
  CLI::App& command =
      add_command(pacs, program, kPacsSend, [&program, options] { return run_send(program, *options); });
  add_server_choice(command, options->choice);
  command.add_option("PATH", options->paths, "DICOM files, or folders of them")->required()->type_name("...");
  command.add_flag("--deidentify", options->deidentify,
                   "Sends anonymous copies, by the profile of the command deidentify");
}

}  // namespace tidemark::cli
