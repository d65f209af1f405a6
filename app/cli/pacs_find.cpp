// tidemark-cli pacs find: the studies that a server has, or the series of one.
#include "app/cli/pacs_commands.h"
#include "imaging/pacs/services.h"

namespace tidemark::cli {
namespace {

constexpr CommandHelp kPacsFind{
    "find", "Lists a server's studies, or the series of a study",
    "Lists the studies that match all that is given, or with --study that study's series. Texts may hold "
    "the\n"
    "wildcards * and ?; what counts as a match is the server's to decide, such as capital letters. Standard\n"
    "output holds what the server says about patients.",
    "  tidemark-cli pacs find main --patient-name 'Doe*' --from 2026-01-01 --modality CT\n"
    "  tidemark-cli pacs find main --study 1.2.840.99.7\n"};

struct FindOptions {
  ServerChoice choice;
  imaging::StudyQuery studies;
  std::string study;
};

template <class Number>
Json json_or_null(const std::optional<Number>& number) {
  return number ? Json(*number) : Json();
}

Json to_json(const imaging::PacsStudy& study) {
  Json object;
  object["uid"] = study.uid;
  object["patient_name"] = study.patient_name;
  object["patient_id"] = study.patient_id;
  object["birth_date"] = study.birth_date;
  object["date"] = study.date;
  object["description"] = study.description;
  object["modalities"] = study.modalities;
  object["series"] = json_or_null(study.series);
  object["objects"] = json_or_null(study.objects);
  return object;
}

Json to_json(const imaging::PacsSeries& series) {
  Json object;
  object["uid"] = series.uid;
  object["study_uid"] = series.study_uid;
  object["number"] = series.number;
  object["modality"] = series.modality;
  object["description"] = series.description;
  object["date"] = series.date;
  object["body_part"] = series.body_part;
  object["objects"] = json_or_null(series.objects);
  return object;
}

std::string count_text(const std::optional<std::int64_t>& count) {
  return count ? fmt::format("{}", *count) : "an unknown number";
}

void say(Console& console, const imaging::PacsStudy& study) {
  std::string modalities;
  for (const std::string& one : study.modalities) modalities += (modalities.empty() ? "" : ", ") + one;
  console.say("{}  {}", study.date.empty() ? "no date   " : study.date, study.description);
  console.say("  patient     {} ({})", imaging::readable_name(study.patient_name), study.patient_id);
  console.say("  modalities  {}", modalities);
  console.say("  holds       {} objects in {} series", count_text(study.objects), count_text(study.series));
  console.say("  uid         {}", study.uid);
}

void say(Console& console, const imaging::PacsSeries& series) {
  console.say("{}  {}", series.modality, series.description);
  console.say("  number      {}", series.number);
  if (!series.body_part.empty()) console.say("  body part   {}", series.body_part);
  console.say("  holds       {} objects", count_text(series.objects));
  console.say("  uid         {}", series.uid);
}

template <class Entry>
Status report(Console& console, const char* key, const Result<imaging::Found<Entry>>& found) {
  if (!found) return pass_on(found);
  Json object;
  object[key] = Json::array();
  for (const Entry& entry : found->entries) {
    object[key].push_back(to_json(entry));
    if (!console.json()) say(console, entry);
  }
  object["more"] = found->more;
  if (found->more) {
    console.warn(
        fmt::format("the server has more than these {} {}: ask for less", found->entries.size(), key));
  }
  console.say("{} {}", found->entries.size(), key);
  console.result(object);
  return {};
}

Status run(Program& program, const FindOptions& options) {
  const auto chosen = chosen_pacs(options.choice);
  if (!chosen) return pass_on(chosen);
  Console& console = program.console;
  const imaging::StudyQuery& query = options.studies;
  if (options.study.empty()) {
    return report(console, "studies",
                  imaging::find_studies(chosen->server, query, chosen->limits, console.progress()));
  }
  const imaging::SeriesQuery in_study{options.study, query.modality, query.description};
  return report(console, "series",
                imaging::find_pacs_series(chosen->server, in_study, chosen->limits, console.progress()));
}

}  // namespace

StudyKeys add_study_keys(CLI::App& command, imaging::StudyQuery& query, const char* of_description) {
  const auto add = [&](const char* name, std::string& value, const char* type, const char* description) {
    return command.add_option(name, value, description)->type_name(type);
  };
  StudyKeys keys;
  keys.of_studies = {
      add("--patient-name", query.patient_name, "TEXT", "As DICOM writes it: Family^Given"),
      add("--patient-id", query.patient_id, "TEXT", "The patient's number"),
      add("--from", query.date_from, "DATE", "Studies of that day and later: 2026-07-31"),
      add("--to", query.date_to, "DATE", "Studies of that day and earlier"),
  };
  keys.all = keys.of_studies;
  keys.all.push_back(add("--modality", query.modality, "WORD", "CT, MR, ..."));
  keys.all.push_back(add("--description", query.description, "TEXT", of_description));
  return keys;
}

void add_pacs_find(CLI::App& pacs, Program& program) {
  auto options = std::make_shared<FindOptions>();
  CLI::App& command =
      add_command(pacs, program, kPacsFind, [&program, options] { return run(program, *options); });
  add_server_choice(command, options->choice);
  imaging::StudyQuery& query = options->studies;
  const StudyKeys keys = add_study_keys(command, query, "Of the study; with --study, of the series");
  CLI::Option* study = command.add_option("--study", options->study, "List the series of this study");
  study->type_name("UID");
  for (CLI::Option* option : keys.of_studies) option->excludes(study);
}

}  // namespace tidemark::cli
