// Every variant of every shader is GLSL to the reference compiler, too, whatever a lenient driver lets pass.
#include "tests/shaders/reference_compiler.h"

#include <QTest>
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "tests/shaders/variants.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::reference_compiler_test {

namespace {

bool is_compute(const gpu::ProgramSource& program) {
  return program.stages.front().ends_with(".comp");
}

bool less(const gpu::ProgramSource& a, const gpu::ProgramSource& b) {
  return std::tie(a.stages, a.defines) < std::tie(b.stages, b.defines);
}

// Lines of a shader file that are neither comments nor for the preprocessor.
std::vector<int> lines_of_code(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<int> lines;
  CodeLines code;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (code.is_code(line)) lines.push_back(number);
  }
  return lines;
}

}  // namespace

class ReferenceCompilerTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    std::vector<gpu::ProgramSource> all = solver_variants();
    const std::vector<gpu::ProgramSource> drawn = renderer_variants();
    all.insert(all.end(), drawn.begin(), drawn.end());
    std::ranges::sort(all, less);
    const auto same = [](const auto& a, const auto& b) { return !less(a, b) && !less(b, a); };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
    for (gpu::ProgramSource& program : all) {
      (is_compute(program) ? computing_ : drawing_).push_back(std::move(program));
    }
    qInfo("%zu programs draw, %zu compute", drawing_.size(), computing_.size());
  }

  void every_program_that_draws_is_glsl_3_30() { compile(drawing_, "330 core"); }
  void every_program_that_draws_is_glsl_4_50() { compile(drawing_, "450 core"); }
  void every_program_that_computes_is_glsl_4_50() { compile(computing_, "450 core"); }

  void every_line_of_every_shader_belongs_to_a_variant() {
    const std::filesystem::path folder = TIDEMARK_SHADER_FILES;
    int files = 0;
    QStringList missed;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      ++files;
      const std::string name = std::filesystem::relative(entry.path(), folder).generic_string();
      for (const int line : lines_of_code(entry.path())) {
        if (!lines_[name].contains(line)) missed << QString::fromStdString(fmt::format("{}:{}", name, line));
      }
    }
    QVERIFY(files > 0);
    QVERIFY2(missed.isEmpty(), qPrintable("no variant compiles\n" + missed.join('\n')));
  }

 private:
  void compile(const std::vector<gpu::ProgramSource>& programs, const std::string& version) {
    const auto compiled = compile_by_reference(programs, version);
    QCOMPARE(failure(compiled), QString());
    for (const auto& [file, lines] : compiled->lines) lines_[file].insert(lines.begin(), lines.end());
    for (const std::string& complaint : compiled->complaints) qWarning("%s", complaint.c_str());
    QCOMPARE(compiled->complaints.size(), std::size_t{0});
  }

  std::vector<gpu::ProgramSource> drawing_, computing_;
  std::map<std::string, std::set<int>> lines_;  // of each file, those that some variant has
};

TIDEMARK_TEST(ReferenceCompilerTest)

}  // namespace tidemark::test::reference_compiler_test

#include "reference_compiler_test.moc"
