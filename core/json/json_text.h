// The text of JSON that is written to a file.
#pragma once

#include <string>

namespace tidemark {

// Of nlohmann::json or ordered_json, with `indent` blanks a level and a line's end. JSON is UTF-8: bytes that
// are not are replaced.
template <class Json>
std::string json_text(const Json& json, int indent = 2) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tidemark
