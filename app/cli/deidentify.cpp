// tidemark-cli deidentify: DICOM files made anonymous.
#include <filesystem>
#include <memory>

#include "app/cli/deidentify_options.h"
#include "app/cli/outputs.h"
#include "app/cli/program.h"
#include "core/files_below.h"
#include "imaging/deidentify/deidentified_folder.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kDeidentify{
    "deidentify", "Makes DICOM files anonymous",
    "Writes the DICOM files of INPUT to DIR without what tells who the patient is, by the Basic Application\n"
    "Level Confidentiality Profile of DICOM PS3.15. Names, IDs, dates, descriptions, comments, overlays and\n"
    "private attributes go; the same UID becomes the same new one in all files. Pixels stay as they are.\n"
    "Structured reports and documents are left out, and images with burned-in text: the command names them,\n"
    "and ends with code 3 for the latter. Read a sample of what it wrote before you give it away.",
    "  tidemark-cli deidentify study/ --out anonymous\n"
    "  tidemark-cli deidentify study/ --out anonymous --patient-id CASE-07 --list changes.csv\n"
    "  tidemark-cli deidentify study/ --out anonymous --shift-dates random --keep-characteristics \\\n"
    "      --key secret.json                         PET: times are needed; the way back is in "
    "secret.json\n"};

struct Arguments {
  std::string input, out, list, key;
  imaging::DeidentifyOptions options;
};

bool is_csv(const std::string& file) {
  return std::filesystem::path(file).extension() == ".csv";
}

// Whether both files can be written, before the long work.
Status announce(const Arguments& arguments) {
  Outputs outputs;
  if (!arguments.list.empty()) {
    TIDEMARK_TRY(is_csv(arguments.list) ? outputs.announce_csv("--list", arguments.list)
                                        : outputs.announce_json("--list", arguments.list));
  }
  if (arguments.key.empty()) return {};
  return outputs.announce_json("--key", arguments.key);
}

Status run(Program& program, const Arguments& arguments) {
  Console& console = program.console;
  const imaging::DeidentifyPlaces places{arguments.input, arguments.out, arguments.list, arguments.key};
  TIDEMARK_TRY(imaging::check_places(places));
  TIDEMARK_TRY(announce(arguments));
  const auto files = files_below(arguments.input, console.progress());
  if (!files) return pass_on(files);
  const auto result = imaging::write_deidentified(*files, places, arguments.options, console.progress());
  if (!result) return pass_on(result);
  console.say("Wrote      {}: {} files in {} series of {} patients", arguments.out, result->files.size(),
              result->series, result->patients.size());
  for (const std::string& file : {arguments.list, arguments.key}) {
    if (!file.empty()) console.say("Wrote      {}", file);
  }
  say_deidentified(console, *result, arguments.options);
  Json object;
  object["folder"] = arguments.out;
  object.update(deidentified_json(*result, arguments.options));
  console.result(object);
  return require_complete(*result);
}

}  // namespace

void add_deidentify(CLI::App& app, Program& program) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App& command =
      add_command(app, program, kDeidentify, [&program, arguments] { return run(program, *arguments); });
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
