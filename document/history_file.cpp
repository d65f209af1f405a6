#include "document/history_file.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "document/curve_json.h"
#include "document/file_limits.h"
#include "document/recipe_json.h"
#include "document/session_contents.h"

namespace tidemark::document {
namespace {

constexpr const char* kHistoryFormat = "tidemark history";
constexpr int kVersion = 1;
constexpr std::size_t kMostPoints = 4'000'000;              // of all curves together
constexpr std::int64_t kMostPages = std::int64_t{1} << 22;  // 8 GB; memory is taken for what is there

// In the order of ChangeKind.
constexpr auto kKinds = std::to_array<std::string_view>(
    {"start",         "paint",       "erase",     "target",     "range",          "smoothing",
     "parameters",    "evolution",   "step back", "restart",    "sweep",          "source",
     "examples",      "constraints", "speed",     "new label",  "label settings", "remove label",
     "import labels", "accept",      "finish",    "label brush"});
static_assert(kKinds.size() == kChangeKinds);

// What a state's own recipe, wanted drive and curve go on from.
struct Base {
  const Recipe& recipe;
  const std::shared_ptr<const Drive>& wanted_drive;
  const Curve& curve;
};

Base base_of(const SessionContents& contents, const SavedState& state) {
  if (!state.parent) return {contents.recipe, contents.wanted_drive, contents.curve};
  const SavedState& parent = contents.history.states[*state.parent];
  return {parent.recipe, parent.wanted_drive, parent.curve};
}

template <class T>
std::size_t common(const std::vector<T>& a, const std::vector<T>& b) {
  return static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin());
}

template <class T>
std::vector<T> behind(const std::vector<T>& all, std::size_t first) {
  return {all.begin() + static_cast<std::ptrdiff_t>(first), all.end()};
}

Json state_json(const SavedState& state, const Base& base, std::size_t phi) {
  Recipe own = state.recipe;
  const std::size_t events = common(base.recipe.events, own.events);
  own.events = behind(own.events, events);
  const bool start = base.recipe.start == own.start;
  if (start) own.start = {};
  const bool drive = base.recipe.drive == own.drive;
  if (drive) own.drive.reset();
  const std::size_t points = common(*base.curve.points(), *state.curve.points());
  Json json{{"change",
             {{"kind", kKinds[static_cast<std::size_t>(state.change.kind)]},
              {"steps", state.change.steps},
              {"name", state.change.name}}},
            {"common_events", events},
            {"same_start", start},
            {"same_drive", drive},
            {"recipe", to_json(own)},
            {"common_points", points},
            {"curve", curve_json(behind(*state.curve.points(), points))},
            {"phi", phi}};
  if (state.parent) json["parent"] = *state.parent;
  if (state.wanted_drive == nullptr) return json;
  if (state.wanted_drive == base.wanted_drive) {
    json["same_wanted_drive"] = true;
  } else {
    json["wanted_drive"] = wanted_drive_json(*state.wanted_drive);
  }
  return json;
}

std::string history_dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string history_text(const SessionContents& contents, const std::vector<std::size_t>& phi_of) {
  const SavedHistory& history = contents.history;
  Json json{{"format", kHistoryFormat}, {"version", kVersion}, {"present", history.present}};
  const Index3 shape = history.states[history.present].phi->layout.page_shape();
  json["page_shape"] = {shape.x, shape.y, shape.z};
  Json states = Json::array();
  for (const SavedState& state : history.states)
    states.push_back(state_json(state, base_of(contents, state), phi_of[states.size()]));
  json["states"] = std::move(states);
  return history_dump(json);
}

// What a part of the text takes of the reader's limits.
struct TextSize {
  std::size_t bytes = 0;
  std::size_t values = 0;
};

TextSize operator+(const TextSize& a, const TextSize& b) {
  return {a.bytes + b.bytes, a.values + b.values};
}

// With a comma, and with a number of phi that is as long as any.
TextSize size_of(const SavedState& state, const Base& base) {
  const std::string text = history_dump(state_json(state, base, SavedHistory::kMostStates));
  const auto json = JsonDocument::parse(text, {}, kHistoryLimits);
  return {text.size() + 1, json ? json->end(0) : kHistoryLimits.values};
}

// For each state whether it is near enough to the present one for a text within the limits.
std::vector<bool> near_enough(const SessionContents& contents, const JsonLimits& limits) {
  const SavedHistory& history = contents.history;
  const Base session{contents.recipe, contents.wanted_drive, contents.curve};
  std::vector<bool> near(history.states.size(), false);
  TextSize first;            // of the state that has no parent in the file
  TextSize others{256, 32};  // beside the states there is less
  for (const auto& [state, from] : outwards(history)) {
    const SavedState& visited = history.states[state];
    if (visited.parent == from) {
      others = others + size_of(visited, base_of(contents, visited));
    } else {
      if (state != from)
        others = others + size_of(history.states[from], base_of(contents, history.states[from]));
      first = size_of(visited, session);
    }
    const TextSize whole = first + others;
    if (state != from && (whole.bytes > limits.bytes || whole.values > limits.values)) break;
    near[state] = true;
  }
  return near;
}

// Reading.

ChangeDescription read_change(const JsonField& field) {
  ChangeDescription change;
  change.kind = static_cast<ChangeKind>(field.at("kind").word({kKinds.begin(), kKinds.end()}));
  change.steps = field.at("steps").integer(0, kMostSteps);
  change.name = field.at("name").text(kLongestDescription);
  return change;
}

Recipe read_own_recipe(const JsonField& field, const Recipe& base) {
  Recipe recipe = read_recipe(field.at("recipe"));
  const auto most = static_cast<std::int64_t>(base.events.size());
  const std::int64_t events = field.at("common_events").integer(0, most);
  if (field.at("same_start").boolean()) recipe.start = base.start;
  if (field.at("same_drive").boolean()) recipe.drive = base.drive;
  if (!field.good()) return recipe;
  if (recipe.source.size != base.source.size) field.at("recipe").wrong("is of another grid");
  recipe.events.insert(recipe.events.begin(), base.events.begin(), base.events.begin() + events);
  const auto earlier = [](const RecipeEvent& a, const RecipeEvent& b) { return a.step < b.step; };
  if (!std::is_sorted(recipe.events.begin(), recipe.events.end(), earlier) ||
      (!recipe.events.empty() && recipe.events.back().step > recipe.steps))
    field.at("common_events").wrong("the events are not in order");
  return recipe;
}

std::shared_ptr<const Drive> read_own_wanted_drive(const JsonField& field, const Recipe& recipe,
                                                   const std::shared_ptr<const Drive>& base) {
  if (field.has("wanted_drive")) return read_wanted_drive(field.at("wanted_drive"), recipe);
  return field.has("same_wanted_drive") && field.at("same_wanted_drive").boolean() ? base : nullptr;
}

Curve read_own_curve(const JsonField& field, const Curve& base) {
  const Curve::Points own = *read_curve(field.at("curve")).points();
  const auto most = static_cast<std::int64_t>(base.points()->size());
  const std::int64_t common = field.at("common_points").integer(0, most);
  if (!field.good()) return {};
  Curve::Points points(base.points()->begin(), base.points()->begin() + common);
  if (!points.empty() && !own.empty() && own.front().step <= points.back().step)
    field.at("common_points").wrong("the points are not in order");
  points.insert(points.end(), own.begin(), own.end());
  return Curve(std::move(points));
}

// Returns for each state which of the file's fields it has.
std::vector<std::size_t> read_states(const JsonField& field, SessionContents& contents) {
  SavedHistory& history = contents.history;
  std::vector<std::size_t> phi_of;
  const std::size_t count = field.size(SavedHistory::kMostStates);
  if (field.good() && count == 0) field.wrong("there is no state");
  std::size_t events = 0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < count && field.good(); ++i) {
    const JsonField one = field.at(i);
    SavedState state;
    if (i > 0)
      state.parent = static_cast<std::size_t>(one.at("parent").integer(0, static_cast<std::int64_t>(i) - 1));
    if (!one.good()) break;
    const Base base = base_of(contents, state);
    state.change = read_change(one.at("change"));
    state.recipe = read_own_recipe(one, base.recipe);
    state.wanted_drive = read_own_wanted_drive(one, state.recipe, base.wanted_drive);
    state.curve = read_own_curve(one, base.curve);
    const std::int64_t phi = one.at("phi").integer(0, static_cast<std::int64_t>(count) - 1);
    phi_of.push_back(static_cast<std::size_t>(phi));
    events += state.recipe.events.size();
    points += state.curve.points()->size();
    if (events > SavedHistory::kMostEvents || points > kMostPoints) one.wrong("there is more than is read");
    history.states.push_back(std::move(state));
  }
  return phi_of;
}

