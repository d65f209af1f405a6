#include "imaging/guard/text_voxels.h"

#include <fstream>
#include <string_view>

#include "core/number_from.h"

namespace tidemark::imaging::files {
namespace {

// Longer than any number that a program would write.
constexpr std::size_t kLongestNumber = 64;

}  // namespace

Status read_text(const PixelLayout& layout, const std::function<Status(std::int64_t, double)>& take) {
  std::ifstream stream(layout.file, std::ios::binary);
  if (!stream.seekg(layout.offset)) {
    return fail(ErrorKind::input, "{}: cannot be read", layout.file.string());
  }
  std::int64_t count = 0;
  std::string word;
  for (bool more = true; more;) {
    const int c = stream.get();
    more = c != std::ifstream::traits_type::eof();
    const bool is_blank = !more || c == ' ' || (c >= '\t' && c <= '\r');
    if (!is_blank && word.size() <= kLongestNumber) word.push_back(static_cast<char>(c));
    if (!is_blank || word.empty()) continue;
    const auto number = number_from<double>(word);
    if (!number) return fail(ErrorKind::input, "{}: voxel {} is not a number", layout.file.string(), count);
    if (count < layout.voxels) {
      TIDEMARK_TRY(take(count, *number));
    }
    ++count;
    word.clear();
  }
  if (count == layout.voxels) return {};
  return fail(ErrorKind::input, "{}: the header says {} voxels, the text has {}", layout.file.string(),
              layout.voxels, count);
}

}  // namespace tidemark::imaging::files
