#include "bench/peers/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace tidemark::bench {

Cell number(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  const std::size_t whole = std::min(text.find('.'), text.size());
  const std::size_t first = text[0] == '-' ? 1 : 0;
  for (std::size_t at = whole; at > first + 3;) {
    at -= 3;
    text.insert(at, ",");
  }
  return {text, value};
}

Cell text(std::string_view value) {
  return {std::string(value), std::string(value)};
}

Cell none() {
  return {"-", nullptr};
}

void Report::table(const std::string& title, const std::vector<std::string>& columns,
                   const std::vector<std::vector<Cell>>& rows) {
  nlohmann::json& list = json_[title] = nlohmann::json::array();
  for (const auto& row : rows) {
    nlohmann::json object;
    for (std::size_t c = 0; c < row.size(); ++c) object[columns[c]] = row[c].value;
    list.push_back(std::move(object));
  }
  if (style_ == ReportStyle::text) print_text(title, columns, rows);
  if (style_ == ReportStyle::markdown) print_markdown(title, columns, rows);
  std::fflush(stdout);
}

void Report::print_text(const std::string& title, const std::vector<std::string>& columns,
                        const std::vector<std::vector<Cell>>& rows) const {
  std::vector<std::size_t> widths;
  for (const std::string& column : columns) widths.push_back(column.size());
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].text.size());
  }
  fmt::print("\n{}\n", title);
  const auto print_row = [&](const auto& text_of) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (c == 0) {
        fmt::print("  {:<{}}", text_of(c), widths[c]);
      } else {
        fmt::print("  {:>{}}", text_of(c), widths[c]);
      }
    }
    fmt::print("\n");
  };
  print_row([&](std::size_t c) { return columns[c]; });
  print_row([&](std::size_t c) { return std::string(widths[c], '-'); });
  for (const auto& row : rows) {
    print_row([&](std::size_t c) { return row[c].text; });
  }
}

void Report::print_markdown(const std::string& title, const std::vector<std::string>& columns,
                            const std::vector<std::vector<Cell>>& rows) const {
  fmt::print("\n**{}**\n\n|", title);
  for (const std::string& column : columns) fmt::print(" {} |", column);
  fmt::print("\n|");
  for (std::size_t c = 0; c < columns.size(); ++c) fmt::print("{}", c == 0 ? "---|" : "---:|");
  fmt::print("\n");
  for (const auto& row : rows) {
    fmt::print("|");
    for (const Cell& cell : row) fmt::print(" {} |", cell.text);
    fmt::print("\n");
  }
}

void Report::note(const std::string& line) {
  json_["notes"].push_back(line);
  if (style_ == ReportStyle::text) fmt::print("  {}\n", line);
  if (style_ == ReportStyle::markdown) fmt::print("\n{}\n", line);
  std::fflush(stdout);
}

void Report::judge(const std::string& what, double measured, const char* relation, double goal, bool met,
                   int decimals) {
  const Cell goal_cell = number(goal, decimals);
  goals_.push_back({text(what),
                    number(measured, decimals),
                    {fmt::format("{} {}", relation, goal_cell.text), goal},
                    {met ? "yes" : "NO", met}});
}

void Report::at_least(const std::string& what, double measured, double goal, int decimals) {
  judge(what, measured, ">=", goal, measured >= goal, decimals);
}

void Report::at_most(const std::string& what, double measured, double goal, int decimals) {
  judge(what, measured, "<=", goal, measured <= goal, decimals);
}

void Report::goals() {
  table("Goals", {"figure", "measured", "goal", "met"}, goals_);
}

}  // namespace tidemark::bench
