#include "document/cohort/work_list.h"

#include <algorithm>
#include <functional>
#include <map>

#include "core/csv.h"
#include "core/number_from.h"
#include "core/text_file.h"
#include "document/file_limits.h"
#include "imaging/filters/filters.h"

namespace tidemark::cohort {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestId = 100;

using Problem = std::string;  // empty: none

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

Problem read_numbers(const std::string_view text, double* numbers, std::size_t count) {
  std::string_view rest = text;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t comma = i + 1 < count ? rest.find(',') : rest.size();
    const std::string_view one = trimmed(rest.substr(0, comma));
    const auto number = number_from<double>(one);
    if (comma == std::string_view::npos || !number) {
      return count == 1 ? fmt::format("'{}' is not a number", text)
                        : fmt::format("'{}' is not {} numbers with commas between", text, count);
    }
    numbers[i] = *number;
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return {};
}

// One column: its name, and how it is read from a field and written to one.
struct Column {
  const char* name;
  std::function<Problem(WorkRow&, std::string_view)> read;
  std::function<std::string(const WorkRow&)> write;
};

Column number_column(const char* name, std::optional<double> WorkRow::*member) {
  const auto read = [member](WorkRow& row, std::string_view text) {
    double number = 0.0;
    Problem problem = read_numbers(text, &number, 1);
    if (problem.empty()) row.*member = number;
    return problem;
  };
  const auto write = [member](const WorkRow& row) {
    return row.*member ? fmt::format("{}", *(row.*member)) : std::string();
  };
  return {name, read, write};
}

Column count_column(const char* name, std::optional<std::int64_t> WorkRow::*member) {
  const auto read = [member](WorkRow& row, std::string_view text) -> Problem {
    const auto count = number_from<std::int64_t>(text);
    if (!count || *count < 0 || *count > document::kMostSteps) {
      return fmt::format("'{}' is not a whole number from 0 to {}", text, document::kMostSteps);
    }
    row.*member = count;
    return {};
  };
  const auto write = [member](const WorkRow& row) {
    return row.*member ? fmt::format("{}", *(row.*member)) : std::string();
  };
  return {name, read, write};
}

Column path_column(const char* name, fs::path WorkRow::*member) {
  const auto read = [member](WorkRow& row, std::string_view text) {
    row.*member = fs::path(text);
    return Problem();
  };
  return {name, read, [member](const WorkRow& row) { return (row.*member).string(); }};
}

Column text_column(const char* name, std::string WorkRow::*member) {
  const auto read = [member](WorkRow& row, std::string_view text) {
    row.*member = text;
    return Problem();
  };
  return {name, read, [member](const WorkRow& row) { return row.*member; }};
}

// Several are separated by blanks: "10,20,30,5 40,20,30,5".
Column seeds_column(const char* name, std::vector<Seed> WorkRow::*member) {
  const auto read = [member](WorkRow& row, std::string_view text) -> Problem {
    while (!(text = trimmed(text)).empty()) {
      const std::size_t end = std::min(text.find(' '), text.size());
      double numbers[4];
      if (Problem problem = read_numbers(text.substr(0, end), numbers, 4); !problem.empty()) return problem;
      if (numbers[3] <= 0.0) return fmt::format("radius {}: must be greater than 0 mm", numbers[3]);
      (row.*member).push_back({{numbers[0], numbers[1], numbers[2]}, numbers[3]});
      text.remove_prefix(end);
    }
    return {};
  };
  const auto write = [member](const WorkRow& row) {
    std::string text;
    for (const Seed& seed : row.*member) {
      text += fmt::format("{}{},{},{},{}", text.empty() ? "" : " ", seed.centre.x, seed.centre.y,
                          seed.centre.z, seed.radius_mm);
    }
    return text;
  };
  return {name, read, write};
}

Column threshold_column() {
  const auto read = [](WorkRow& row, std::string_view text) -> Problem {
    double numbers[2];
    Problem problem = read_numbers(text, numbers, 2);
    if (!problem.empty()) return problem;
    row.threshold = {numbers[0], numbers[1]};
    return {};
  };
  const auto write = [](const WorkRow& row) {
    return row.threshold ? fmt::format("{},{}", row.threshold->first, row.threshold->second) : std::string();
  };
  return {"threshold", read, write};
}

Column auto_start_column() {
  const auto read = [](WorkRow& row, std::string_view text) -> Problem {
    if (text != "yes" && text != "no") return fmt::format("'{}' is neither yes nor no", text);
    row.auto_start = text == "yes";
    return {};
  };
  return {"auto_start", read, [](const WorkRow& row) { return std::string(row.auto_start ? "yes" : ""); }};
}

const std::vector<Column>& columns() {
  static const std::vector<Column> kColumns{
      text_column("id", &WorkRow::id),
      path_column("input", &WorkRow::input),
      text_column("server", &WorkRow::server),
      text_column("study", &WorkRow::study),
      text_column("series", &WorkRow::series),
      path_column("recipe", &WorkRow::recipe),
      path_column("mask", &WorkRow::mask),
      number_column("within_mm", &WorkRow::within_mm),
      seeds_column("seed", &WorkRow::seeds),
      seeds_column("seed_mm", &WorkRow::seeds_mm),
      threshold_column(),
      auto_start_column(),
      path_column("speed_map", &WorkRow::speed_map),
      number_column("target", &WorkRow::target),
      number_column("range", &WorkRow::range),
      number_column("alpha", &WorkRow::alpha),
      number_column("smooth_mm", &WorkRow::smooth_mm),
      count_column("steps", &WorkRow::steps),
      count_column("max_steps", &WorkRow::max_steps),
      count_column("levels", &WorkRow::levels),
      path_column("truth", &WorkRow::truth),
      count_column("truth_label", &WorkRow::truth_label),
  };
  return kColumns;
}

Result<std::vector<const Column*>> columns_of(const CsvTable& table, const std::string& file) {
  std::string known;
  for (const Column& column : columns()) known += (known.empty() ? "" : ", ") + std::string(column.name);
  std::vector<const Column*> found;
  for (const std::string& name : table.header) {
    const auto column = std::find_if(columns().begin(), columns().end(),
                                     [&](const Column& one) { return one.name == trimmed(name); });
    if (column == columns().end()) {
      return fail(ErrorKind::input, "{}: line 1: no column is named '{}'; they are {}", file, name, known);
    }
    if (std::find(found.begin(), found.end(), &*column) != found.end()) {
      return fail(ErrorKind::input, "{}: line 1: the column '{}' is there twice", file, name);
    }
    found.push_back(&*column);
  }
  const auto says_where = [](const Column* column) {
    return std::string_view(column->name) == "input" || std::string_view(column->name) == "server";
  };
  if (std::none_of(found.begin(), found.end(), says_where)) {
    return fail(ErrorKind::input, "{}: line 1: a column 'input' or 'server' is needed", file);
  }
  return found;
}

fs::path whole_path(const fs::path& path, const fs::path& folder) {
  return path.empty() ? path : fs::absolute(folder / path).lexically_normal();
}

std::string name_of(const fs::path& input) {
  fs::path name = input.has_filename() ? input.filename() : input.parent_path().filename();
  if (name.extension() == ".gz") name.replace_extension();
  name.replace_extension();
  return safe_id(name.string());
}

}  // namespace

