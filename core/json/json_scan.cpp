#include "core/json/json_scan.h"

#include <algorithm>

namespace tidemark {
namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_hexadecimal(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

}  // namespace

bool JsonScan::run() {
  constexpr std::string_view kMark = "\xef\xbb\xbf";  // of UTF-8, which some editors write
  if (text_.starts_with(kMark)) at_ = kMark.size();
  pass_blanks();
  if (!value()) return false;
  while (!open_.empty()) {
    if (!step()) return false;
  }
  pass_blanks();
  return ended() || wrong("nothing may follow");
}

bool JsonScan::step() {
  const JsonDocument::Number outer = open_.back();
  const bool is_object = text_[places_[outer].begin] == '{';
  const bool is_first = places_.size() == outer + 1;
  pass_blanks();
  if (next() == (is_object ? '}' : ']')) {
    ++at_;
    places_[outer].end = static_cast<JsonDocument::Number>(places_.size());
    open_.pop_back();
    return true;
  }
  if (!is_first) {
    if (!expect(',')) return false;
    pass_blanks();
  }
  if (is_object) {
    if (next() != '"') return wrong("a name is missing");
    if (!add() || !string()) return false;
    pass_blanks();
    if (!expect(':')) return false;
    pass_blanks();
  }
  return value();
}

bool JsonScan::value() {
  if (!add()) return false;
  switch (next()) {
    case '{':
    case '[':
      if (open_.size() == limits_.depth) {
        problem_ = fmt::format("nested more than {} deep", limits_.depth);
        return false;
      }
      open_.push_back(static_cast<JsonDocument::Number>(places_.size() - 1));
      ++at_;
      return true;
    case '"':
      return string();
    case 't':
      return literal("true");
    case 'f':
      return literal("false");
    case 'n':
      return literal("null");
    default:
      return number();
  }
}

bool JsonScan::add() {
  if (places_.size() == limits_.values) {
    problem_ = fmt::format("more than {} values are not read", limits_.values);
    return false;
  }
  const auto number = static_cast<JsonDocument::Number>(places_.size());
  places_.push_back({static_cast<std::uint32_t>(at_), number + 1});
  return true;
}

bool JsonScan::string() {
  ++at_;
  while (next() != '"') {
    const auto c = static_cast<unsigned char>(next());
    if (ended()) return wrong("a text does not end");
    if (c < 0x20) return wrong("a text holds a control character");
    if (c == '\\') {
      if (!escape()) return false;
    } else if (c < 0x80) {
      ++at_;
    } else if (!character()) {
      return false;
    }
  }
  ++at_;
  return true;
}

bool JsonScan::escape() {
  constexpr std::string_view kEscapes = "\"\\/bfnrtu";
  // The four digits of a surrogate, of the first or the second kind.
  const auto unit = [&](std::size_t at, std::string_view second_digits) {
    const std::string_view digits = text_.substr(std::min(at, text_.size()), 4);
    return digits.size() == 4 && std::all_of(digits.begin(), digits.end(), is_hexadecimal) &&
           (digits[0] | 0x20) == 'd' && second_digits.find(digits[1]) != std::string_view::npos;
  };
  ++at_;
  if (ended() || kEscapes.find(next()) == std::string_view::npos) return wrong("an escape is unknown");
  if (text_[at_++] != 'u') return true;
  const std::string_view digits = text_.substr(at_, 4);
  if (digits.size() < 4 || !std::all_of(digits.begin(), digits.end(), is_hexadecimal)) {
    return wrong("an escape needs four hexadecimal digits");
  }
  if (unit(at_, "cdefCDEF")) return wrong("half a pair of surrogates");
  if (unit(at_, "89abAB")) {
    if (text_.substr(at_ + 4, 2) != "\\u" || !unit(at_ + 6, "cdefCDEF")) {
      return wrong("half a pair of surrogates");
    }
    at_ += 6;
  }
  at_ += 4;
  return true;
}

// The well-formed sequences of the Unicode standard's table 3-7.
bool JsonScan::character() {
  const auto byte = [&](std::size_t k) {
    return at_ + k < text_.size() ? static_cast<unsigned char>(text_[at_ + k]) : 0U;
  };
  const unsigned first = byte(0);
  const std::size_t length = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  const unsigned least = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned most = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  bool good = length != 0 && byte(1) >= least && byte(1) <= most;
  for (std::size_t k = 2; k < length; ++k) good = good && (byte(k) & 0xc0U) == 0x80U;
  if (!good) return wrong("a text is not UTF-8");
  at_ += length;
  return true;
}

bool JsonScan::number() {
  if (next() == '-') ++at_;
  const bool is_zero = next() == '0';
  if (!is_digit(next())) return wrong("a value is missing");
  if (is_zero) {
    ++at_;
  } else {
    pass_digits();
  }
  if (next() == '.') {
    ++at_;
    if (!pass_digits()) return wrong("a number ends early");
  }
  if (next() == 'e' || next() == 'E') {
    ++at_;
    if (next() == '+' || next() == '-') ++at_;
    if (!pass_digits()) return wrong("a number ends early");
  }
  return true;
}

bool JsonScan::literal(std::string_view word) {
  if (text_.substr(at_, word.size()) != word) return wrong("a word is neither true, false nor null");
  at_ += word.size();
  return true;
}

bool JsonScan::expect(char c) {
  if (next() != c) return wrong(fmt::format("a '{}' is missing", c));
  ++at_;
  return true;
}

void JsonScan::pass_blanks() {
  while (next() == ' ' || next() == '\n' || next() == '\r' || next() == '\t') ++at_;
}

bool JsonScan::pass_digits() {
  const std::size_t begin = at_;
  while (is_digit(next())) ++at_;
  return at_ > begin;
}

bool JsonScan::wrong(std::string_view what) {
  const std::string_view before = text_.substr(0, at_);
  const auto lines = std::count(before.begin(), before.end(), '\n');
  problem_ = fmt::format("not JSON: {} (line {}, column {})", what, lines + 1,
                         at_ - (before.find_last_of('\n') + 1) + 1);
  return false;
}

}  // namespace tidemark
