// A JSON text that was found good (RFC 8259), and where its values lie in it. Eight bytes a value or name,
// and none for texts and numbers, which stay where they are until somebody asks for them: a library that
// makes a tree of them takes up to fifty bytes for one of the text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace tidemark {

struct JsonLimits {
  std::size_t bytes = std::size_t{64} << 20;  // below 4 GiB
  std::size_t values = std::size_t{4} << 20;  // with the names of members: 32 MiB of places
  std::size_t depth = 32;
};

class JsonDocument {
 public:
  // `text` must outlive it. Fails (ErrorKind::input) naming `file` on a text that is too large, too deep, has
  // too many values, or is not JSON. Time and memory are bounded by the limits, not by what the text says.
  static Result<JsonDocument> parse(std::string_view text, const std::string& file,
                                    const JsonLimits& limits = {});

  // A value by its number; 0 is the whole document. One that holds others comes before them; a member's name
  // is a value of its own, before the member's.
  using Number = std::uint32_t;
  enum class Kind { null, boolean, number, text, list, object };
  [[nodiscard]] Kind kind(Number value) const;
  // Of what it holds: it begins at value + 1 and ends here.
  [[nodiscard]] Number end(Number value) const { return places_[value].end; }
  // A number, true, false or null as it is written.
  [[nodiscard]] std::string_view word(Number value) const;
  // A text, or a name, without its quotes and escapes; no more than so many bytes of it and one.
  [[nodiscard]] std::string text(Number value, std::size_t longest) const;
  [[nodiscard]] bool is_text(Number value, std::string_view wanted) const;

 private:
  friend class JsonScan;
  struct Place {
    std::uint32_t begin = 0;  // in the text
    Number end = 0;           // the value after it and all that it holds
  };

  std::string_view text_;
  std::vector<Place> places_;
};

}  // namespace tidemark
