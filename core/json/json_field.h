// Reading JSON that may hold anything: every value is checked, and an error names the value's place.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/geometry.h"
#include "core/json/json_document.h"
#include "core/result.h"

namespace tidemark {

// The first thing that was wrong while a document was read.
struct JsonProblems {
  std::string file;
  Status status;
};

// A value with its place in the document ("start.seeds[2].radius_mm"). Reading on after something was wrong
// gives defaults: who reads asks once, at the end, whether all was well.
class JsonField {
 public:
  // The whole document, which must outlive it and what comes of it. `file` is for messages; empty: none.
  JsonField(const JsonDocument& document, const std::string& file);

  [[nodiscard]] bool has(const char* key) const;  // and it is not null
  [[nodiscard]] JsonField at(const char* key) const;
  // Of a list. One after the other they are found at once.
  [[nodiscard]] JsonField at(std::size_t index) const;
  [[nodiscard]] bool is_text() const { return is(JsonDocument::Kind::text); }
  [[nodiscard]] bool is_number() const { return is(JsonDocument::Kind::number); }
  [[nodiscard]] bool is_list() const { return is(JsonDocument::Kind::list); }
  // Notes a problem where an object holds any other name: a misspelt field must not go unnoticed.
  void only(const std::vector<std::string_view>& names) const;
  // Of the members of an object of at most so many, each at most 255 bytes long.
  [[nodiscard]] std::vector<std::string> names(std::size_t most) const;
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
  using Number = JsonDocument::Number;

  JsonField(const JsonField& outer, std::string place)
      : document_(outer.document_), place_(std::move(place)), problems_(outer.problems_) {}
  [[nodiscard]] bool is(JsonDocument::Kind kind) const { return value_ && document_->kind(*value_) == kind; }
  [[nodiscard]] std::optional<Number> member(std::string_view key) const;
  // A problem, unless it is of that kind.
  [[nodiscard]] bool must(JsonDocument::Kind kind, const char* otherwise) const;

  // An entry of a list, and where it is.
  struct Entry {
    std::size_t index = 0;
    Number value = 0;
  };

  const JsonDocument* document_;
  std::optional<Number> value_ = {};  // nothing: there is none
  std::string place_;
  std::shared_ptr<JsonProblems> problems_;
  mutable std::optional<Entry> last_ = {};  // that was asked for
};

// A document to read from. It must outlive the field.
inline JsonField root_of(const JsonDocument& document, const std::string& file) {
  return {document, file};
}

}  // namespace tidemark
