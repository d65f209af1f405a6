#include "imaging/web/json_answer.h"

#include "imaging/web/clean_text.h"

namespace tidemark::imaging {
namespace {

constexpr std::size_t kLongestType = 100;

}  // namespace

Result<std::string> ask_for_json(HttpConnection& connection, const HttpRequest& request) {
  std::string text;
  const auto answer = connection.ask(request, [&](const HttpAnswer&, std::string_view bytes) -> Status {
    text += bytes;
    return {};
  });
  if (!answer) return pass_on(answer);
  if (!answer->is_good()) return tl::unexpected<Error>(connection.error(*answer));
  constexpr int kNoContent = 204;
  if (answer->status == kNoContent) return std::string();
  if (answer->content_type.find("json") == std::string::npos) {
    return fail(ErrorKind::input, "{}: answers with '{}', which is not JSON", connection.peer(),
                clean_text(answer->content_type.substr(0, kLongestType)));
  }
  return text;
}

}  // namespace tidemark::imaging