bool is_safe_id(std::string_view id) {
  return !id.empty() && id.size() <= kLongestId && id == safe_id(id);
}

std::string safe_id(std::string_view text) {
  std::string id;
  for (const char c : text.substr(0, kLongestId)) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    const bool inner = !id.empty() && (c == '.' || c == '-');
    id += letter || inner ? c : '_';
  }
  return id.empty() ? "_" : id;
}

std::string WorkRow::place() const {
  return server.empty() ? input.string() : fmt::format("{}{}/{}", kPacsSource, server, study);
}

void WorkRow::complete(const WorkRow& defaults) {
  const auto take = [](auto& own, const auto& other) {
    if (!own) own = other;
  };
  if (!has_start()) {
    seeds_mm = defaults.seeds_mm;
    threshold = defaults.threshold;
    auto_start = auto_start || defaults.auto_start;
  }
  take(within_mm, mask.empty() ? std::nullopt : defaults.within_mm);
  for (const auto member : {&WorkRow::target, &WorkRow::range, &WorkRow::alpha, &WorkRow::smooth_mm}) {
    take(this->*member, defaults.*member);
  }
  if (!steps && !max_steps) {
    steps = defaults.steps;
    max_steps = defaults.max_steps;
  }
  take(levels, defaults.levels);
}

void WorkRow::replace(const WorkRow& given) {
  const bool is_on_voxels = !mask.empty() || !seeds.empty();
  if (given.has_start() || (given.auto_start && !is_on_voxels)) {
    mask = given.mask;
    seeds = given.seeds;
    seeds_mm = given.seeds_mm;
    threshold = given.threshold;
    auto_start = given.auto_start;
  }
  if (mask.empty()) within_mm.reset();
  const auto take = [](auto& own, const auto& other) {
    if (other) own = other;
  };
  take(within_mm, mask.empty() ? std::nullopt : given.within_mm);
  for (const auto member : {&WorkRow::target, &WorkRow::range, &WorkRow::alpha, &WorkRow::smooth_mm}) {
    take(this->*member, given.*member);
  }
  if (given.steps || given.max_steps) {
    steps = given.steps;
    max_steps = given.max_steps;
  }
  take(levels, given.levels);
}

