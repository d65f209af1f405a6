#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcxfer.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "core/json/json_field.h"
#include "imaging/dicom/write_dicom_file.h"
#include "imaging/pacs/web/web_services.h"
#include "imaging/web/http_connection.h"
#include "imaging/web/multipart.h"

namespace tidemark::imaging {
namespace {

constexpr std::int64_t kLongestAnswer = std::int64_t{1} << 20;
constexpr const char* kFailedSequence = "00081198";
constexpr const char* kFailureReason = "00081197";
constexpr std::size_t kMostFailures = 1'000;
constexpr std::int64_t kUnknownReason = 0x0110;  // a failure in processing (PS3.4, B.2.3)

// The reason for a failure in the answer (PS3.18, 10.5.3); 0: none is named. Who answers something else by a
// good status has taken the object, too.
std::int64_t reason_in(const std::string& text, const std::string& peer) {
  const auto document = JsonDocument::parse(text, peer, {.bytes = kLongestAnswer});
  if (!document) return 0;
  const JsonField root = root_of(*document, peer);
  if (!root.has(kFailedSequence) || !root.at(kFailedSequence).has("Value")) return 0;
  const JsonField failed = root.at(kFailedSequence).at("Value");
  if (failed.size(kMostFailures) == 0) return 0;
  const JsonField first = failed.at(std::size_t{0});
  if (!first.has(kFailureReason) || !first.at(kFailureReason).has("Value")) return kUnknownReason;
  const JsonField code = first.at(kFailureReason).at("Value").at(std::size_t{0});
  const std::int64_t reason = code.is_number() ? code.integer(0, 0xffff) : 0;
  return reason != 0 ? reason : kUnknownReason;
}

// Whether the file begins as others know it: preamble, "DICM" and group 0002 (PS3.10 7.1).
bool has_header(const ParsedDicom& object) {
  constexpr std::int64_t kPreamble = 128;
  constexpr std::string_view kMark = "DICM";
  std::array<std::uint8_t, kMark.size()> mark{};
  const bool is_marked = object.bytes().read(kPreamble, mark) == mark.size() &&
                         std::equal(mark.begin(), mark.end(), kMark.begin());
  return is_marked && object.checked().dataset > kPreamble + static_cast<std::int64_t>(kMark.size());
}

class WebSender final : public ObjectSender {
 public:
  explicit WebSender(std::unique_ptr<HttpConnection> connection) : connection_(std::move(connection)) {}

  Result<std::string> send(const Outgoing& /*one*/, const CheckedObject& object) override {
    const MultipartObject parts = multipart_object();
    HttpRequest request{"studies", kDicomJson, kLongestAnswer, parts.content_type};
    MemoryBytes before = bytes_of(parts.before);
    MemoryBytes after = bytes_of(parts.after);
    std::string encoded;  // of a file that lacks its header
    if (!has_header(object.parsed)) {
      auto whole = encode_dicom_file(object.parsed.format(),
                                     DcmXfer(object.identity.transfer_syntax.c_str()).getXfer());
      if (!whole) return fmt::format("it cannot be given a file header: {}", whole.error().message);
      encoded = std::move(*whole);
    }
    MemoryBytes with_header = bytes_of(encoded);
    request.body = {&before, encoded.empty() ? &object.parsed.bytes() : &with_header, &after};
    std::string text;
    const auto answer = connection_->ask(request, [&](const HttpAnswer&, std::string_view bytes) -> Status {
      text += bytes;
      return {};
    });
    if (!answer) return pass_on(answer);
    const std::int64_t reason = reason_in(answer->is_good() ? text : answer->refusal, connection_->peer());
    if (reason != 0) return fmt::format("the server refuses it (reason {:04X})", reason);
    if (answer->is_good()) return std::string();
    // What is said of one object is no reason not to try the others.
    for (const int status : {400, 409, 413, 415, 422}) {
      if (answer->status == status) return fmt::format("the server refuses it (HTTP {})", status);
    }
    return tl::unexpected<Error>(connection_->error(*answer));
  }

 private:
  static MemoryBytes bytes_of(const std::string& text) {
    return MemoryBytes({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }

  std::unique_ptr<HttpConnection> connection_;
};

}  // namespace

Result<std::unique_ptr<ObjectSender>> open_web_sender(const PacsServer& server, const std::stop_token& stop) {
  auto connection = open_web(server, stop);
  if (!connection) return pass_on(connection);
  return std::make_unique<WebSender>(std::move(*connection));
}

}  // namespace tidemark::imaging
