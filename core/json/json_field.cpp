#include "core/json/json_field.h"

#include <algorithm>
#include <cmath>

namespace tidemark {
namespace {

// How deep brackets are nested, without reading what is in them: the parser itself is not to go deep.
int depth_of(std::string_view text) {
  int depth = 0;
  int deepest = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      deepest = std::max(deepest, ++depth);
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return deepest;
}

}  // namespace

Result<Json> parse_json(std::string_view text, const std::string& file, const JsonLimits& limits) {
  if (text.size() > limits.bytes) {
    return fail(ErrorKind::input, "{}: {} bytes, more than {} are not read", file, text.size(), limits.bytes);
  }
  if (const int depth = depth_of(text); depth > limits.depth) {
    return fail(ErrorKind::input, "{}: nested {} deep, more than {} is not read", file, depth, limits.depth);
  }
  try {
    return Json::parse(text);
  } catch (const Json::exception& error) {
    std::string reason = error.what();
    reason.erase(0, reason.find("] ") + 2);
    for (char& c : reason) {
      if (static_cast<unsigned char>(c) < ' ') c = ' ';
    }
    return fail(ErrorKind::input, "{}: not JSON: {}", file, reason);
  }
}

JsonField root_of(const Json& json, const std::string& file) {
  auto problems = std::make_shared<JsonProblems>();
  problems->file = file;
  return {&json, {}, std::move(problems)};
}

void JsonField::wrong(const std::string& what) const {
  if (!good()) return;
  const std::string place = place_.empty() ? "" : place_ + ": ";
  problems_->status = fail(ErrorKind::input, "{}: {}{}", problems_->file, place, what);
}

bool JsonField::has(const char* key) const {
  return value_ != nullptr && value_->is_object() && value_->contains(key) && !value_->at(key).is_null();
}

JsonField JsonField::at(const char* key) const {
  JsonField field(nullptr, place_.empty() ? key : place_ + "." + key, problems_);
  if (value_ == nullptr) return field;
  if (!value_->is_object()) {
    wrong("not an object");
  } else if (!value_->contains(key)) {
    field.wrong("is missing");
  } else {
    field.value_ = &value_->at(key);
  }
  return field;
}

JsonField JsonField::at(std::size_t index) const {
  JsonField field(nullptr, fmt::format("{}[{}]", place_, index), problems_);
  if (value_ == nullptr) return field;
  if (!value_->is_array() || index >= value_->size()) {
    field.wrong("is missing");
  } else {
    field.value_ = &value_->at(index);
  }
  return field;
}

void JsonField::only(const std::vector<std::string_view>& names) const {
  if (value_ == nullptr) return;
  if (!value_->is_object()) return wrong("not an object");
  for (const auto& [name, value] : value_->items()) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    return wrong(fmt::format("'{}' is no field that is known here", name.substr(0, 60)));
  }
}

std::size_t JsonField::size(std::size_t most) const {
  if (value_ == nullptr) return 0;
  if (!value_->is_array()) {
    wrong("not a list");
    return 0;
  }
  if (value_->size() > most) {
    wrong(fmt::format("{} entries, more than {} are not read", value_->size(), most));
    return 0;
  }
  return value_->size();
}

double JsonField::number(double low, double high) const {
  if (value_ == nullptr) return 0.0;
  if (!value_->is_number()) {
    wrong("not a number");
    return 0.0;
  }
  const auto number = value_->get<double>();
  if (std::isfinite(number) && number >= low && number <= high) return number;
  wrong(fmt::format("{} is not within {} to {}", number, low, high));
  return 0.0;
}

std::int64_t JsonField::integer(std::int64_t low, std::int64_t high) const {
  if (value_ == nullptr) return 0;
  if (!value_->is_number_integer()) {
    wrong("not a whole number");
    return low;
  }
  const bool fits =
      !value_->is_number_unsigned() ||
      value_->get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
  const std::int64_t number = fits ? value_->get<std::int64_t>() : high;
  if (fits && number >= low && number <= high) return number;
  wrong(fmt::format("{} is not within {} to {}", value_->dump(), low, high));
  return low;
}

bool JsonField::boolean() const {
  if (value_ == nullptr) return false;
  if (!value_->is_boolean()) wrong("neither true nor false");
  return value_->is_boolean() && value_->get<bool>();
}

std::string JsonField::text(std::size_t longest) const {
  if (value_ == nullptr) return {};
  if (!value_->is_string()) {
    wrong("not a text");
    return {};
  }
  const auto& text = value_->get_ref<const std::string&>();
  if (text.size() <= longest) return text;
  wrong(fmt::format("{} bytes, more than {} are not read", text.size(), longest));
  return {};
}

std::size_t JsonField::word(const std::vector<std::string_view>& words) const {
  if (value_ == nullptr) return 0;
  const std::string found = text();
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (found == words[i]) return i;
  }
  wrong(fmt::format("'{}' is unknown", found.substr(0, 60)));
  return 0;
}

glm::dvec3 JsonField::vector(double low, double high) const {
  glm::dvec3 result(0.0);
  if (value_ == nullptr) return result;
  if (size(3) != 3) wrong("not three numbers");
  for (int axis = 0; axis < 3 && good(); ++axis) {
    result[axis] = at(static_cast<std::size_t>(axis)).number(low, high);
  }
  return result;
}

Index3 JsonField::index(std::int64_t low, std::int64_t high) const {
  Index3 result(low);
  if (value_ == nullptr) return result;
  if (size(3) != 3) wrong("not three whole numbers");
  for (int axis = 0; axis < 3 && good(); ++axis) {
    result[axis] = at(static_cast<std::size_t>(axis)).integer(low, high);
  }
  return result;
}

}  // namespace tidemark
