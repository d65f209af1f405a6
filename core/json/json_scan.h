// A walk over a JSON text by RFC 8259, without recursion. Private to this folder.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/json/json_document.h"

namespace tidemark {

class JsonScan {
 public:
  using Place = JsonDocument::Place;

  // Fills `places` with where each value is. All three must outlive it.
  JsonScan(std::string_view text, const JsonLimits& limits, std::vector<Place>& places)
      : text_(text), limits_(limits), places_(places) {}

  // Whether the text is one value and within the limits; else problem() says why not.
  bool run();
  [[nodiscard]] const std::string& problem() const { return problem_; }

 private:
  bool step();  // to the next value of what is open, or out of it
  bool value();
  bool string();
  bool escape();
  bool character();  // of several bytes
  bool number();
  bool literal(std::string_view word);
  bool expect(char c);
  bool add();

  void pass_blanks();
  bool pass_digits();
  [[nodiscard]] bool ended() const { return at_ == text_.size(); }
  [[nodiscard]] char next() const { return ended() ? '\0' : text_[at_]; }  // no text may hold a zero
  bool wrong(std::string_view what);

  std::string_view text_;
  const JsonLimits& limits_;
  std::vector<Place>& places_;
  std::size_t at_ = 0;
  std::vector<JsonDocument::Number> open_;  // lists and objects
  std::string problem_;
};

}  // namespace tidemark
