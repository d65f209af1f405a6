#include "tests/shaders/reference_compiler.h"

#include <fmt/ranges.h>

#include <QProcess>
#include <QRegularExpression>
#include <atomic>
#include <fstream>
#include <mutex>
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

std::string name_of(const gpu::ProgramSource& program, const std::string& version) {
  std::string name = version;
  for (const std::string& stage : program.stages) name += " " + stage;
  for (const auto& [define, value] : program.defines) name += fmt::format(" {}={}", define, value);
  return name;
}

// The programs that a thread has compiled: their files, and what each was put together from.
struct Stages {
  QStringList names;
  std::vector<gpu::ShaderSource> sources;
};

// Notes the lines that the preprocessor leaves of each file, by its #line directives.
Status note_lines(const Stages& stages, Compiled& result) {
  static const QRegularExpression kLine("^#line (\\d+) (\\d+)");
  const auto expanded = run(QStringList{"-E"} + stages.names);
  if (!expanded) return pass_on(expanded);
  std::istringstream lines(expanded->output);
  std::string line;
  auto source = stages.sources.begin() - 1;
  const std::string* file = nullptr;
  int number = 0;
  while (std::getline(lines, line)) {
    const auto match = kLine.match(QString::fromStdString(line));
    if (line.starts_with("#version")) {
      ++source;
      file = nullptr;
    } else if (match.hasMatch()) {
      number = match.captured(1).toInt();
      file = &source->files[match.captured(2).toUInt()];
    } else {
      const bool is_code = line.find_first_not_of(" \t") != std::string::npos;
      if (file != nullptr && is_code) result.lines[*file].insert(number);
      ++number;
    }
  }
  return {};
}

Status compile(const gpu::ProgramSource& program, const std::string& version,
               const std::filesystem::path& stem, Stages& stages, Compiled& result) {
  QStringList names;
  std::string files;
  for (const std::string& stage : program.stages) {
    auto source = gpu::assemble_shader(stage, version, program.defines);
    if (!source) return pass_on(source);
    const std::string name = stem.string() + stage.substr(stage.rfind('.'));
    std::ofstream(name) << source->text;
    names.push_back(QString::fromStdString(name));
    files += fmt::format("the files that places of {} count, from 0 on: {}\n", stage,
                         fmt::join(source->files, " "));
    stages.sources.push_back(std::move(*source));
  }
  stages.names += names;
  const auto linked = run(QStringList{"-l"} + names);
  if (!linked) return pass_on(linked);
  const auto has = [&](const char* word) { return linked->output.find(word) != std::string::npos; };
  if (!linked->well || has("ERROR") || has("WARNING")) {
    result.complaints.push_back(name_of(program, version) + "\n" + linked->output + files);
  }
  return {};
}

}  // namespace

Result<Compiled> compile_by_reference(const std::vector<gpu::ProgramSource>& programs,
                                      const std::string& version) {
  const TemporaryFolder folder;
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  Compiled all;
  Status status;
  const auto work = [&] {
    Compiled own;
    Stages stages;
    Status failed;
    for (std::size_t i = next++; i < programs.size() && failed; i = next++) {
      failed = compile(programs[i], version, folder / std::to_string(i), stages, own);
    }
    if (failed && !stages.names.isEmpty()) failed = note_lines(stages, own);
    const std::lock_guard lock(mutex);
    if (!failed) status = failed;
    all.complaints.insert(all.complaints.end(), own.complaints.begin(), own.complaints.end());
    for (const auto& [file, lines] : own.lines) all.lines[file].insert(lines.begin(), lines.end());
  };
  {
    std::vector<std::jthread> threads;
    for (unsigned i = 0; i < std::max(1U, std::thread::hardware_concurrency()); ++i)
      threads.emplace_back(work);
  }
  if (!status) return pass_on(status);
  return all;
}

}  // namespace tidemark::test
