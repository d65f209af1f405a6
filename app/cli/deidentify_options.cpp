#include "app/cli/deidentify_options.h"

#include <algorithm>
#include <cmath>

#include "app/cli/arguments.h"
#include "imaging/deidentify/shifted_date.h"

namespace tidemark::cli {
namespace {

using Kind = imaging::LeftOutFile::Kind;

constexpr const char* kKeep = "What is kept";

// "random", or a number of days.
void read_shift(const std::string& text, imaging::DeidentifyOptions& options) {
  options.shift_dates = true;
  if (text == "random") return;
  const auto days = parse_number(text);
  const bool is_fit =
      days && *days == std::floor(*days) && *days != 0.0 && std::abs(*days) <= imaging::kMostShiftDays;
  if (!is_fit) {
    throw CLI::ValidationError(
        "--shift-dates", fmt::format("'{}' is neither 'random' nor a number of days, 1 to {} forward or back",
                                     text, imaging::kMostShiftDays));
  }
  options.shift_days = static_cast<int>(*days);
}

const char* word_of(Kind kind) {
  switch (kind) {
    case Kind::not_dicom:
      return "not-dicom";
    case Kind::document:
      return "document";
    case Kind::risky:
      return "risky";
    case Kind::unreadable:
      return "unreadable";
  }
  return "";
}

std::vector<std::string> kept_words(const imaging::DeidentifyOptions& options) {
  std::vector<std::string> words;
  if (options.keep_uids) words.emplace_back("uids");
  if (options.keep_device) words.emplace_back("device");
  if (options.keep_institution) words.emplace_back("institution");
  if (options.keep_characteristics) words.emplace_back("characteristics");
  if (options.shift_dates) words.emplace_back("shifted-dates");
  return words;
}

}  // namespace

void add_deidentify_options(CLI::App& command, imaging::DeidentifyOptions& options) {
  command
      .add_option("--patient-id", options.patient_id,
                  "The new patient ID, of one patient alone (default: one by chance)")
      ->type_name("ID");
  command.add_option("--patient-name", options.patient_name, "The new patient's name (default: the new ID)")
      ->type_name("NAME");
  command
      .add_option_function<std::string>(
          "--shift-dates", [&options](const std::string& text) { read_shift(text, options); },
          "Dates stay, moved by days: a number for all patients, or one by chance for each\n(random). "
          "Times of the day stay. Without it dates and times go")
      ->type_name("DAYS|random")
      ->group(kKeep);
  command
      .add_flag("--keep-characteristics", options.keep_characteristics,
                "Sex, age, size, weight and the like stay; ages above 89 become 90")
      ->group(kKeep);
  command.add_flag("--keep-device", options.keep_device, "Serial numbers and names of devices stay")
      ->group(kKeep);
  command.add_flag("--keep-institution", options.keep_institution, "Names of institutions stay")
      ->group(kKeep);
  command.add_flag("--keep-uids", options.keep_uids, "UIDs stay")->group(kKeep);
  command.add_flag("--with-risky-images", options.with_risky_images,
                   "Takes images, too, that may show who it is: with burned-in text, secondary\ncaptures, "
                   "ultrasound. Pixels are never changed");
}

void say_deidentified(Console& console, const imaging::Deidentified& result,
                      const imaging::DeidentifyOptions& options) {
  using imaging::Change;
  console.say("Changed    {} values removed, {} emptied, {} replaced, {} moved",
              result.counts[Change::removed], result.counts[Change::emptied], result.counts[Change::replaced],
              result.counts[Change::shifted]);
  const std::vector<std::string> kept = kept_words(options);
  console.say("Profile    DICOM PS3.15 Basic Profile{}{}",
              kept.empty() ? "" : ", kept: ", fmt::join(kept, ", "));
  for (const imaging::LeftOutFile& file : result.left_out) {
    if (file.kind == Kind::not_dicom) continue;
    console.warn(fmt::format("{}: was left out: {}", file.file.string(), file.reason));
  }
  for (const imaging::DeidentifiedFile& file : result.files) {
    if (!file.risk.empty()) console.warn(fmt::format("{}: {}", file.source.string(), file.risk));
  }
}

Json deidentified_json(const imaging::Deidentified& result, const imaging::DeidentifyOptions& options) {
  Json object;
  object["files"] = result.files.size();
  object["series"] = result.series;
  object["patients"] = result.patients.size();
  object["kept"] = kept_words(options);
  for (std::size_t i = 0; i < imaging::kChangeNames.size(); ++i) {
    object["changes"][std::string(imaging::kChangeNames[i])] = result.counts.of[i];
  }
  object["left_out"] = Json::array();
  for (const imaging::LeftOutFile& file : result.left_out) {
    object["left_out"].push_back(
        {{"file", file.file.string()}, {"kind", word_of(file.kind)}, {"reason", file.reason}});
  }
  object["risky"] = Json::array();
  for (const imaging::DeidentifiedFile& file : result.files) {
    if (file.risk.empty()) continue;
    object["risky"].push_back({{"file", file.source.string()}, {"reason", file.risk}});
  }
  return object;
}

Status require_complete(const imaging::Deidentified& result) {
  const auto count =
      std::count_if(result.left_out.begin(), result.left_out.end(), [](const imaging::LeftOutFile& file) {
        return file.kind == Kind::risky || file.kind == Kind::unreadable;
      });
  if (count == 0) return {};
  return fail(ErrorKind::input, "{} of {} files were left out: they cannot be read, or may show who it is",
              count, result.files.size() + result.left_out.size());
}

}  // namespace tidemark::cli
