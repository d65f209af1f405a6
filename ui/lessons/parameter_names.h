// The parameters of the level set, each with its name for people and its range.
#pragma once

#include <QString>
#include <optional>
#include <span>
#include <variant>

#include "solver/parameters.h"

namespace tidemark::ui {

struct NamedParameter {
  using Member = std::variant<double solver::Parameters::*, std::optional<double> solver::Parameters::*,
                              bool solver::Parameters::*, solver::Scheme solver::Parameters::*,
                              solver::DataForm solver::Parameters::*>;

  const char* title;  // "Target T", in English
  const char* tip;
  Member member;
  double low = 0.0;  // of numbers
  double high = 0.0;
  int decimals = 0;

  [[nodiscard]] QString title_text() const;
  [[nodiscard]] QString tip_text() const;
  [[nodiscard]] bool is_same(const solver::Parameters& a, const solver::Parameters& b) const;
  void copy(const solver::Parameters& from, solver::Parameters& to) const;
};

// The first three are target, range and alpha, without which no data term makes sense.
[[nodiscard]] std::span<const NamedParameter> named_parameters();
inline constexpr std::size_t kMainParameters = 3;

// Parameters that were as `before` become as `after`; those of its own stay.
void follow(solver::Parameters& parameters, const solver::Parameters& before,
            const solver::Parameters& after);

}  // namespace tidemark::ui
