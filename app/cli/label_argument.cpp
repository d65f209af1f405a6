#include "app/cli/label_argument.h"

#include <charconv>

namespace tidemark::cli {
namespace {

std::optional<imaging::SegmentColour> parse_colour(std::string_view text) {
  unsigned rgb = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), rgb, 16);
  if (text.size() != 6 || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return imaging::SegmentColour{static_cast<std::uint8_t>(rgb >> 16),
                                static_cast<std::uint8_t>(rgb >> 8 & 0xff),
                                static_cast<std::uint8_t>(rgb & 0xff)};
}

// The text up to the next comma, which is removed.
std::string_view next_part(std::string_view& text) {
  const std::size_t comma = text.find(',');
  const std::string_view part = text.substr(0, comma);
  text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
  return part;
}

std::string help(const char* which) {
  std::string words;
  std::size_t line = 0;
  for (const imaging::NamedMeaning& named : imaging::segment_meanings()) {
    words += words.empty() ? "" : line > 85 ? "\n" : " ";
    if (line > 85) line = 0;
    words += named.word;
    line += named.word.size() + 1;
  }
  return std::string(which) +
         ": its name, its meaning in SNOMED CT (else what the name says) and its colour.\nMEANING is one "
         "of\n" +
         words;
}

// Errors name the option and end in wrong usage.
LabelArgument parse_or_throw(const std::string& text) {
  auto label = parse_label(text);
  if (!label) throw CLI::ValidationError("--label", label.error().message);
  return std::move(*label);
}

constexpr const char* kType = "NAME[,MEANING[,RRGGBB]]";

}  // namespace

void LabelArgument::apply(imaging::Segment& segment) const {
  if (!name.empty()) segment.name = name;
  if (meaning) {
    segment.meaning = *meaning;
  } else if (segment.meaning == imaging::SegmentMeaning()) {
    segment.meaning = imaging::guess_segment_meaning(name);
  }
  if (colour) segment.colour = colour;
}

Result<LabelArgument> parse_label(std::string_view text) {
  std::string_view rest = text;
  LabelArgument label;
  label.name = next_part(rest);
  if (const std::string_view word = next_part(rest); !word.empty()) {
    auto meaning = imaging::find_segment_meaning(word);
    if (!meaning) return pass_on(meaning);
    label.meaning = std::move(*meaning);
  }
  if (!rest.empty()) {
    label.colour = parse_colour(rest);
    if (!label.colour) return fail(ErrorKind::usage, "'{}' is not a colour of six hexadecimal digits", rest);
  }
  return label;
}

CLI::Option* add_label(CLI::App& app, LabelArgument& label) {
  return app
      .add_option_function<std::string>(
          "--label", [&label](const std::string& text) { label = parse_or_throw(text); },
          help("What --out *.dcm and --rtstruct say about the segment"))
      ->type_name(kType);
}

CLI::Option* add_labels(CLI::App& app, std::vector<LabelArgument>& labels) {
  const auto store = [&labels](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) labels.push_back(parse_or_throw(text));
  };
  return app
      .add_option_function<std::vector<std::string>>(
          "--label", store, help("What is said about the first segment, repeated about the next"))
      ->allow_extra_args(false)
      ->type_name(kType);
}

}  // namespace tidemark::cli
