// A recipe. One that was read can be written, and is read again.
#include "document/recipe.h"

#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using tidemark::document::Recipe;
  const std::string_view text(reinterpret_cast<const char*>(bytes), count);
  if (const auto recipe = Recipe::parse(text, "recipe.json")) {
    const auto again = recipe->to_text();
    if (!again || !Recipe::parse(*again, "recipe.json")) std::abort();
  }
  return 0;
}
