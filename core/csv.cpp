#include "core/csv.h"

#include <fmt/ranges.h>

namespace tidemark {
namespace {

class CsvScan {
 public:
  CsvScan(std::string_view text, const std::string& file, const CsvLimits& limits)
      : text_(text), file_(file), limits_(limits) {}

  Result<CsvTable> run();

 private:
  [[nodiscard]] bool ended() const { return at_ == text_.size(); }
  [[nodiscard]] bool at_line_end() const { return ended() || text_[at_] == '\n' || text_[at_] == '\r'; }
  void choose_separator();
  void pass_blank_lines();
  void pass_line_end();
  Status read_line(std::vector<std::string>& fields);
  Status read_field(std::string& field);
  Status read_quoted(std::string& field);

  std::string_view text_;
  const std::string& file_;
  const CsvLimits& limits_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  char separator_ = ',';
};

void CsvScan::choose_separator() {
  const std::string_view first = text_.substr(at_, text_.find('\n', at_) - at_);
  const bool has_comma = first.find(',') != std::string_view::npos;
  if (!has_comma && first.find(';') != std::string_view::npos) separator_ = ';';
}

void CsvScan::pass_line_end() {
  if (!ended() && text_[at_] == '\r') ++at_;
  if (!ended() && text_[at_] == '\n') ++at_;
  ++line_;
}

void CsvScan::pass_blank_lines() {
  while (!ended() && at_line_end()) pass_line_end();
}

Status CsvScan::read_quoted(std::string& field) {
  const std::size_t begun = line_;
  for (++at_; !ended(); ++at_) {
    if (text_[at_] == '"') {
      ++at_;
      if (ended() || text_[at_] != '"') return {};
    } else if (text_[at_] == '\n') {
      ++line_;
    }
    if (field.size() >= limits_.field) break;
    field += text_[at_];
  }
  if (ended()) return fail(ErrorKind::input, "{}: line {}: a quote is not closed", file_, begun);
  return {};
}

Status CsvScan::read_field(std::string& field) {
  if (!ended() && text_[at_] == '"') {
    TIDEMARK_TRY(read_quoted(field));
  } else {
    while (!at_line_end() && text_[at_] != separator_ && field.size() < limits_.field) field += text_[at_++];
  }
  if (field.size() >= limits_.field) {
    return fail(ErrorKind::input, "{}: line {}: a field has more than {} bytes", file_, line_, limits_.field);
  }
  if (field.find('\0') != std::string::npos) {
    return fail(ErrorKind::input, "{}: line {}: holds a zero byte: this is no text", file_, line_);
  }
  if (at_line_end() || text_[at_] == separator_) return {};
  return fail(ErrorKind::input, "{}: line {}: text follows a closing quote", file_, line_);
}

Status CsvScan::read_line(std::vector<std::string>& fields) {
  for (;;) {
    if (fields.size() >= limits_.columns) {
      return fail(ErrorKind::input, "{}: line {}: more than {} columns", file_, line_, limits_.columns);
    }
    TIDEMARK_TRY(read_field(fields.emplace_back()));
    if (at_line_end()) break;
    ++at_;  // the separator
  }
  pass_line_end();
  return {};
}

Result<CsvTable> CsvScan::run() {
  if (text_.size() > limits_.bytes) {
    return fail(ErrorKind::input, "{}: {} bytes, more than {} are not read", file_, text_.size(),
                limits_.bytes);
  }
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text_.starts_with(kByteOrderMark)) at_ = kByteOrderMark.size();
  pass_blank_lines();
  if (ended()) return fail(ErrorKind::input, "{}: is empty: a line with the columns' names is needed", file_);
  choose_separator();
  CsvTable table;
  TIDEMARK_TRY(read_line(table.header));
  for (pass_blank_lines(); !ended(); pass_blank_lines()) {
    if (table.rows.size() == limits_.rows) {
      return fail(ErrorKind::input, "{}: more than {} rows", file_, limits_.rows);
    }
    CsvRow& row = table.rows.emplace_back();
    row.line = line_;
    TIDEMARK_TRY(read_line(row.fields));
    if (row.fields.size() != table.header.size()) {
      return fail(ErrorKind::input, "{}: line {}: {} fields, but {} columns", file_, row.line,
                  row.fields.size(), table.header.size());
    }
  }
  return table;
}

std::string quoted(std::string_view text) {
  std::string field = "\"";
  for (const char c : text) {
    if (c == '"') field += '"';
    field += c;
  }
  return field + '"';
}

bool is_like_formula(std::string_view text) {
  return !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
}

}  // namespace

Result<CsvTable> CsvTable::parse(std::string_view text, const std::string& file, const CsvLimits& limits) {
  return CsvScan(text, file, limits).run();
}

std::string csv_field(std::string_view text) {
  return text.find_first_of(",;\"\r\n") == std::string_view::npos ? std::string(text) : quoted(text);
}

std::string csv_text(std::string_view text) {
  return csv_field(is_like_formula(text) ? "'" + std::string(text) : std::string(text));
}

std::string text_of_csv(std::string_view field) {
  if (!field.empty() && field.front() == '\'' && is_like_formula(field.substr(1))) field.remove_prefix(1);
  return std::string(field);
}

std::string csv_line(const std::vector<std::string>& fields) {
  return fmt::format("{}\r\n", fmt::join(fields, ","));
}

}  // namespace tidemark
