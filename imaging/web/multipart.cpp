#include "imaging/web/multipart.h"

#include <algorithm>
#include <optional>
#include <random>
#include <utility>

namespace tidemark::imaging {
namespace {

constexpr std::size_t kLongestHeaders = 16'384;
constexpr std::size_t kLongestPreamble = 16'384;
constexpr std::size_t kLongestBoundary = 70;  // RFC 2046 section 5.1.1
constexpr std::string_view kLineEnd = "\r\n";

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

// The value of a parameter of a content type, without its quotes.
std::optional<std::string> parameter(std::string_view content_type, std::string_view name) {
  std::string small(content_type);
  std::transform(small.begin(), small.end(), small.begin(), lower);
  bool is_quoted = false;
  for (std::size_t at = 0; at < small.size(); ++at) {
    if (small[at] == '"') is_quoted = !is_quoted;
    if (small[at] != ';' || is_quoted) continue;
    const std::size_t begin = small.find_first_not_of(" \t", at + 1);
    if (begin == std::string::npos || small.compare(begin, name.size(), name) != 0) continue;
    std::size_t value = small.find_first_not_of(" \t", begin + name.size());
    if (value == std::string::npos || small[value] != '=') continue;
    value = small.find_first_not_of(" \t", value + 1);
    if (value == std::string::npos) continue;
    const bool has_quotes = small[value] == '"';
    if (has_quotes) ++value;
    const std::size_t end = small.find_first_of(has_quotes ? "\"" : "; \t", value);
    return std::string(content_type.substr(value, end == std::string::npos ? end : end - value));
  }
  return std::nullopt;
}

tl::unexpected<Error> broken(const char* why) {
  return fail(ErrorKind::input, "answers with parts that cannot be read: {}", why);
}

}  // namespace

MultipartReader::MultipartReader(std::string delimiter, MultipartSink sink)
    : delimiter_(std::move(delimiter)), sink_(std::move(sink)), left_(kLineEnd) {}

Result<MultipartReader> MultipartReader::create(std::string_view content_type, MultipartSink sink) {
  constexpr std::string_view kType = "multipart/";
  const bool has_parts =
      content_type.size() >= kType.size() && std::equal(kType.begin(), kType.end(), content_type.begin(),
                                                        [](char a, char b) { return a == lower(b); });
  const auto boundary = has_parts ? parameter(content_type, "boundary") : std::nullopt;
  if (!boundary || boundary->empty() || boundary->size() > kLongestBoundary) {
    return broken("the answer's type names no boundary");
  }
  return MultipartReader(std::string(kLineEnd) + "--" + *boundary, std::move(sink));
}

Status MultipartReader::read(std::string_view bytes) {
  if (state_ == State::after) return {};
  left_ += bytes;
  for (;;) {
    const auto went_on = step();
    if (!went_on) return pass_on(went_on);
    if (!*went_on) return {};
  }
}

Result<bool> MultipartReader::step() {
  switch (state_) {
    case State::before:
      return pass_over();
    case State::delimiter:
      return read_delimiter();
    case State::headers:
      return read_headers();
    case State::body:
      return read_body();
    default:
      left_.clear();
      return false;
  }
}

Result<bool> MultipartReader::pass_over() {
  const std::size_t at = left_.find(delimiter_);
  if (at == std::string::npos) {
    if (left_.size() > kLongestPreamble) return broken("none begins");
    return false;
  }
  left_.erase(0, at + delimiter_.size());
  state_ = State::delimiter;
  return true;
}

// "--" ends all; otherwise blanks and the line's end.
Result<bool> MultipartReader::read_delimiter() {
  if (left_.size() < 2) return false;
  if (left_.starts_with("--")) {
    state_ = State::after;
    return true;
  }
  const std::size_t end = left_.find_first_not_of(" \t");
  if (end == std::string::npos || end + kLineEnd.size() > left_.size()) {
    if (left_.size() > kLongestHeaders) return broken("a boundary has no end");
    return false;
  }
  if (left_.compare(end, kLineEnd.size(), kLineEnd) != 0) {
    return broken("a boundary is followed by something else");
  }
  left_.erase(0, end);  // the line's end stays: headers may be none
  state_ = State::headers;
  return true;
}

Result<bool> MultipartReader::read_headers() {
  const std::size_t end = left_.find("\r\n\r\n");
  if (end == std::string::npos || end > kLongestHeaders) {
    if (left_.size() > kLongestHeaders) return broken("a part's headers have no end");
    return false;
  }
  left_.erase(0, end + 4);
  state_ = State::body;
  TIDEMARK_TRY(sink_.begin());
  return true;
}

// All but what may be the beginning of a delimiter is the part's.
Result<bool> MultipartReader::read_body() {
  const std::size_t at = left_.find(delimiter_);
  const bool ends = at != std::string::npos;
  const std::size_t sure = ends ? at : left_.size() - std::min(left_.size(), delimiter_.size() - 1);
  if (sure > 0) {
    TIDEMARK_TRY(sink_.take(std::string_view(left_).substr(0, sure)));
  }
  left_.erase(0, ends ? at + delimiter_.size() : sure);
  if (!ends) return false;
  state_ = State::delimiter;
  TIDEMARK_TRY(sink_.end());
  return true;
}

MultipartObject multipart_object() {
  // So long that it is in no object.
  std::random_device random;
  std::string boundary = "tidemark";
  for (int i = 0; i < 6; ++i) boundary += fmt::format("-{:08x}", random());
  return {fmt::format("multipart/related;type=\"application/dicom\";boundary={}", boundary),
          fmt::format("--{}\r\nContent-Type: application/dicom\r\n\r\n", boundary),
          fmt::format("\r\n--{}--\r\n", boundary)};
}

}  // namespace tidemark::imaging
