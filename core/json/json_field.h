// Reading JSON that may hold anything: every value is checked, and what is wrong is said with its place.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "core/result.h"

namespace tidemark {

using Json = nlohmann::json;

// The first thing that was wrong while a document was read.
struct JsonProblems {
  std::string file;  // for messages
  Status status;
};

// A value with its place in the document ("start.seeds[2].radius_mm"). Reading on after something was wrong
// gives defaults: who reads asks once, at the end, whether all was well.
class JsonField {
 public:
  JsonField(const Json* value, std::string place, std::shared_ptr<JsonProblems> problems)
      : value_(value), place_(std::move(place)), problems_(std::move(problems)) {}

  [[nodiscard]] bool has(const char* key) const;  // and it is not null
  [[nodiscard]] JsonField at(const char* key) const;
  [[nodiscard]] JsonField at(std::size_t index) const;
  [[nodiscard]] bool is_text() const { return value_ != nullptr && value_->is_string(); }
  // Notes a problem where an object holds any other name: a misspelt field must not go unnoticed.
  void only(const std::vector<std::string_view>& names) const;
  // Of an array of at most so many.
  [[nodiscard]] std::size_t size(std::size_t most) const;

  [[nodiscard]] double number(double low = std::numeric_limits<double>::lowest(),
                              double high = std::numeric_limits<double>::max()) const;
  [[nodiscard]] std::int64_t integer(std::int64_t low, std::int64_t high) const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string text(std::size_t longest = 4096) const;
  // Which of the words it is.
  [[nodiscard]] std::size_t word(const std::vector<std::string_view>& words) const;
  void must_be(std::string_view word) const { static_cast<void>(this->word({word})); }
  [[nodiscard]] glm::dvec3 vector(double low = std::numeric_limits<double>::lowest(),
                                  double high = std::numeric_limits<double>::max()) const;
  [[nodiscard]] Index3 index(std::int64_t low, std::int64_t high) const;

  // Notes a problem here (ErrorKind::input), unless there was one before.
  void wrong(const std::string& what) const;
  [[nodiscard]] bool good() const { return problems_->status.has_value(); }
  [[nodiscard]] const Status& status() const { return problems_->status; }

 private:
  const Json* value_;  // null: there is none
  std::string place_;
  std::shared_ptr<JsonProblems> problems_;
};

struct JsonLimits {
  std::size_t bytes = std::size_t{64} << 20;
  int depth = 32;
};
// Fails (ErrorKind::input) naming `file` on text that is too large, too deep, or not JSON.
Result<Json> parse_json(std::string_view text, const std::string& file, const JsonLimits& limits = {});

// A document to read from. `json` must outlive it.
JsonField root_of(const Json& json, const std::string& file);

}  // namespace tidemark
