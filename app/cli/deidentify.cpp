// tidemark-cli deidentify: DICOM files made anonymous.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <system_error>

#include "app/cli/deidentify_options.h"
#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "core/csv.h"
#include "core/files_below.h"

namespace tidemark::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSummary = "Makes DICOM files anonymous";
constexpr const char* kDescription =
    "Writes the DICOM files of INPUT to DIR without what tells who the patient is, by the Basic Application\n"
    "Level Confidentiality Profile of DICOM PS3.15. Names, IDs, dates, descriptions, comments, overlays and\n"
    "private attributes go; the same UID becomes the same new one in all files. Pixels stay as they are.\n"
    "Structured reports and documents are left out, and images with burned-in text: the command names them,\n"
    "and ends with code 3 for the latter. Read a sample of what it wrote before you give it away.";
constexpr const char* kExamples =
    "  tidemark-cli deidentify study/ --out anonymous\n"
    "  tidemark-cli deidentify study/ --out anonymous --patient-id CASE-07 --list changes.csv\n"
    "  tidemark-cli deidentify study/ --out anonymous --shift-dates random --keep-characteristics \\\n"
    "      --key secret.json                         PET: times are needed; the way back is in secret.json\n";

struct Arguments {
  std::string input, out, list, key;
  imaging::DeidentifyOptions options;
};

bool lies_in(const fs::path& path, const fs::path& folder) {
  std::error_code ignored;
  const fs::path inner = fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  const fs::path outer = fs::weakly_canonical(fs::absolute(folder, ignored), ignored);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

Status check_places(const Arguments& arguments) {
  const fs::path out = arguments.out;
  if (lies_in(out, arguments.input) || lies_in(arguments.input, out)) {
    return fail(ErrorKind::usage, "--out {}: is INPUT, lies in it or holds it", arguments.out);
  }
  std::error_code error;
  if (fs::exists(out, error) && (!fs::is_directory(out, error) || !fs::is_empty(out, error))) {
    return fail(ErrorKind::usage, "--out {}: is there and not empty", arguments.out);
  }
  for (const auto& [option, file] : {std::pair{"--list", arguments.list}, {"--key", arguments.key}}) {
    if (file.empty()) continue;
    if (lies_in(file, out) || lies_in(file, arguments.input)) {
      return fail(ErrorKind::usage, "{} {}: lies in INPUT or in the new folder", option, file);
    }
  }
  if (!arguments.key.empty() && fs::exists(arguments.key, error)) {
    return fail(ErrorKind::usage, "--key {}: is there, and a key is not overwritten", arguments.key);
  }
  return {};
}

bool is_csv(const std::string& file) {
  return fs::path(file).extension() == ".csv";
}

Status announce(const Arguments& arguments, Outputs& outputs) {
  if (!arguments.list.empty()) {
    TIDEMARK_TRY(is_csv(arguments.list) ? outputs.announce_csv("--list", arguments.list)
                                        : outputs.announce_json("--list", arguments.list));
  }
  if (arguments.key.empty()) return {};
  return outputs.announce_json("--key", arguments.key);
}

std::string list_as_csv(const imaging::Deidentified& result) {
  std::string text = csv_line({"file", "attribute", "keyword", "change"});
  for (const imaging::DeidentifiedFile& file : result.files) {
    for (const imaging::ChangedAttribute& one : file.changes) {
      text += csv_line({csv_text(file.name), csv_text(one.path), csv_text(one.keyword),
                        std::string(imaging::kChangeNames[static_cast<std::size_t>(one.change)])});
    }
  }
  return text;
}

std::string list_as_json(const imaging::Deidentified& result) {
  Json list;
  list["files"] = Json::array();
  for (const imaging::DeidentifiedFile& file : result.files) {
    Json changes = Json::array();
    for (const imaging::ChangedAttribute& one : file.changes) {
      changes.push_back({{"attribute", one.path},
                         {"keyword", one.keyword},
                         {"change", imaging::kChangeNames[static_cast<std::size_t>(one.change)]}});
    }
    list["files"].push_back({{"file", file.name}, {"changes", std::move(changes)}});
  }
  return to_text(list);
}

std::string key_text(const imaging::Deidentified& result) {
  Json key;
  key["patients"] = Json::array();
  for (const auto& [old, pseudonym] : result.patients) {
    key["patients"].push_back(
        {{"old", old}, {"id", pseudonym.id}, {"name", pseudonym.name}, {"days", pseudonym.days}});
  }
  key["uids"] = Json::array();
  for (const auto& [old, uid] : result.uids) key["uids"].push_back({{"old", old}, {"new", uid}});
  key["files"] = Json::array();
  for (const imaging::DeidentifiedFile& file : result.files) {
    key["files"].push_back({{"old", file.source.string()}, {"new", file.name}});
  }
  return to_text(key);
}

// For the owner alone, before anything is in it.
Status write_private(const fs::path& file, const std::string& text) {
  std::error_code error;
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write, error);
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  if (!error && out.write(text.data(), static_cast<std::streamsize>(text.size())).flush()) return {};
  return fail(ErrorKind::write, "{}: cannot write", file.string());
}

