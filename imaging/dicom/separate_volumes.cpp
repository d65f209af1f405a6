#include "imaging/dicom/separate_volumes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "imaging/dicom/same_slices.h"

namespace tidemark::imaging {
namespace {

// The value of an attribute for a slice: numbers, or text. Keys have the order of the listed volumes.
using Key = std::pair<std::vector<double>, std::string>;
using Classes = std::map<Key, SliceRefs>;

// The slices at each position along their normal, in order of position.
std::vector<SliceRefs> by_position(const SliceRefs& slices) {
  const auto& [row, column] = *slices.front()->orientation;
  const glm::dvec3 normal = glm::cross(row, column);
  const auto along = [&](const SliceHeader* slice) { return glm::dot(*slice->position_mm, normal); };
  SliceRefs sorted = slices;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto* a, const auto* b) { return along(a) < along(b); });
  std::vector<SliceRefs> places;
  for (const SliceHeader* slice : sorted) {
    if (places.empty() || !is_same_place(along(slice) - along(places.back().back()))) places.emplace_back();
    places.back().push_back(slice);
  }
  return places;
}

std::size_t most_at_one_place(const std::vector<SliceRefs>& places) {
  const auto most = std::max_element(places.begin(), places.end(),
                                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
  return most->size();
}

Classes classify(const SliceRefs& slices, const std::function<Key(const SliceHeader&)>& key) {
  Classes classes;
  for (const SliceHeader* slice : slices) classes[key(*slice)].push_back(slice);
  return classes;
}

// Of names or kinds, of which each makes a volume, or several volumes that another attribute tells apart.
struct KindAttribute {
  Key (*key)(const SliceHeader&);
  std::string (*label)(const Key&, const Classes&);
  std::size_t most;  // classes; where there are more, the attribute means something else
};

constexpr double kAbsent = -1.0;

std::vector<std::string> values_of(const std::string& text) {
  std::vector<std::string> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('\\', begin), text.size());
    values.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return values;
}

std::string name_of_type(const std::string& value) {
  static const std::map<std::string, std::string> kNames{
      {"M", "magnitude"}, {"MAGNITUDE", "magnitude"}, {"P", "phase"},     {"PHASE", "phase"},
      {"R", "real"},      {"REAL", "real"},           {"I", "imaginary"}, {"IMAGINARY", "imaginary"}};
  const auto known = kNames.find(value);
  return known != kNames.end() ? known->second : value;
}

// The values that not all types have.
std::string label_of_type(const Key& key, const Classes& classes) {
  std::string label;
  std::set<std::string> named;
  for (const std::string& value : values_of(key.second)) {
    const bool has_every = std::all_of(classes.begin(), classes.end(), [&](const auto& other) {
      const auto values = values_of(other.first.second);
      return std::find(values.begin(), values.end(), value) != values.end();
    });
    const std::string name = name_of_type(value);
    if (!has_every && named.insert(name).second) label += (label.empty() ? "" : " ") + name;
  }
  if (key.second.empty()) return "without type";
  return label.empty() ? "type " + key.second : label;
}

std::string label_of_echo(const Key& key, const Classes&) {
  const std::string echo = key.first[0] == kAbsent ? "" : fmt::format("echo {:g}", key.first[0]);
  return join_labels(echo, key.first[1] == kAbsent ? "" : fmt::format("TE {:g} ms", key.first[1]));
}

// Of an image without diffusion the direction means nothing.
Key diffusion_of(const SliceHeader& slice) {
  const SliceTraits& traits = slice.traits;
  Key key{{traits.b_value.value_or(kAbsent)}, {}};
  const auto rounded = [](double part) { return std::round(part * 1000.0) / 1000.0 + 0.0; };
  if (traits.gradient && key.first[0] > 0.0) {
    for (int axis = 0; axis < 3; ++axis) key.first.push_back(rounded((*traits.gradient)[axis]));
  }
  return key;
}

std::string label_of_diffusion(const Key& key, const Classes& classes) {
  if (key.first[0] == kAbsent) return "without b-value";
  const auto same_b = std::count_if(classes.begin(), classes.end(),
                                    [&](const auto& other) { return other.first.first[0] == key.first[0]; });
  if (same_b == 1) return fmt::format("b {:g}", key.first[0]);
  if (key.first.size() < 4) return fmt::format("b {:g} without direction", key.first[0]);
  return fmt::format("b {:g}, direction ({:.2f}, {:.2f}, {:.2f})", key.first[0], key.first[1], key.first[2],
                     key.first[3]);
}

constexpr std::array kKinds{
    KindAttribute{[](const SliceHeader& s) {
                    return Key{{s.traits.series_number.value_or(kAbsent)}, {}};
                  },
                  [](const Key& key, const Classes&) {
                    return key.first[0] == kAbsent ? std::string("without series number")
                                                   : fmt::format("series number {:g}", key.first[0]);
                  },
                  256},
    KindAttribute{[](const SliceHeader& s) {
                    return Key{{}, s.traits.image_type};
                  },
                  label_of_type, 64},
    KindAttribute{
        [](const SliceHeader& s) {
          return Key{{s.traits.echo_number.value_or(kAbsent), s.traits.echo_time_ms.value_or(kAbsent)}, {}};
        },
        label_of_echo, 256},
    KindAttribute{diffusion_of, label_of_diffusion, 4096},
};

