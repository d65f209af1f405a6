// Small lessons.
#pragma once

#include <QTest>
#include <nlohmann/json.hpp>

#include "document/lesson.h"

namespace tidemark::test {

// Everything that can be in one.
inline nlohmann::json good_lesson() {
  const nlohmann::json ball{{"centre_mm", {0, 0, 0}}, {"radius_mm", 10}};
  const nlohmann::json small{{"centre_mm", {4, 0, 0}}, {"radius_mm", 2.5}};
  const nlohmann::json start{{"seeds", {ball}}};
  return {{"format", "tidemark lesson"},
          {"version", 1},
          {"title", "Size"},
          {"about", "A ball, \"quoted\", and a Größe."},
          {"author", "A. Lecturer"},
          {"minutes", 12},
          {"study", {{"phantom", "sphere:0"}}},
          {"start", start},
          {"parameters", {{"target", 800}, {"range", 300}, {"alpha", 0.8}, {"band", 3}}},
          {"parts",
           {{{"title", "Read"}, {"text", "One.\n\nTwo."}},
            {{"title", "Stay"},
             {"text", "Nothing moves."},
             {"question", {{"text", "How large?"}, {"choices", {"10 mm", "20 mm", "30 mm"}}, {"right", 1}}},
             {"try", {{"steps", 0}, {"show", {"contours", "truth"}}}},
             {"measure",
              {{{"figure", "radius_mm"}, {"low", 9.9}, {"high", 10.1}},
               {{"figure", "steps"}, {"low", 0}, {"high", 0}}}},
             {"explanation", "It is the seed."}},
            {{"title", "Grow"},
             {"text", "It grows."},
             {"question", {{"text", "Why?"}}},
             {"try",
              {{"goes_on", true},
               {"parameters", {{"alpha", 1}, {"rescale", 0.2}}},
               {"smoothed_mm", 1},
               {"steps", 300},
               {"until_rest", true}}},
             {"measure",
              {{{"figure", "radius_mm"}, {"low", 19.5}, {"high", 20.5}},
               {{"figure", "rests"}, {"low", 1}, {"high", 1}},
               {{"figure", "dice"}, {"low", 0.98}, {"high", 1}}}}},
            {{"title", "Another"},
             {"text", "Elsewhere."},
             {"study", {{"phantom", "dumbbell"}}},
             {"try",
              {{"start",
                {{"from", {{"kind", "threshold"}, {"low", 500}, {"high", 900}}},
                 {"seeds", nlohmann::json::array()},
                 {"erasers", {small}}}},
               {"parameters", {{"band", "default"}}},
               {"steps", 3}}},
             {"measure", {{{"figure", "bodies"}, {"low", 1}, {"high", 1}}}}}}}};
}

inline document::Lesson lesson_of(const nlohmann::json& json) {
  auto lesson = document::Lesson::parse(json.dump(), "good.json");
  if (!lesson) qFatal("%s", lesson.error().message.c_str());
  return std::move(*lesson);
}

// A lesson with that part alone.
inline document::Lesson lesson_of_part(nlohmann::json part) {
  nlohmann::json json = good_lesson();
  part["title"] = "Part";
  part["text"] = "Text.";
  json["parts"] = nlohmann::json::array({std::move(part)});
  return lesson_of(json);
}

}  // namespace tidemark::test
