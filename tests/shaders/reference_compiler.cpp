#include "tests/shaders/reference_compiler.h"

#include <fmt/ranges.h>

#include <QProcess>
#include <QRegularExpression>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>
#include <optional>
#include <sstream>
#include <thread>

#include "tests/support/support.h"

namespace tidemark::test {
namespace {

struct Ran {
  bool well = false;
  std::string output;
};

Result<Ran> run(const QStringList& arguments) {
  QProcess process;
  process.setProcessChannelMode(QProcess::MergedChannels);
  process.start("glslangValidator", arguments);
  if (!process.waitForFinished(60000)) {
    return fail(ErrorKind::capability, "glslangValidator cannot be run (Debian: glslang-tools): {}",
                process.errorString().toStdString());
  }
  return Ran{process.exitStatus() == QProcess::NormalExit && process.exitCode() == 0,
             process.readAll().toStdString()};
}

bool complains(const Ran& ran) {
  const auto has = [&](const char* word) { return ran.output.find(word) != std::string::npos; };
  return !ran.well || has("ERROR") || has("WARNING");
}

std::string name_of(const gpu::ProgramSource& program, const std::string& version) {
  std::string name = version;
  for (const std::string& stage : program.stages) name += " " + stage;
  for (const auto& [define, value] : program.defines) name += fmt::format(" {}={}", define, value);
  return name;
}

// A text for the compiler, as the first program that has it puts it together.
struct Stage {
  gpu::ShaderSource source;
  std::string program;
  QString file;    // where it was written
  QString marked;  // the same for the preprocessor
};

// Each line of code begins with a mark, by which it is known where it is left by the preprocessor.
std::string with_marks(const gpu::ShaderSource& source, std::size_t stage) {
  static const QRegularExpression kPlace("^#line (\\d+) (\\d+)");
  std::istringstream lines(source.text);
  std::string marked;
  std::string line;
  std::optional<int> file;
  int number = 0;
  CodeLines code;
  while (std::getline(lines, line)) {
    const auto place = kPlace.match(QString::fromStdString(line));
    if (code.is_code(line) && file) marked += fmt::format("MARK_{}_{}_{} ", stage, *file, number);
    ++number;
    if (place.hasMatch()) {
      number = place.captured(1).toInt();
      file = place.captured(2).toInt();
      continue;
    }
    marked += line + "\n";
  }
  return marked;
}

class ReferenceCompiler {
 public:
  explicit ReferenceCompiler(std::string version) : version_(std::move(version)) {}

  Status add(const gpu::ProgramSource& program);
  Result<Compiled> compile();

 private:
  Status compile_stages(std::size_t first, std::size_t end);
  Status note_lines(std::size_t first, std::size_t end);
  Status link(const QStringList& files, const std::string& program);
  void complain(const std::string& program, const std::string& output);

