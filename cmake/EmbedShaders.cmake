# Writes OUTPUT, a C++ file that holds every shader below FOLDER as text.
file(GLOB_RECURSE shaders RELATIVE ${FOLDER} ${FOLDER}/*.glsl ${FOLDER}/*.vert ${FOLDER}/*.geom
     ${FOLDER}/*.frag ${FOLDER}/*.comp)
list(SORT shaders)
set(texts "")
set(entries "")
set(number 0)
foreach(shader ${shaders})
  # Bytes rather than a literal: no character can end it, and it may be of any length.
  file(READ ${FOLDER}/${shader} digits HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${digits}")
  string(APPEND texts "const unsigned char kText${number}[] = {${bytes}};\n")
  string(APPEND entries "      {\"${shader}\", text(kText${number})},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT} "#include \"gpu/embedded_shaders.h\"

#include <cstddef>

namespace tidemark::gpu {
namespace {

template <std::size_t kLength>
std::string_view text(const unsigned char (&bytes)[kLength]) {
  return {reinterpret_cast<const char*>(bytes), kLength};
}

${texts}
}  // namespace

std::span<const EmbeddedShader> embedded_shaders() {
  static const EmbeddedShader kShaders[] = {
${entries}  };
  return kShaders;
}

}  // namespace tidemark::gpu
")
