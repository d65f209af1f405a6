// Recipes written, read again and replayed.
#pragma once

#include "document/evolution.h"
#include "tests/document/cases.h"

namespace tidemark::test {

inline document::Recipe again(const document::Recipe& recipe) {
  const auto text = recipe.to_text();
  if (!text) qFatal("%s", text.error().message.c_str());
  auto read = document::Recipe::parse(*text, "again.json");
  if (!read) qFatal("%s", read.error().message.c_str());
  return std::move(*read);
}

inline std::vector<float> replayed(const document::Recipe& recipe,
                                   const std::shared_ptr<const Volume>& volume) {
  const auto result = document::evolve(recipe, volume, {});
  if (!result) qFatal("%s", result.error().message.c_str());
  return result->phi.dense();
}

}  // namespace tidemark::test
