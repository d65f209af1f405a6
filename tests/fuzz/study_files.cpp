// A recipe, or a session file: as it is when it is a zip archive, else its session.json in an archive of
// ours.
#include <cstdlib>
#include <string_view>

#include "document/recipe.h"
#include "document/session_file.h"
#include "document/zip_archive.h"
#include "tests/fuzz/scratch_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tidemark;
  static fuzz::ScratchFile scratch;
  const std::string_view text(reinterpret_cast<const char*>(bytes), count);
  if (text.starts_with("PK")) {
    static_cast<void>(document::load_session(scratch.write("case.tidemark", bytes, count)));
    return 0;
  }
  // A recipe that was read can be written, and is read again.
  if (const auto recipe = document::Recipe::parse(text, "recipe.json")) {
    const auto again = recipe->to_text();
    if (!again || !document::Recipe::parse(*again, "recipe.json")) std::abort();
  }
  const document::ZipEntry entry{"session.json", std::as_bytes(std::span(bytes, count))};
  const auto file = scratch.write("case.tidemark", bytes, 0);
  if (!document::write_zip(file, {&entry, 1})) std::abort();
  static_cast<void>(document::load_session(file));
  return 0;
}