// `phi_of`: for each state, which of the file's fields it has.
Status read_phi(ZipReader& archive, SessionContents& contents, const std::vector<std::size_t>& phi_of,
                const std::string& what) {
  SavedHistory& history = contents.history;
  const solver::Field& present = *contents.phi;
  const std::size_t states = history.states.size();
  const auto length = static_cast<std::size_t>(present.layout.page_count());
  auto tables = archive.read<std::int32_t>(kHistoryTables, states * length);
  if (!tables) return pass_on(tables);
  const std::size_t page_bytes = static_cast<std::size_t>(present.layout.voxels_per_page()) * sizeof(float);
  const std::size_t size = archive.size(kHistoryPages);
  if (size % page_bytes != 0 || size / page_bytes > static_cast<std::size_t>(kMostPages))
    return fail(ErrorKind::input, "{}: {} bytes of pages are no pages", what, size);
  auto reader = FieldsReader::open(present, std::move(*tables), size / page_bytes, what);
  if (!reader) return pass_on(reader);
  TIDEMARK_TRY(archive.unpack(kHistoryPages, size, [&](std::span<const std::uint8_t> piece) -> Status {
    reader->take(std::as_bytes(piece));
    return {};
  }));
  auto fields = reader->fields();
  if (!fields) return pass_on(fields);
  for (std::size_t state = 0; state < states; ++state) history.states[state].phi = (*fields)[phi_of[state]];
  if (!same_pages(*history.states[history.present].phi, present))
    return fail(ErrorKind::input, "{}: its present state is not the session's", what);
  contents.phi = history.states[history.present].phi;  // with which the other states share
  return {};
}

}  // namespace

