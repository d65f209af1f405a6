// Parameters as JSON: all of them, or those that differ from others.
#include <cmath>
#include <limits>

#include "document/recipe_json.h"

namespace tidemark::document {
namespace {

constexpr const char* kDefault = "default";  // the band or w that follows from the study

std::optional<double> read_optional(const JsonField& field, const char* key) {
  if (!field.has(key)) return std::nullopt;
  return field.at(key).number();
}

}  // namespace

Json to_json(const solver::Parameters& parameters) {
  Json json;
  json["target"] = parameters.target;
  json["range"] = parameters.range;
  json["alpha"] = parameters.alpha;
  if (parameters.band)
    json["band"] = std::isinf(*parameters.band) ? Json("infinite") : Json(*parameters.band);
  if (parameters.rescale) json["rescale"] = *parameters.rescale;
  json["target_gradient"] = parameters.target_gradient;
  json["scheme"] = parameters.scheme == solver::Scheme::split ? "split" : "paper";
  json["data"] = parameters.data_form == solver::DataForm::clamped ? "clamped" : "raw";
  json["data_term"] = parameters.data_term;
  json["curvature_term"] = parameters.curvature_term;
  json["rescaling_term"] = parameters.rescaling_term;
  json["time_step_factor"] = parameters.time_step_factor;
  return json;
}

namespace {

solver::Parameters read_onto(const solver::Parameters& base, const JsonField& field, bool all) {
  solver::Parameters parameters = base;
  const auto given = [&](const char* key) { return all || field.has(key); };
  const auto number = [&](const char* key, double& value) {
    if (given(key)) value = field.at(key).number();
  };
  const auto flag = [&](const char* key, bool& value) {
    if (given(key)) value = field.at(key).boolean();
  };
  number("target", parameters.target);
  number("range", parameters.range);
  number("alpha", parameters.alpha);
  // What `base` sets is taken back by a word.
  const auto is_default = [&](const char* key) {
    return !all && field.has(key) && field.at(key).is_text() && field.at(key).text() == kDefault;
  };
  if (is_default("band")) {
    parameters.band.reset();
  } else if (field.has("band") && field.at("band").is_text()) {
    field.at("band").must_be("infinite");
    parameters.band = std::numeric_limits<double>::infinity();
  } else if (given("band")) {
    parameters.band = read_optional(field, "band");
  }
  if (is_default("rescale")) {
    parameters.rescale.reset();
  } else if (given("rescale")) {
    parameters.rescale = read_optional(field, "rescale");
  }
  number("target_gradient", parameters.target_gradient);
  if (given("scheme")) {
    parameters.scheme =
        field.at("scheme").word({"split", "paper"}) == 0 ? solver::Scheme::split : solver::Scheme::paper;
  }
  if (given("data")) {
    parameters.data_form =
        field.at("data").word({"clamped", "raw"}) == 0 ? solver::DataForm::clamped : solver::DataForm::raw;
  }
  flag("data_term", parameters.data_term);
  flag("curvature_term", parameters.curvature_term);
  flag("rescaling_term", parameters.rescaling_term);
  number("time_step_factor", parameters.time_step_factor);
  if (!field.good()) return {};
  if (const Status valid = check(parameters); !valid) field.wrong(valid.error().message);
  return parameters;
}

}  // namespace

solver::Parameters read_parameters(const JsonField& field) {
  return read_onto({}, field, true);
}

solver::Parameters read_changed_parameters(const JsonField& field, const solver::Parameters& base) {
  field.only({"target", "range", "alpha", "band", "rescale", "target_gradient", "scheme", "data", "data_term",
              "curvature_term", "rescaling_term", "time_step_factor"});
  return read_onto(base, field, false);
}

Json changed_parameters(const solver::Parameters& parameters, const solver::Parameters& base) {
  const Json all = to_json(parameters);
  const Json before = to_json(base);
  Json changed = Json::object();
  for (const auto& [key, value] : all.items()) {
    if (!before.contains(key) || before[key] != value) changed[key] = value;
  }
  for (const auto& [key, value] : before.items()) {
    if (!all.contains(key)) changed[key] = kDefault;
  }
  return changed;
}

}  // namespace tidemark::document
