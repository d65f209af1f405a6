// Shaders from files: #include, #define variants, and errors that name the file and the line.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/result.h"

namespace tidemark::gpu {

// Name and value; the value may be empty.
using Defines = std::vector<std::pair<std::string, std::string>>;

// Adds those that are not there yet.
void add(Defines& defines, const Defines& more);

// The text of a shader file, by its path below resources/shaders.
using ShaderReader = std::function<Result<std::string>(std::string_view path)>;

// Reads from the folder that $TIDEMARK_SHADERS names, so that shaders can be edited while the program runs;
// else the files as they were when the program was built.
Result<std::string> read_shader(std::string_view path);

// A program as it is asked for.
struct ProgramSource {
  std::vector<std::string> stages;  // files, whose endings say what they are
  Defines defines;                  // of all stages
};

// One text for the compiler.
struct ShaderSource {
  std::string text;
  std::vector<std::string> files;  // what the numbers of the text's #line directives stand for
};

// Puts "#version", the defines and the file together. Each `#include "path"` (from resources/shaders) is
// replaced by that file the first time it is met. Fails (ErrorKind::internal) on a file that is missing, and
// names the line that wants it.
Result<ShaderSource> assemble_shader(std::string_view path, std::string_view version, const Defines& defines,
                                     const ShaderReader& read = read_shader);

// Rewrites a compiler's messages: "0:12(3): error" (Mesa), "0(12) : error" (NVIDIA) and "ERROR: 0:12:"
// (Apple, AMD) become "file:12: ...".
std::string name_files(std::string_view log, const ShaderSource& source);

}  // namespace tidemark::gpu
