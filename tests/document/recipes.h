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

inline document::Evolution evolved(const document::Recipe& recipe,
                                   const std::shared_ptr<const Volume>& volume,
                                   const document::EvolutionOptions& options = {}) {
  auto evolution = document::evolve(recipe, volume, options);
  if (!evolution) qFatal("%s", evolution.error().message.c_str());
  return std::move(*evolution);
}

inline std::vector<float> replayed(const document::Recipe& recipe,
                                   const std::shared_ptr<const Volume>& volume) {
  return evolved(recipe, volume).phi.dense();
}

}  // namespace tidemark::test