std::vector<ZipEntry> HistoryEntries::entries() const {
  return {{kHistoryJson, std::as_bytes(std::span(json))},
          phi.tables_entry(kHistoryTables),
          phi.pages_entry(kHistoryPages)};
}

HistoryEntries history_entries(const SessionContents& contents, const JsonLimits& limits) {
  SessionContents written;  // what its states are told apart from
  written.recipe = contents.recipe;
  written.wanted_drive = contents.wanted_drive;
  written.curve = contents.curve;
  HistoryForFile file = for_file(contents.history);
  written.history = std::move(file.history);
  std::string text = history_text(written, file.phi_of);
  if (!JsonDocument::parse(text, {}, limits)) {
    file = for_file(part_of(written.history, near_enough(written, limits)));
    written.history = std::move(file.history);
    text = history_text(written, file.phi_of);
  }
  return {std::move(text), std::move(file.phi)};
}

Status read_history(ZipReader& archive, SessionContents& contents, const std::string& file) {
  if (!archive.has(kHistoryJson)) return {};
  const std::string what = file + ": " + std::string(kHistoryJson);
  const std::size_t size = archive.size(kHistoryJson);
  if (size > kHistoryLimits.bytes) {
    return fail(ErrorKind::input, "{} has {} bytes, more than {} are not read", what, size,
                kHistoryLimits.bytes);
  }
  auto text = archive.read(kHistoryJson, size);
  if (!text) return pass_on(text);
  auto json =
      JsonDocument::parse({reinterpret_cast<const char*>(text->data()), text->size()}, what, kHistoryLimits);
  if (!json) return pass_on(json);
  const JsonField root = root_of(*json, what);
  root.at("format").must_be(kHistoryFormat);
  const JsonField version = root.at("version");
  if (version.integer(0, 1 << 30) != kVersion) version.wrong("this version cannot be read");
  if (root.good() && root.at("page_shape").index(1, 64) != contents.phi->layout.page_shape())
    root.at("page_shape").wrong("is not that of phi");
  std::vector<std::size_t> phi_of;
  if (root.good()) phi_of = read_states(root.at("states"), contents);
  SavedHistory& history = contents.history;
  if (root.good())
    history.present = static_cast<std::size_t>(
        root.at("present").integer(0, static_cast<std::int64_t>(history.states.size()) - 1));
  if (!root.good()) return pass_on(root.status());
  return read_phi(archive, contents, phi_of, what);
}

}  // namespace tidemark::document
