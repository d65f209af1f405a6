#include "renderer/transfer_function.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/json/json.h"
#include "core/json/json_field.h"
#include "core/text_file.h"
#include "renderer/embedded_presets.h"

namespace tidemark::renderer {
namespace {

constexpr JsonLimits kLimits{.bytes = std::size_t{1} << 20, .values = 10'000, .depth = 8};

TransferFactor read_factor(const JsonField& primitive, const char* axis) {
  TransferFactor factor;
  if (!primitive.has(axis)) return factor;
  const JsonField field = primitive.at(axis);
  field.only({"gaussian", "ramp"});
  const bool is_gaussian = field.has("gaussian");
  if (is_gaussian == field.has("ramp")) {
    field.wrong("{\"gaussian\": [centre, width]} or {\"ramp\": [start, end]} is needed");
    return factor;
  }
  const JsonField numbers = field.at(is_gaussian ? "gaussian" : "ramp");
  if (numbers.size(2) != 2) numbers.wrong("two numbers are needed");
  if (!field.good()) return factor;
  factor.kind = is_gaussian ? TransferFactor::Kind::gaussian : TransferFactor::Kind::ramp;
  factor.start = numbers.at(std::size_t{0}).number();
  factor.end = numbers.at(std::size_t{1}).number();
  if (is_gaussian && factor.end <= 0.0) numbers.wrong("the width must be above 0");
  if (!is_gaussian && factor.end == factor.start) numbers.wrong("the end must be other than the start");
  return factor;
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
Primitive read_primitive(const JsonField& field, Axes<Primitive> axes) {
  constexpr double kMostOpacity = 1e6;
  std::vector<std::string_view> names{"opacity", "colour"};
  for (const auto& [member, axis] : axes) names.emplace_back(axis);
  field.only(names);
  Primitive result;
  for (const auto& [member, axis] : axes) result.*member = read_factor(field, axis);
  result.opacity = field.at("opacity").number(0.0, kMostOpacity);
  const glm::dvec3 colour = field.at("colour").vector();
  for (int c = 0; c < 3; ++c) result.colour[c] = static_cast<float>(std::clamp(colour[c], 0.0, 1.0));
  return result;
}

template <class Primitive>
std::vector<Primitive> read_list(const JsonField& document, const char* name, Axes<Primitive> axes) {
  std::vector<Primitive> list;
  if (!document.has(name)) return list;
  const JsonField field = document.at(name);
  const std::size_t count = field.size(TransferFunction::kMostPrimitives);
  for (std::size_t i = 0; i < count && field.good(); ++i) {
    list.push_back(read_primitive<Primitive>(field.at(i), axes));
  }
  return list;
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
  const double extent = high > low ? high - low : 1.0;  // nearly all values may be the same
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

Result<TransferFunction> TransferFunction::parse(std::string_view json, const std::string& file) {
  const auto document = JsonDocument::parse(json, file, kLimits);
  if (!document) return pass_on(document);
  const JsonField root = root_of(*document, file);
  root.only({"name", "relative", "source", "surface"});
  TransferFunction function;
  if (root.has("name")) function.name = root.at("name").text();
  if (root.has("relative")) function.relative = root.at("relative").boolean();
  function.source = read_list<SourcePrimitive>(root, "source", kSourceAxes);
  function.surface = read_list<SurfacePrimitive>(root, "surface", kSurfaceAxes);
  if (root.good() && function.source.empty() && function.surface.empty()) {
    root.wrong("neither 'source' nor 'surface' has primitives");
  }
  if (!root.good()) return pass_on(root.status());
  return function;
}

Result<TransferFunction> TransferFunction::load(const std::filesystem::path& file) {
  const auto text = read_text_file(file, kLimits.bytes);
  if (!text) return pass_on(text);
  return parse(*text, file.string());
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

}  // namespace tidemark::renderer
