// GLSL's reference compiler, glslangValidator.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "gpu/shader_source.h"

namespace tidemark::test {

// Tells lines of code, one after the other, from comments, blank lines and what is for the preprocessor.
class CodeLines {
 public:
  [[nodiscard]] bool is_code(const std::string& line);

 private:
  bool directive_ = false;  // goes on from the line before
};

struct Compiled {
  std::vector<std::string> complaints;  // errors and warnings: the program, and the compiler's own words
  std::map<std::string, std::set<int>> lines;  // of each file, those that were left to compile
};

// Compiles the programs as GLSL of a version, and links two of those that have the same files. Fails
// (ErrorKind::capability) where there is no glslangValidator.
Result<Compiled> compile_by_reference(const std::vector<gpu::ProgramSource>& programs,
                                      const std::string& version);

}  // namespace tidemark::test
