// JSON to be written. JSON that is read is a JsonDocument.
#pragma once

#include <nlohmann/json.hpp>

namespace tidemark {

using Json = nlohmann::json;

}  // namespace tidemark
