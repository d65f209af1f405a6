// A lesson. One that was read can be written, and is read again.
#include "document/lesson.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using tidemark::document::Lesson;
  const std::string_view text(reinterpret_cast<const char*>(bytes), count);
  if (const auto lesson = Lesson::parse(text, "lesson.json")) {
    const auto again = lesson->to_text();
    if (!again || Lesson::parse(*again, "lesson.json")->to_text().value() != *again) std::abort();
  }
  return 0;
}