Status stage(const Arguments& arguments, const imaging::Deidentified& result, Outputs& outputs) {
  if (!arguments.list.empty()) {
    const std::string text = is_csv(arguments.list) ? list_as_csv(result) : list_as_json(result);
    TIDEMARK_TRY(outputs.stage(arguments.list, [&](const fs::path& name) { return write_file(name, text); }));
  }
  if (arguments.key.empty()) return {};
  return outputs.stage(arguments.key,
                       [&](const fs::path& name) { return write_private(name, key_text(result)); });
}

Status run(Program& program, Arguments arguments) {
  Console& console = program.console;
  Outputs outputs;
  TIDEMARK_TRY(check_places(arguments));
  TIDEMARK_TRY(announce(arguments, outputs));
  arguments.options.list_changes = !arguments.list.empty();
  const auto files = files_below(arguments.input, console.progress());
  if (!files) return pass_on(files);
  auto result = imaging::deidentify(*files, arguments.out, arguments.options, console.progress());
  if (!result) return pass_on(result);
  TIDEMARK_TRY(stage(arguments, *result, outputs));
  if (console.interrupted()) return cancelled_error();
  // The key first: without it there is no way back from the folder.
  TIDEMARK_TRY(outputs.commit());
  TIDEMARK_TRY(result->folder.commit());
  console.say("Wrote      {}: {} files in {} series of {} patients", arguments.out, result->files.size(),
              result->series, result->patients.size());
  for (const std::string& file : {arguments.list, arguments.key}) {
    if (!file.empty()) console.say("Wrote      {}", file);
  }
  say(console, *result, arguments.options);
  Json object;
  object["folder"] = arguments.out;
  object.update(to_json(*result, arguments.options));
  console.result(object);
  return require_complete(*result);
}

}  // namespace

void add_deidentify(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App& command = add_command(app, program, {"deidentify", kSummary, kDescription, kExamples},
                                  [&program, arguments] { return run(program, *arguments); });
  command.add_option("INPUT", arguments->input, "A folder of DICOM files, or a file")
      ->required()
      ->type_name("");
  command.add_option("--out", arguments->out, "The folder to write to: a new or an empty one")
      ->required()
      ->type_name("DIR");
  add_deidentify_options(command, arguments->options);
  command
      .add_option("--list", arguments->list,
                  "What was done to which attribute of which file, without the old values")
      ->type_name("FILE.json|.csv");
  command
      .add_option("--key", arguments->key,
                  "Old patient IDs, UIDs and file names, and the new ones: for the owner alone, and not for\n"
                  "those who get the files")
      ->type_name("FILE.json");
}

}  // namespace tidemark::cli