std::vector<std::string> problems_of_values(const WorkRow& row) {
  std::vector<std::string> problems;
  const auto unless = [&](bool good, std::string problem) {
    if (!good) problems.push_back(std::move(problem));
  };
  unless(!row.threshold || row.threshold->first <= row.threshold->second,
         "threshold: the lower limit is above the upper limit");
  unless(!row.within_mm || *row.within_mm > 0.0, "within_mm: must be greater than 0");
  unless(!row.range || *row.range > 0.0, "range: must be greater than 0");
  unless(!row.alpha || (*row.alpha >= 0.0 && *row.alpha <= 1.0), "alpha: must be 0 to 1");
  unless(!row.smooth_mm || *row.smooth_mm >= 0.0, "smooth_mm: must not be below 0");
  unless(!row.smooth_mm || *row.smooth_mm <= imaging::kMostSmoothing_mm,
         fmt::format("smooth_mm: must be at most {}", imaging::kMostSmoothing_mm));
  unless(!row.steps || !row.max_steps, "steps, max_steps: only one of them can be given");
  unless(!row.steps || *row.steps <= document::kMostSteps,
         fmt::format("steps: must be at most {}", document::kMostSteps));
  unless(!row.max_steps || (*row.max_steps > 0 && *row.max_steps <= document::kMostSteps),
         fmt::format("max_steps: must be 1 to {}", document::kMostSteps));
  unless(!row.levels || (*row.levels >= 1 && *row.levels <= 3), "levels: must be 1 to 3");
  return problems;
}

std::vector<std::string> problems_of(const WorkRow& row) {
  std::vector<std::string> problems = problems_of_values(row);
  const auto unless = [&](bool good, std::string problem) {
    if (!good) problems.push_back(std::move(problem));
  };
  unless(is_safe_id(row.id), "id '" + row.id +
                                 "': must be 1 to 100 letters, digits, '.', '_' and '-', not beginning with "
                                 "'.' or '-'");
  const bool has_server = !row.server.empty();
  unless(!row.input.empty() || has_server, "input: is missing");
  unless(row.input.empty() || !has_server, "input, server: a study is in one of them");
  unless(has_server || row.study.empty(), "study: needs a server");
  unless(!has_server || (!row.study.empty() && !row.series.empty()),
         "study, series: both are needed where a server has them");
  const int starts = int{!row.mask.empty()} + int{row.threshold.has_value()};
  unless(starts < 2, "mask, threshold: a case starts from one of them");
  unless(!row.within_mm || !row.mask.empty(), "within_mm: needs a mask");
  unless(!row.truth_label || !row.truth.empty(), "truth_label: needs a truth");
  return problems;
}

Result<WorkList> WorkList::parse(std::string_view text, const std::string& file, const fs::path& folder) {
  CsvLimits limits;
  limits.rows = kMostCases;
  const auto table = CsvTable::parse(text, file, limits);
  if (!table) return pass_on(table);
  const auto found = columns_of(*table, file);
  if (!found) return pass_on(found);
  WorkList list;
  list.rows.reserve(table->rows.size());
  for (const CsvRow& line : table->rows) {
    WorkRow row;
    row.line = line.line;
    const auto complain = [&](const std::string& what) {
      list.problems.push_back(fmt::format("{}: line {}: {}", file, line.line, what));
    };
    for (std::size_t i = 0; i < found->size(); ++i) {
      const std::string_view field = trimmed(line.fields[i]);
      if (field.empty()) continue;
      const Problem problem = (*found)[i]->read(row, field);
      if (!problem.empty()) complain(fmt::format("{}: {}", (*found)[i]->name, problem));
    }
    for (const auto member :
         {&WorkRow::input, &WorkRow::recipe, &WorkRow::mask, &WorkRow::speed_map, &WorkRow::truth}) {
      row.*member = whole_path(row.*member, folder);
    }
    if (row.id.empty()) row.id = row.input.empty() ? safe_id(row.series) : name_of(row.input);
    for (const std::string& problem : problems_of(row)) complain(problem);
    list.rows.push_back(std::move(row));
  }
  list.find_double_ids(file);
  return list;
}

Result<WorkList> WorkList::load(const fs::path& file) {
  const auto text = read_text_file(file, CsvLimits().bytes);
  if (!text) return pass_on(text);
  return parse(*text, file.string(), file.parent_path());
}

void WorkList::find_double_ids(const std::string& file) {
  std::map<std::string_view, std::size_t> first;
  for (const WorkRow& row : rows) {
    const auto [known, is_new] = first.emplace(row.id, row.line);
    if (is_new) continue;
    problems.push_back(
        fmt::format("{}: line {}: id '{}': line {} has it, too", file, row.line, row.id, known->second));
  }
}

std::string WorkList::to_text() const {
  std::vector<const Column*> used;
  std::vector<std::string> names;
  for (const Column& column : columns()) {
    const auto writes = [&](const WorkRow& row) { return !column.write(row).empty(); };
    const bool needed = &column == &columns()[0] || &column == &columns()[1];
    if (!needed && std::none_of(rows.begin(), rows.end(), writes)) continue;
    used.push_back(&column);
    names.emplace_back(column.name);
  }
  std::string text = csv_line(names);
  for (const WorkRow& row : rows) {
    std::vector<std::string> fields;
    for (const Column* column : used) fields.push_back(csv_field(column->write(row)));
    text += csv_line(fields);
  }
  return text;
}

}  // namespace tidemark::cohort
