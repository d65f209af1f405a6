// A body of several parts: whole and in pieces it has the same parts, or is refused.
#include "imaging/web/multipart.h"

#include <cstdint>
#include <cstdlib>
#include <vector>

namespace {

using namespace tidemark;

struct Parts {
  std::vector<std::string> begun;
  std::size_t ended = 0;
  bool is_good = false;
  bool is_complete = false;

  bool operator==(const Parts&) const = default;
};

Parts parts_of(std::string_view body, std::size_t piece) {
  Parts parts;
  auto reader = imaging::MultipartReader::create("multipart/related; boundary=x",
                                                 {[&]() -> Status {
                                                    parts.begun.emplace_back();
                                                    return {};
                                                  },
                                                  [&](std::string_view bytes) -> Status {
                                                    parts.begun.back() += bytes;
                                                    return {};
                                                  },
                                                  [&]() -> Status {
                                                    ++parts.ended;
                                                    return {};
                                                  }});
  parts.is_good = reader.has_value();
  for (std::size_t at = 0; parts.is_good && at < body.size(); at += piece) {
    parts.is_good = reader->read(body.substr(at, piece)).has_value();
  }
  parts.is_complete = reader->is_complete();
  // The last may not have come whole: how much of it was told depends on the pieces.
  if (parts.ended < parts.begun.size()) parts.begun.resize(parts.ended);
  return parts;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t count) {
  const std::string_view body(reinterpret_cast<const char*>(bytes), count);
  // Limits of headers are met sooner by larger pieces.
  constexpr std::size_t kBelowLimits = 8192;
  if (count > kBelowLimits) {
    static_cast<void>(parts_of(body, 1'000));
    return 0;
  }
  if (!(parts_of(body, count) == parts_of(body, 1)) || !(parts_of(body, 7) == parts_of(body, 1)))
    std::abort();
  return 0;
}