// Whether the classes are volumes, or sets of them: together they have no more images at a place than there
// were. Images alone of their kind do not count.
bool are_volumes(const Classes& classes, std::size_t most_classes, std::size_t most) {
  if (classes.size() > most_classes) return false;
  std::size_t volumes = 0;
  for (const auto& [key, slices] : classes) {
    const auto places = by_position(slices);
    if (places.size() > 1) volumes += most_at_one_place(places);
  }
  return classes.size() > 1 && volumes > 0 && volumes <= most;
}

// Of numbers that grow from volume to volume.
struct OrderAttribute {
  const char* word;
  std::optional<double> (*value)(const SliceHeader&);
};

// After all frames of the instances before.
std::optional<double> place_in_series(const SliceHeader& slice) {
  constexpr double kMostFrames = 65536.0;
  if (!slice.traits.instance) return std::nullopt;
  return *slice.traits.instance * kMostFrames + static_cast<double>(slice.frame);
}

constexpr std::array kOrders{
    OrderAttribute{"time", [](const SliceHeader& s) { return s.traits.temporal_position; }},
    OrderAttribute{"trigger time", [](const SliceHeader& s) { return s.traits.trigger_time_ms; }},
    OrderAttribute{"acquisition", [](const SliceHeader& s) { return s.traits.acquisition; }},
    OrderAttribute{"time", [](const SliceHeader& s) { return s.traits.acquired_at; }},
    OrderAttribute{"time", [](const SliceHeader& s) { return s.traits.made_at; }},
    OrderAttribute{"volume", place_in_series},
};

std::vector<LabelledSlices> numbered(const char* word, std::vector<SliceRefs> volumes) {
  std::vector<LabelledSlices> result;
  for (SliceRefs& slices : volumes) {
    result.push_back(
        {fmt::format("{} {} of {}", word, result.size() + 1, volumes.size()), std::move(slices)});
  }
  return result;
}

// The same number in all slices of a volume, or else the first, second and so on at each position. None when
// the numbers tell no volumes apart.
std::vector<LabelledSlices> in_order(const OrderAttribute& attribute, const SliceRefs& slices,
                                     std::vector<SliceRefs> places, std::size_t most) {
  if (std::any_of(slices.begin(), slices.end(), [&](const auto* s) { return !attribute.value(*s); }))
    return {};
  const Classes classes = classify(slices, [&](const SliceHeader& s) {
    return Key{{*attribute.value(s)}, {}};
  });
  std::vector<SliceRefs> volumes;
  for (const auto& [key, members] : classes) volumes.push_back(members);
  const bool is_one_a_volume =
      volumes.size() == most && std::all_of(volumes.begin(), volumes.end(), [](const SliceRefs& members) {
        return most_at_one_place(by_position(members)) == 1;
      });
  if (is_one_a_volume) return numbered(attribute.word, std::move(volumes));

  volumes.assign(most, {});
  const auto before = [&](const auto* a, const auto* b) { return attribute.value(*a) < attribute.value(*b); };
  for (SliceRefs& place : places) {
    std::sort(place.begin(), place.end(), before);
    const bool are_distinct =
        std::adjacent_find(place.begin(), place.end(),
                           [&](const auto* a, const auto* b) { return !before(a, b); }) == place.end();
    if (place.size() != most || !are_distinct) return {};
    for (std::size_t n = 0; n < most; ++n) volumes[n].push_back(place[n]);
  }
  return numbered(attribute.word, std::move(volumes));
}

// Attributes of kinds from number `kind` on.
std::vector<LabelledSlices> separate(const SliceRefs& slices, std::size_t kind) {
  const auto places = by_position(slices);
  const std::size_t most = most_at_one_place(places);
  if (most == 1 || places.size() == 1) return {{"", slices}};
  for (; kind < kKinds.size(); ++kind) {
    const Classes classes = classify(slices, kKinds[kind].key);
    if (!are_volumes(classes, kKinds[kind].most, most)) continue;
    std::vector<LabelledSlices> result;
    for (const auto& [key, members] : classes) {
      const std::string label = kKinds[kind].label(key, classes);
      for (LabelledSlices& one : separate(members, kind + 1)) {
        result.push_back({join_labels(label, one.label), std::move(one.slices)});
      }
    }
    return result;
  }
  for (const OrderAttribute& attribute : kOrders) {
    if (auto volumes = in_order(attribute, slices, places, most); !volumes.empty()) return volumes;
  }
  return {{"", slices}};
}

}  // namespace

std::string join_labels(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + ", " + b;
}

std::vector<LabelledSlices> separate_volumes(const SliceRefs& slices) {
  return separate(slices, 0);
}

}  // namespace tidemark::imaging
