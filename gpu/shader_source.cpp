#include "gpu/shader_source.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "gpu/embedded_shaders.h"

namespace tidemark::gpu {
namespace {

class Assembler {
 public:
  explicit Assembler(const ShaderReader& read) : read_(read) {}

  Status append(std::string_view path) {
    auto text = read_(path);
    if (!text) return pass_on(text);
    const std::size_t file = source_.files.size();
    source_.files.emplace_back(path);
    mark(1, file);
    std::istringstream lines(*text);
    std::string line;
    static const std::regex kInclude(R"re(^\s*#\s*include\s+"([^"]+)"\s*$)re");
    for (int number = 1; std::getline(lines, line); ++number) {
      std::smatch match;
      if (!std::regex_match(line, match, kInclude)) {
        source_.text += line + '\n';
        continue;
      }
      const std::string wanted = match[1];
      if (std::find(source_.files.begin(), source_.files.end(), wanted) == source_.files.end()) {
        if (auto status = append(wanted); !status) {
          return fail(status.error().kind, "{}:{}: {}", path, number, status.error().message);
        }
      }
      mark(number + 1, file);
    }
    return {};
  }

  ShaderSource& source() { return source_; }

 private:
  void mark(int line, std::size_t file) { source_.text += fmt::format("#line {} {}\n", line, file); }

  const ShaderReader& read_;
  ShaderSource source_;
};

}  // namespace

void add(Defines& defines, const Defines& more) {
  std::ranges::copy_if(more, std::back_inserter(defines), [&](const auto& define) {
    return std::ranges::find(defines, define) == defines.end();
  });
}

Result<std::string> read_shader(std::string_view path) {
  if (const char* folder = std::getenv("TIDEMARK_SHADERS"); folder != nullptr) {
    const std::string name = fmt::format("{}/{}", folder, path);
    std::ifstream file(name, std::ios::binary);
    if (!file) return fail(ErrorKind::internal, "{}: no such shader", name);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }
  for (const EmbeddedShader& shader : embedded_shaders()) {
    if (shader.path == path) return std::string(shader.text);
  }
  return fail(ErrorKind::internal, "{}: no such shader", path);
}

Result<ShaderSource> assemble_shader(std::string_view path, std::string_view version, const Defines& defines,
                                     const ShaderReader& read) {
  Assembler assembler(read);
  std::string& text = assembler.source().text;
  text = fmt::format("#version {}\n", version);
  for (const auto& [name, value] : defines) text += fmt::format("#define {} {}\n", name, value);
  TIDEMARK_TRY(assembler.append(path));
  return std::move(assembler.source());
}

std::string name_files(std::string_view log, const ShaderSource& source) {
  static const std::regex kPlace(R"(^(?:(?:ERROR|WARNING): )?(\d+)(?::(\d+)(?:\(\d+\))?|\((\d+)\)) ?:\s*)");
  std::string named;
  std::istringstream lines{std::string(log)};
  std::string line;
  while (std::getline(lines, line)) {
    std::smatch match;
    if (std::regex_search(line, match, kPlace)) {
      const std::size_t file = std::stoul(match[1]);
      const std::string number = match[2].matched ? match[2] : match[3];
      if (file < source.files.size()) {
        line = fmt::format("{}:{}: {}", source.files[file], number, match.suffix().str());
      }
    }
    named += line + '\n';
  }
  return named;
}

}  // namespace tidemark::gpu
