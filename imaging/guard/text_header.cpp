#include "imaging/guard/text_header.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string_view>

#include "core/number_from.h"

namespace tidemark::imaging::files {
namespace {

constexpr std::size_t kLongestHeader = std::size_t{1} << 20;
constexpr std::size_t kLongestMetaLine = 499;  // MetaIO's buffer, less the zero byte
constexpr std::size_t kLongestMetaName = 200;
constexpr std::size_t kLongestMetaText = 254;  // where MetaIO copies a text without looking at its length
constexpr std::string_view kMetaTexts[] = {"AcquisitionDate", "Comment", "Name", "ObjectSubType",
                                           "ObjectType"};

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

// The start of the file, not inflated.
Result<std::string> read_text(const std::filesystem::path& file) {
  TIDEMARK_TRY(read_start(file, 1));
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) return fail(ErrorKind::input, "{}: {}", file.string(), error.message());
  std::ifstream stream(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(std::min<std::uintmax_t>(size, kLongestHeader)), '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, stream.gcount())));
  return text;
}

// Removes the next line from `rest`; nothing at the end of the text.
std::optional<std::string_view> next_line(std::string_view& rest) {
  const auto end = rest.find('\n');
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view line = rest.substr(0, end);
  rest.remove_prefix(end + 1);
  return line;
}

// Libraries differ on which of two lines of one name counts.
void add_field(TextHeader& header, std::string name, std::string_view value) {
  const auto [field, is_new] = header.fields.try_emplace(std::move(name), trimmed(value));
  if (!is_new && header.repeated.empty()) header.repeated = field->first;
}

// NRRD does not tell capitals from small letters in names.
void add_nrrd_field(TextHeader& header, std::string_view line) {
  const auto at = line.find(':');
  if (at != std::string_view::npos)
    add_field(header, lower(trimmed(line.substr(0, at))), line.substr(at + 1));
}

// What MetaIO would take for something else than is written there: it ends a name at ':' too and copies one
// of up to 500 bytes where it has room for 255 (as it does some values), ends a line at '\r', a text at a
// zero byte, and, where a value is empty or begins with a separator, skips to the next thing that is neither.
std::optional<std::string> ambiguity_of(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  const auto is_control = [](char c) { return c != '\t' && static_cast<unsigned char>(c) < ' '; };
  if (std::any_of(line.begin(), line.end(), is_control)) return "a control character";
  const std::size_t end = std::min(line.find_first_of("=:"), line.size());
  if (end > kLongestMetaName) return fmt::format("a name of {} bytes", end);
  if (line.size() > kLongestMetaLine) return fmt::format("a line of {} bytes", line.size());
  const std::string name = trimmed(line.substr(0, end));
  if (end < line.size() && line[end] == ':') return fmt::format("':' instead of '=' after '{}'", name);
  const std::string value = trimmed(line.substr(std::min(end + 1, line.size())));
  if (value.empty() || value[0] == '=' || value[0] == ':') return fmt::format("no value of '{}'", name);
  const bool is_text = std::find(std::begin(kMetaTexts), std::end(kMetaTexts), name) != std::end(kMetaTexts);
  if (const std::size_t length = line.size() - end - 1; is_text && length > kLongestMetaText) {
    return fmt::format("a value of '{}' of {} bytes", name, length);
  }
  return std::nullopt;
}

Result<TextHeader> without_repetition(TextHeader header, const std::filesystem::path& file) {
  if (header.repeated.empty()) return header;
  return fail(ErrorKind::input, "{}: the header has '{}' twice", file.string(),
              header.repeated.substr(0, 80));
}

}  // namespace

Result<TextHeader> read_nrrd_header(const std::filesystem::path& file) {
  auto text = read_text(file);
  if (!text) return pass_on(text);
  std::string_view rest(*text);
  const auto magic = next_line(rest);
  if (!magic || magic->substr(0, 7) != "NRRD000") {
    return fail(ErrorKind::input, "{}: not a NRRD file: it does not begin with 'NRRD000'", file.string());
  }
  TextHeader header;
  const bool detached = has_suffix(file, ".nhdr");
  while (const auto line = next_line(rest)) {
    if (trimmed(*line).empty()) {
      header.end = static_cast<std::int64_t>(text->size() - rest.size());
      return without_repetition(std::move(header), file);
    }
    if (line->front() != '#' && line->find(":=") == std::string_view::npos) add_nrrd_field(header, *line);
  }
  // A header of its own may end with the file.
  if (detached && text->size() < kLongestHeader) {
    add_nrrd_field(header, rest);
    return without_repetition(std::move(header), file);
  }
  return fail(ErrorKind::input, "{}: the header has no end (an empty line)", file.string());
}

Result<TextHeader> read_meta_header(const std::filesystem::path& file) {
  auto text = read_text(file);
  if (!text) return pass_on(text);
  if (text->size() < kLongestHeader && !text->ends_with('\n')) text->push_back('\n');
  std::string_view rest(*text);
  TextHeader header;
  while (const auto line = next_line(rest)) {
    if (trimmed(*line).empty()) continue;
    const auto at = line->find('=');
    if (at == std::string_view::npos && line->find(':') == std::string_view::npos) break;
    if (const auto ambiguity = ambiguity_of(*line)) {
      return fail(ErrorKind::input, "{}: the header has {}", file.string(), *ambiguity);
    }
    add_field(header, trimmed(line->substr(0, at)), line->substr(at + 1));
    if (header.fields.contains("ElementDataFile")) {
      header.end = static_cast<std::int64_t>(text->size() - rest.size());
      return without_repetition(std::move(header), file);
    }
  }
  return fail(ErrorKind::input, "{}: not a MetaImage file: its header has no ElementDataFile", file.string());
}

Status require_finite_fields(const TextHeader& header, const std::filesystem::path& file,
                             std::initializer_list<const char*> names) {
  constexpr std::string_view kBetween = " \t(),";
  for (const char* name : names) {
    const std::string text = header.find(name).value_or("");
    std::string_view rest(text);
    while (true) {
      rest.remove_prefix(std::min(rest.find_first_not_of(kBetween), rest.size()));
      if (rest.empty()) break;
      const std::string_view word = rest.substr(0, rest.find_first_of(kBetween));
      rest.remove_prefix(word.size());
      if (word != "none" && !number_from<double>(word)) {
        return fail(ErrorKind::input, "{}: {}: '{}' is not a number", file.string(), name, word);
      }
    }
  }
  return {};
}

}  // namespace tidemark::imaging::files
