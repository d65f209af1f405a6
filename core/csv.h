// Tables as comma-separated text (RFC 4180).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.h"

namespace tidemark {

struct CsvLimits {
  std::size_t bytes = std::size_t{256} << 20;
  std::size_t rows = 1'000'000;
  std::size_t columns = 64;
  std::size_t field = 4096;  // bytes
};

struct CsvRow {
  std::size_t line = 0;             // of the text, from 1
  std::vector<std::string> fields;  // as many as the header has
};

struct CsvTable {
  std::vector<std::string> header;
  std::vector<CsvRow> rows;

  // The text's first line names the columns. Fields are separated by commas, or by semicolons where that line
  // has no comma: some spreadsheets write so. Lines end in LF or CRLF; blank ones are passed over. Fails
  // (ErrorKind::input) naming `file` and the line.
  static Result<CsvTable> parse(std::string_view text, const std::string& file, const CsvLimits& limits = {});
};

// The text as a field, in quotes where it needs them.
[[nodiscard]] std::string csv_field(std::string_view text);

// The same for text from outside: a spreadsheet takes it for no formula.
[[nodiscard]] std::string csv_text(std::string_view text);

// The text that csv_text() has written.
[[nodiscard]] std::string text_of_csv(std::string_view field);

// Fields with commas between them and CRLF behind them.
[[nodiscard]] std::string csv_line(const std::vector<std::string>& fields);

}  // namespace tidemark