  std::string version_;
  TemporaryFolder folder_;
  std::vector<Stage> stages_;
  std::map<std::pair<std::string, std::string>, std::size_t> known_;  // by file and text
  // Of programs with the same files the first and the last: that their stages fit depends on little else.
  std::map<std::vector<std::string>, std::vector<std::pair<QStringList, std::string>>> linked_;
  std::mutex mutex_;  // of what follows
  Compiled result_;
};

Status ReferenceCompiler::add(const gpu::ProgramSource& program) {
  QStringList files;
  for (const std::string& stage : program.stages) {
    auto source = gpu::assemble_shader(stage, version_, program.defines);
    if (!source) return pass_on(source);
    const auto [known, is_new] = known_.try_emplace({stage, source->text}, stages_.size());
    if (is_new) {
      const std::string ending = stage.substr(stage.rfind('.'));
      const auto written = [&](const std::string& name, const std::string& text) {
        const std::filesystem::path file = folder_ / (name + ending);
        std::ofstream(file) << text;
        return QString::fromStdString(file.string());
      };
      const std::string number = std::to_string(stages_.size());
      const QString file = written(number, source->text);
      const QString marked = written("marked" + number, with_marks(*source, stages_.size()));
      stages_.push_back({std::move(*source), name_of(program, version_), file, marked});
    }
    files.push_back(stages_[known->second].file);
  }
  auto& linked = linked_[program.stages];
  if (linked.size() == 2) linked.pop_back();
  linked.emplace_back(files, name_of(program, version_));
  return {};
}

void ReferenceCompiler::complain(const std::string& program, const std::string& output) {
  const std::lock_guard lock(mutex_);
  result_.complaints.push_back(program + "\n" + output);
}

// The compiler takes long to begin with, so that it gets many files at once.
Status ReferenceCompiler::compile_stages(std::size_t first, std::size_t end) {
  QStringList files;
  for (std::size_t stage = first; stage < end; ++stage) files.push_back(stages_[stage].file);
  const auto all = run(files);
  if (!all) return pass_on(all);
  if (!complains(*all)) return {};
  for (std::size_t stage = first; stage < end; ++stage) {
    const auto one = run({stages_[stage].file});
    if (!one) return pass_on(one);
    if (!complains(*one)) continue;
    complain(stages_[stage].program, fmt::format("{}files, from 0 on: {}\n", one->output,
                                                 fmt::join(stages_[stage].source.files, " ")));
  }
  return {};
}

Status ReferenceCompiler::note_lines(std::size_t first, std::size_t end) {
  static const QRegularExpression kMark("MARK_(\\d+)_(\\d+)_(\\d+)");
  QStringList arguments{"-E"};
  for (std::size_t stage = first; stage < end; ++stage) arguments.push_back(stages_[stage].marked);
  const auto expanded = run(arguments);
  if (!expanded) return pass_on(expanded);
  const QString text = QString::fromStdString(expanded->output);
  const std::lock_guard lock(mutex_);
  for (auto marks = kMark.globalMatch(text); marks.hasNext();) {
    const auto mark = marks.next();
    const gpu::ShaderSource& source = stages_[mark.captured(1).toULongLong()].source;
    result_.lines[source.files[mark.captured(2).toUInt()]].insert(mark.captured(3).toInt());
  }
  return {};
}

Status ReferenceCompiler::link(const QStringList& files, const std::string& program) {
  const auto linked = run(QStringList{"-l"} + files);
  if (!linked) return pass_on(linked);
  if (complains(*linked)) complain(program, linked->output);
  return {};
}

Result<Compiled> ReferenceCompiler::compile() {
  constexpr std::size_t kAtOnce = 40;
  std::vector<std::function<Status()>> tasks;
  for (std::size_t first = 0; first < stages_.size(); first += kAtOnce) {
    const std::size_t end = std::min(first + kAtOnce, stages_.size());
    tasks.emplace_back([=, this] { return compile_stages(first, end); });
    tasks.emplace_back([=, this] { return note_lines(first, end); });
  }
  for (const auto& [stages, programs] : linked_) {
    for (const auto& [files, program] : programs)
      tasks.emplace_back([this, &files = files, &program = program] { return link(files, program); });
  }
  std::atomic<std::size_t> next = 0;
  Status failure;
  const auto work = [&] {
    for (std::size_t i = next++; i < tasks.size(); i = next++) {
      if (const Status done = tasks[i](); !done) {
        const std::lock_guard lock(mutex_);
        failure = done;
      }
    }
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i)
      threads.emplace_back(work);
  }
  if (!failure) return pass_on(failure);
  return std::move(result_);
}

}  // namespace

bool CodeLines::is_code(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(" \t");
  const bool goes_on = std::exchange(directive_, false);
  if (begin == std::string::npos || line.compare(begin, 2, "//") == 0) return false;
  const bool directive = goes_on || line[begin] == '#';
  directive_ = directive && line.back() == '\\';
  return !directive;
}

Result<Compiled> compile_by_reference(const std::vector<gpu::ProgramSource>& programs,
                                      const std::string& version) {
  ReferenceCompiler compiler(version);
  for (const gpu::ProgramSource& program : programs) {
    TIDEMARK_TRY(compiler.add(program));
  }
  return compiler.compile();
}

}  // namespace tidemark::test
