#include "core/json/json_field.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace tidemark {
namespace {

using Kind = JsonDocument::Kind;

constexpr std::size_t kLongestShown = 60;  // in messages
constexpr std::size_t kLongestName = 255;  // of a member whose name is asked for

// Beyond the range of double it is infinite, or 0 when it is too small for that.
double to_double(std::string_view word) {
  double number = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc::result_out_of_range) return number;
  const bool is_small = word.find("e-") != std::string_view::npos ||
                        word.find("E-") != std::string_view::npos || word.starts_with("0.") ||
                        word.starts_with("-0.");
  return is_small ? 0.0 : std::numeric_limits<double>::infinity();
}

}  // namespace

JsonField::JsonField(const JsonDocument& document, const std::string& file)
    : document_(&document), value_(0), problems_(std::make_shared<JsonProblems>()) {
  problems_->file = file;
}

void JsonField::wrong(const std::string& what) const {
  if (!good()) return;
  std::string message = what;
  for (const std::string& before : {place_, problems_->file}) {
    if (!before.empty()) message = before + ": " + message;
  }
  problems_->status = fail(ErrorKind::input, "{}", message);
}

bool JsonField::must(Kind kind, const char* otherwise) const {
  if (!value_) return false;
  if (is(kind)) return true;
  wrong(otherwise);
  return false;
}

// Of members of the same name it is the last one, as most programs read it.
std::optional<JsonField::Number> JsonField::member(std::string_view key) const {
  std::optional<Number> found;
  for (Number name = *value_ + 1; name < document_->end(*value_); name = document_->end(name + 1)) {
    if (document_->is_text(name, key)) found = name + 1;
  }
  return found;
}

bool JsonField::has(const char* key) const {
  if (!is(Kind::object)) return false;
  const auto found = member(key);
  return found && document_->kind(*found) != Kind::null;
}

JsonField JsonField::at(const char* key) const {
  JsonField field(*this, place_.empty() ? key : place_ + "." + key);
  if (!must(Kind::object, "not an object")) return field;
  field.value_ = member(key);
  if (!field.value_) field.wrong("is missing");
  return field;
}

JsonField JsonField::at(std::size_t index) const {
  JsonField field(*this, fmt::format("{}[{}]", place_, index));
  if (!value_) return field;
  Entry entry{0, *value_ + 1};
  if (last_ && last_->index <= index) entry = *last_;
  const Number end = is(Kind::list) ? document_->end(*value_) : 0;
  for (; entry.index < index && entry.value < end; ++entry.index) entry.value = document_->end(entry.value);
  if (entry.value >= end) {
    field.wrong("is missing");
    return field;
  }
  field.value_ = entry.value;
  last_ = entry;
  return field;
}

void JsonField::only(const std::vector<std::string_view>& names) const {
  if (!must(Kind::object, "not an object")) return;
  for (Number name = *value_ + 1; name < document_->end(*value_); name = document_->end(name + 1)) {
    const auto is_this = [&](std::string_view one) { return document_->is_text(name, one); };
    if (std::any_of(names.begin(), names.end(), is_this)) continue;
    return wrong(fmt::format("'{}' is no field that is known here", document_->text(name, kLongestShown)));
  }
}

std::vector<std::string> JsonField::names(std::size_t most) const {
  std::vector<std::string> all;
  if (!must(Kind::object, "not an object")) return all;
  for (Number name = *value_ + 1; name < document_->end(*value_); name = document_->end(name + 1)) {
    all.push_back(document_->text(name, kLongestName));
    if (all.back().size() > kLongestName) {
      wrong(fmt::format("a name has more than {} bytes", kLongestName));
      return {};
    }
    if (all.size() <= most) continue;
    wrong(fmt::format("more than {} entries are not read", most));
    return {};
  }
  return all;
}

std::size_t JsonField::size(std::size_t most) const {
  if (!must(Kind::list, "not a list")) return 0;
  std::size_t count = 0;
  for (Number entry = *value_ + 1; entry < document_->end(*value_); entry = document_->end(entry)) {
    if (++count <= most) continue;
    wrong(fmt::format("more than {} entries are not read", most));
    return 0;
  }
  return count;
}

double JsonField::number(double low, double high) const {
  if (!must(Kind::number, "not a number")) return 0.0;
  const double number = to_double(document_->word(*value_));
  if (std::isfinite(number) && number >= low && number <= high) return number;
  wrong(fmt::format("{} is not within {} to {}", number, low, high));
  return 0.0;
}

std::int64_t JsonField::integer(std::int64_t low, std::int64_t high) const {
  if (!value_) return 0;
  const std::string_view word = is(Kind::number) ? document_->word(*value_) : std::string_view();
  if (word.empty() || word.find_first_of(".eE") != std::string_view::npos) {
    wrong("not a whole number");
    return low;
  }
  std::int64_t number = 0;
  const bool fits = std::from_chars(word.data(), word.data() + word.size(), number).ec == std::errc();
  if (fits && number >= low && number <= high) return number;
  wrong(fmt::format("{} is not within {} to {}", word.substr(0, kLongestShown), low, high));
  return low;
}

bool JsonField::boolean() const {
  return must(Kind::boolean, "neither true nor false") && document_->word(*value_) == "true";
}

std::string JsonField::text(std::size_t longest) const {
  if (!must(Kind::text, "not a text")) return {};
  std::string text = document_->text(*value_, longest);
  if (text.size() <= longest) return text;
  wrong(fmt::format("more than {} bytes are not read", longest));
  return {};
}

std::size_t JsonField::word(const std::vector<std::string_view>& words) const {
  if (!value_) return 0;
  const std::string found = text();
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (found == words[i]) return i;
  }
  wrong(fmt::format("'{}' is unknown", found.substr(0, kLongestShown)));
  return 0;
}

glm::dvec3 JsonField::vector(double low, double high) const {
  glm::dvec3 result(0.0);
  if (!value_) return result;
  if (size(3) != 3) wrong("not three numbers");
  for (int axis = 0; axis < 3 && good(); ++axis) {
    result[axis] = at(static_cast<std::size_t>(axis)).number(low, high);
  }
  return result;
}

Index3 JsonField::index(std::int64_t low, std::int64_t high) const {
  Index3 result(low);
  if (!value_) return result;
  if (size(3) != 3) wrong("not three whole numbers");
  for (int axis = 0; axis < 3 && good(); ++axis) {
    result[axis] = at(static_cast<std::size_t>(axis)).integer(low, high);
  }
  return result;
}

}  // namespace tidemark
