#include "tests/shaders/reference_compiler.h"

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

// Notes the lines of a preprocessed text that are not empty, by its #line directives.
void note_lines(const std::string& text, const gpu::ShaderSource& source, Compiled& result) {
  static const QRegularExpression kLine("^#line (\\d+) (\\d+)");
  std::istringstream lines(text);
  std::string line;
  int number = 0;
  std::size_t file = source.files.size();
  while (std::getline(lines, line)) {
    const auto match = kLine.match(QString::fromStdString(line));
    if (match.hasMatch()) {
      number = match.captured(1).toInt();
      file = match.captured(2).toUInt();
      continue;
    }
    if (file < source.files.size() && line.find_first_not_of(" \t") != std::string::npos) {
      result.lines[source.files[file]].insert(number);
    }
    ++number;
  }
}

Status compile(const gpu::ProgramSource& program, const std::string& version, Compiled& result) {
  const TemporaryFolder folder;
  std::vector<gpu::ShaderSource> sources;
  QStringList names;
  for (const std::string& stage : program.stages) {
    auto source = gpu::assemble_shader(stage, version, program.defines);
    if (!source) return pass_on(source);
    const auto file = folder / ("stage" + stage.substr(stage.rfind('.')));
    std::ofstream(file) << source->text;
    names.push_back(QString::fromStdString(file.string()));
    sources.push_back(std::move(*source));
  }
  const auto linked = run(QStringList{"-l"} + names);
  if (!linked) return pass_on(linked);
  if (!linked->well || linked->output.find("ERROR") != std::string::npos ||
      linked->output.find("WARNING") != std::string::npos) {
    std::string words = linked->output;
    if (sources.size() == 1) words = gpu::name_files(words, sources.front());
    for (std::size_t i = 0; i < sources.size() && sources.size() > 1; ++i) {
      words += fmt::format("files of {}:", program.stages[i]);
      for (const std::string& file : sources[i].files) words += " " + file;
      words += '\n';
    }
    result.complaints.push_back(name_of(program, version) + "\n" + words);
  }
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const auto expanded = run({"-E", names[static_cast<int>(i)]});
    if (!expanded) return pass_on(expanded);
    note_lines(expanded->output, sources[i], result);
  }
  return {};
}

}  // namespace

Result<Compiled> compile_by_reference(const std::vector<gpu::ProgramSource>& programs,
                                      const std::string& version) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  Compiled all;
  Status status;
  const auto work = [&] {
    Compiled own;
    Status failed;
    for (std::size_t i = next++; i < programs.size() && failed; i = next++) {
      failed = compile(programs[i], version, own);
    }
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
