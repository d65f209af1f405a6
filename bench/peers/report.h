// Tables for people and JSON for programs, from the same cells.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::bench {

struct Cell {
  std::string text;
  nlohmann::json value;
};

// A number with so many decimals; thousands are set apart.
Cell number(double value, int decimals = 0);
Cell text(std::string_view value);
// Nothing to say here.
Cell none();

// How a report appears on standard output while it grows.
enum class ReportStyle { none, text, markdown };

class Report {
 public:
  explicit Report(ReportStyle style) : style_(style) {}

  // A table; the columns' names are the keys in JSON. The first column is text, left-aligned.
  void table(const std::string& title, const std::vector<std::string>& columns,
             const std::vector<std::vector<Cell>>& rows);
  // A line below a table.
  void note(const std::string& line);
  // A figure that has a goal: at least it, or at most it. Collected for goals().
  void at_least(const std::string& what, double measured, double goal, int decimals = 1);
  void at_most(const std::string& what, double measured, double goal, int decimals = 1);
  // The table of all figures that have goals, so far.
  void goals();

  [[nodiscard]] const nlohmann::json& json() const { return json_; }

 private:
  void judge(const std::string& what, double measured, const char* relation, double goal, bool met,
             int decimals);
  void print_text(const std::string& title, const std::vector<std::string>& columns,
                  const std::vector<std::vector<Cell>>& rows) const;
  void print_markdown(const std::string& title, const std::vector<std::string>& columns,
                      const std::vector<std::vector<Cell>>& rows) const;

  ReportStyle style_;
  nlohmann::json json_ = nlohmann::json::object();
  std::vector<std::vector<Cell>> goals_;
};

}  // namespace tidemark::bench
