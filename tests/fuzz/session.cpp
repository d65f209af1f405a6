// A session file: as it is when it is a zip archive, else its session.json in an archive of ours.
#include "document/session_file.h"

#include <zlib.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "tests/fuzz/scratch_file.h"

namespace {

std::string little(std::uint64_t number, int bytes) {
  std::string text;
  for (; bytes > 0; --bytes, number >>= 8U) text += static_cast<char>(number & 0xffU);
  return text;
}

// An archive of one entry that is stored. A library would write it to a file, take it back and compress it,
// which takes longer than reading it.
std::string archive_of(std::string_view name, std::string_view text) {
  const auto checksum = crc32(0, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
  const std::string fixed = little(20, 2) + little(0, 8) + little(checksum, 4) + little(text.size(), 4) +
                            little(text.size(), 4) + little(name.size(), 2) + little(0, 2);
  std::string archive = "PK\3\4" + fixed;
  archive.append(name).append(text);
  const std::string record = "PK\1\2" + little(20, 2) + fixed + little(0, 14) + std::string(name);
  const std::string end = "PK\5\6" + little(0, 4) + little(1, 2) + little(1, 2) + little(record.size(), 4) +
                          little(archive.size(), 4) + little(0, 2);
  return archive + record + end;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  using namespace tidemark;
  static fuzz::ScratchFile scratch;
  std::string text(reinterpret_cast<const char*>(bytes), count);
  if (!text.starts_with("PK")) text = archive_of("session.json", text);
  const auto file =
      scratch.write("case.tidemark", reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  static_cast<void>(document::load_session(file));
  return 0;
}
