#include "renderer/transfer_function.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <tuple>
#include <utility>

#include "renderer/embedded_presets.h"

namespace tidemark {
namespace {

using Json = nlohmann::json;

// [a, b], two finite numbers.
Result<std::pair<double, double>> two_numbers(const Json& list, const std::string& where) {
  const auto finite = [](const Json& n) { return n.is_number() && std::isfinite(n.get<double>()); };
  if (!list.is_array() || list.size() != 2 || !finite(list[0]) || !finite(list[1])) {
    return fail(ErrorKind::input, "{}: two numbers are needed", where);
  }
  return std::pair{list[0].get<double>(), list[1].get<double>()};
}

Result<TransferFactor> read_factor(const Json& primitive, const std::string& of, const char* axis) {
  TransferFactor factor;
  if (!primitive.contains(axis)) return factor;
  const std::string where = fmt::format("{}.{}", of, axis);
  const Json& object = primitive[axis];
  if (!object.is_object() || object.size() != 1) {
    return fail(ErrorKind::input,
                "{}: {{\"gaussian\": [centre, width]}} or {{\"ramp\": [start, end]}} is needed", where);
  }
  const std::string kind = object.begin().key();
  if (kind != "gaussian" && kind != "ramp") {
    return fail(ErrorKind::input, "{}: '{}' is neither gaussian nor ramp", where, kind);
  }
  const auto numbers = two_numbers(object.begin().value(), where + "." + kind);
  if (!numbers) return tl::unexpected<Error>(numbers.error());
  factor.kind = kind == "gaussian" ? TransferFactor::Kind::gaussian : TransferFactor::Kind::ramp;
  std::tie(factor.start, factor.end) = *numbers;
  if (kind == "gaussian" ? factor.end <= 0.0 : factor.end == factor.start) {
    return fail(ErrorKind::input, "{}.{}: the {}", where, kind,
                kind == "gaussian" ? "width must be above 0" : "end must be other than the start");
  }
  return factor;
}

// What primitives of both kinds have in common.
template <class Primitive>
Status read_material(const Json& object, const std::string& where, Primitive& result) {
  const Json opacity = object.value("opacity", Json());
  if (!opacity.is_number() || !std::isfinite(opacity.get<double>())) {
    return fail(ErrorKind::input, "{}.opacity: a number is needed", where);
  }
  result.opacity = opacity.get<double>();
  constexpr double kMostOpacity = 1e6;
  if (result.opacity < 0.0 || result.opacity > kMostOpacity) {
    return fail(ErrorKind::input, "{}.opacity: must be 0 to {}", where, kMostOpacity);
  }
  const Json colour = object.value("colour", Json::array());
  if (!colour.is_array() || colour.size() != 3 ||
      !std::all_of(colour.begin(), colour.end(), [](const Json& c) { return c.is_number(); })) {
    return fail(ErrorKind::input, "{}.colour: three numbers from 0 to 1 are needed", where);
  }
  for (int c = 0; c < 3; ++c)
    result.colour[c] = std::clamp(colour[static_cast<std::size_t>(c)].get<float>(), 0.0F, 1.0F);
  return {};
}

template <class Primitive>
using Axis = std::pair<TransferFactor Primitive::*, const char*>;
template <class Primitive>
using Axes = std::span<const Axis<Primitive>>;

constexpr Axis<SourcePrimitive> kSourceAxes[] = {{&SourcePrimitive::value, "value"},
                                                 {&SourcePrimitive::gradient, "gradient"},
                                                 {&SourcePrimitive::phi, "phi"}};
constexpr Axis<SurfacePrimitive> kSurfaceAxes[] = {{&SurfacePrimitive::intensity, "intensity"},
                                                   {&SurfacePrimitive::distance, "distance"}};

template <class Primitive>
Result<Primitive> read_primitive(const Json& object, const std::string& where, Axes<Primitive> axes) {
  if (!object.is_object()) return fail(ErrorKind::input, "{}: an object is needed", where);
  for (const auto& item : object.items()) {
    const std::string& key = item.key();
    const bool known =
        key == "opacity" || key == "colour" ||
        std::any_of(axes.begin(), axes.end(), [&](const auto& axis) { return key == axis.second; });
    if (!known) return fail(ErrorKind::input, "{}.{}: unknown", where, key);
  }
  Primitive result;
  for (const auto& [member, axis] : axes) {
    const auto factor = read_factor(object, where, axis);
    if (!factor) return tl::unexpected<Error>(factor.error());
    result.*member = *factor;
  }
  TIDEMARK_TRY(read_material(object, where, result));
  return result;
}

template <class Primitive>
Status read_list(const Json& document, const char* name, Axes<Primitive> axes,
                 std::vector<Primitive>& result) {
  const Json list = document.value(name, Json::array());
  if (!list.is_array()) return fail(ErrorKind::input, "{}: a list is needed", name);
  if (list.size() > TransferFunction::kMostPrimitives) {
    return fail(ErrorKind::input, "{}: {} primitives are more than {}", name, list.size(),
                TransferFunction::kMostPrimitives);
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    auto one = read_primitive<Primitive>(list[i], fmt::format("{}[{}]", name, i), axes);
    if (!one) return pass_on(one);
    result.push_back(*one);
  }
  return {};
}

// With their names in the order in which they are written.
using OrderedJson = nlohmann::ordered_json;

template <class Primitive>
OrderedJson written(const Primitive& primitive, Axes<Primitive> axes) {
  OrderedJson object = OrderedJson::object();
  for (const auto& [member, axis] : axes) {
    const TransferFactor& factor = primitive.*member;
    if (factor.kind == TransferFactor::Kind::everything) continue;
    const char* kind = factor.kind == TransferFactor::Kind::gaussian ? "gaussian" : "ramp";
    object[axis][kind] = {factor.start, factor.end};
  }
  object["opacity"] = primitive.opacity;
  for (int c = 0; c < 3; ++c) {
    // The shortest number that is read as this float: 0.1, not 0.10000000149.
    object["colour"].push_back(OrderedJson::parse(fmt::format("{}", primitive.colour[c])));
  }
  return object;
}

// A primitive a line.
template <class Primitive>
std::string written_list(const std::vector<Primitive>& list, Axes<Primitive> axes) {
  std::vector<std::string> lines;
  for (const Primitive& primitive : list) lines.push_back("    " + written(primitive, axes).dump());
  return fmt::format("[\n{}\n  ]", fmt::join(lines, ",\n"));
}

}  // namespace

double TransferFactor::at(double x) const {
  if (kind == Kind::everything) return 1.0;
  const double u = (x - start) / (kind == Kind::gaussian ? end : end - start);
  return kind == Kind::gaussian ? std::exp(-u * u) : std::clamp(u, 0.0, 1.0);
}

double TransferFactor::most(double low, double high) const {
  // A ramp has its greatest value at one of the ends.
  return kind == Kind::gaussian ? at(std::clamp(start, low, high)) : std::max(at(low), at(high));
}

TransferFunction TransferFunction::for_range(double low, double high) const {
  TransferFunction function = *this;
  if (!relative) return function;
  function.relative = false;
  const double extent = high - low;
  const auto spread = [&](TransferFactor& factor, double offset) {
    factor.start = offset + factor.start * extent;
    factor.end =
        factor.kind == TransferFactor::Kind::gaussian ? factor.end * extent : offset + factor.end * extent;
  };
  for (SourcePrimitive& p : function.source) {
    spread(p.value, low);
    spread(p.gradient, 0.0);
  }
  for (SurfacePrimitive& p : function.surface) spread(p.intensity, low);
  return function;
}

bool TransferFunction::source_needs_gradient() const {
  return std::any_of(source.begin(), source.end(), [](const SourcePrimitive& p) {
    return p.gradient.kind != TransferFactor::Kind::everything;
  });
}

bool TransferFunction::source_needs_phi() const {
  return std::any_of(source.begin(), source.end(),
                     [](const SourcePrimitive& p) { return p.phi.kind != TransferFactor::Kind::everything; });
}

double TransferFunction::most_opacity(double low, double high, double low_phi, double high_phi) const {
  double opacity = 0.0;
  for (const SourcePrimitive& p : source) {
    opacity += p.opacity * p.value.most(low, high) * p.phi.most(low_phi, high_phi);
  }
  return opacity;
}

Result<TransferFunction> TransferFunction::parse(std::string_view json) {
  const Json document = Json::parse(json, nullptr, false);
  if (!document.is_object()) return fail(ErrorKind::input, "not a JSON object");
  for (const auto& [key, value] : document.items()) {
    if (key != "name" && key != "relative" && key != "source" && key != "surface") {
      return fail(ErrorKind::input, "{}: unknown", key);
    }
  }
  TransferFunction function;
  if (document.contains("name") && document["name"].is_string()) function.name = document["name"];
  if (document.contains("relative")) {
    if (!document["relative"].is_boolean())
      return fail(ErrorKind::input, "relative: true or false is needed");
    function.relative = document["relative"];
  }
  Status good = read_list<SourcePrimitive>(document, "source", kSourceAxes, function.source);
  if (!good) return pass_on(good);
  good = read_list<SurfacePrimitive>(document, "surface", kSurfaceAxes, function.surface);
  if (!good) return pass_on(good);
  if (function.source.empty() && function.surface.empty()) {
    return fail(ErrorKind::input, "neither 'source' nor 'surface' has primitives");
  }
  return function;
}

Result<TransferFunction> TransferFunction::load(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::error_code ignored;
  if (!stream || !std::filesystem::is_regular_file(file, ignored))
    return fail(ErrorKind::input, "{}: cannot be read", file.string());
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  auto function = parse(text);
  if (!function) return fail(function.error().kind, "{}: {}", file.string(), function.error().message);
  return function;
}

std::string TransferFunction::to_json() const {
  std::string text =
      fmt::format("{{\n  \"name\": {}", Json(name).dump(-1, ' ', false, Json::error_handler_t::replace));
  if (relative) text += ",\n  \"relative\": true";
  if (!source.empty()) text += ",\n  \"source\": " + written_list<SourcePrimitive>(source, kSourceAxes);
  if (!surface.empty()) text += ",\n  \"surface\": " + written_list<SurfacePrimitive>(surface, kSurfaceAxes);
  return text + "\n}\n";
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
