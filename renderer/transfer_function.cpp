#include "renderer/transfer_function.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "renderer/embedded_presets.h"

namespace tidemark {
namespace {

using Json = nlohmann::json;

Result<double> number(const Json& object, const std::string& where, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number() || !std::isfinite(found->get<double>())) {
    return fail(ErrorKind::input, "{}.{}: a number is needed", where, key);
  }
  return found->get<double>();
}

Result<TransferPrimitive> primitive(const Json& object, const std::string& where) {
  if (!object.is_object()) return fail(ErrorKind::input, "{}: an object is needed", where);
  const std::string kind = object.value("kind", Json("")).is_string() ? object.value("kind", "") : "";
  if (kind != "gaussian" && kind != "ramp") {
    return fail(ErrorKind::input, "{}.kind: 'gaussian' or 'ramp' is needed", where);
  }
  const bool gaussian = kind == "gaussian";
  TransferPrimitive result;
  result.kind = gaussian ? TransferPrimitive::Kind::gaussian : TransferPrimitive::Kind::ramp;
  for (const auto& [member, key] : {std::pair{&TransferPrimitive::start, gaussian ? "centre" : "start"},
                                    {&TransferPrimitive::end, gaussian ? "width" : "end"},
                                    {&TransferPrimitive::opacity, "opacity"}}) {
    const auto value = number(object, where, key);
    if (!value) return tl::unexpected<Error>(value.error());
    result.*member = *value;
  }
  if (gaussian ? result.end <= 0.0 : result.end == result.start) {
    return fail(ErrorKind::input, "{}.{}: must be {}", where, gaussian ? "width" : "end",
                gaussian ? "above 0" : "other than the start");
  }
  if (result.opacity < 0.0) return fail(ErrorKind::input, "{}.opacity: must not be negative", where);
  const Json colour = object.value("colour", Json::array());
  if (!colour.is_array() || colour.size() != 3 ||
      !std::all_of(colour.begin(), colour.end(), [](const Json& c) { return c.is_number(); })) {
    return fail(ErrorKind::input, "{}.colour: three numbers from 0 to 1 are needed", where);
  }
  for (int c = 0; c < 3; ++c)
    result.colour[c] = std::clamp(colour[static_cast<std::size_t>(c)].get<float>(), 0.0F, 1.0F);
  return result;
}

}  // namespace

Result<TransferFunction> TransferFunction::parse(std::string_view json) {
  const Json document = Json::parse(json, nullptr, false);
  if (!document.is_object()) return fail(ErrorKind::input, "not a JSON object");
  TransferFunction function;
  if (document.contains("name") && document["name"].is_string()) function.name = document["name"];
  const Json source = document.value("source", Json());
  if (!source.is_array()) return fail(ErrorKind::input, "source: a list is needed");
  if (source.size() > kMostPrimitives) {
    return fail(ErrorKind::input, "source: {} primitives are more than {}", source.size(), kMostPrimitives);
  }
  for (std::size_t i = 0; i < source.size(); ++i) {
    auto one = primitive(source[i], fmt::format("source[{}]", i));
    if (!one) return pass_on(one);
    function.source.push_back(*one);
  }
  return function;
}

Result<TransferFunction> TransferFunction::load(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return fail(ErrorKind::input, "{}: cannot be read", file.string());
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  auto function = parse(text);
  if (!function) return fail(function.error().kind, "{}: {}", file.string(), function.error().message);
  return function;
}

std::vector<std::string> preset_names() {
  std::vector<std::string> names;
  for (const EmbeddedPreset& preset : embedded_presets()) names.emplace_back(preset.name);
  return names;
}

Result<TransferFunction> preset(std::string_view name) {
  for (const EmbeddedPreset& one : embedded_presets()) {
    if (one.name == name) return TransferFunction::parse(one.text);
  }
  return fail(ErrorKind::usage, "the preset '{}' is unknown; there are {}", name,
              fmt::join(preset_names(), ", "));
}

}  // namespace tidemark
