// A short lesson about a ball: a prediction with figures, words, a try that goes on, and one that begins
// anew.
#pragma once

namespace tidemark::test {

inline constexpr const char* kBallLesson = R"({
  "format": "tidemark lesson", "version": 1, "title": "A ball & its curvature",
  "study": {"phantom": "sphere"},
  "parameters": {"target": 800, "range": 300, "alpha": 0, "data_term": false},
  "parts": [
    {"title": "Shrinks", "text": "A ball under its curvature.",
     "question": {"text": "What happens?", "choices": ["It shrinks", "It grows"], "right": 1},
     "try": {"steps": 60},
     "measure": [{"figure": "radius_mm", "low": 4.5, "high": 5.2}, {"figure": "steps", "low": 60, "high": 60}],
     "explanation": "Curvature pulls inwards."},
    {"title": "Why", "text": "In your own words.", "question": {"text": "Why does it?"}},
    {"title": "Goes on", "text": "Further.",
     "try": {"goes_on": true, "steps": 40},
     "measure": [{"figure": "steps", "low": 100, "high": 100}],
     "explanation": "And on."},
    {"title": "A wider band", "text": "From the start.",
     "try": {"steps": 20, "parameters": {"band": 5}}}
  ]
})";

}  // namespace tidemark::test
