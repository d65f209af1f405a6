# Resources as text inside the program.
#   embed_files(embedded_shaders.cpp FOLDER resources/shaders PATTERNS *.frag *.vert HEADER gpu/embedded_shaders.h
#               NAMESPACE tidemark::gpu TYPE EmbeddedShader FUNCTION embedded_shaders [WITHOUT .frag])
# makes a C++ file, written anew when a file changes: NAMESPACE::FUNCTION() gives a span of TYPE, both declared in
# HEADER, with the path below FOLDER (less the ending WITHOUT) and the text of each file.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  function(embed_files output)
    cmake_parse_arguments(arg "" "FOLDER;HEADER;NAMESPACE;TYPE;FUNCTION;WITHOUT" "PATTERNS" ${ARGN})
    set(folder ${CMAKE_SOURCE_DIR}/${arg_FOLDER})
    set(script ${CMAKE_SOURCE_DIR}/cmake/EmbedFiles.cmake)
    list(TRANSFORM arg_PATTERNS PREPEND ${folder}/ OUTPUT_VARIABLE patterns)
    file(GLOB_RECURSE files CONFIGURE_DEPENDS ${patterns})
    list(JOIN arg_PATTERNS "," patterns)
    add_custom_command(
      OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${output}
      COMMAND ${CMAKE_COMMAND} -DOUTPUT=${CMAKE_CURRENT_BINARY_DIR}/${output} -DFOLDER=${folder}
              "-DPATTERNS=${patterns}" -DHEADER=${arg_HEADER} -DNAMESPACE=${arg_NAMESPACE} -DTYPE=${arg_TYPE}
              -DFUNCTION=${arg_FUNCTION} "-DWITHOUT=${arg_WITHOUT}" -P ${script}
      DEPENDS ${files} ${script}
      COMMENT "Embedding ${arg_FOLDER}"
      VERBATIM)
    tidemark_wait_for_nothing(${CMAKE_CURRENT_BINARY_DIR}/${output})
  endfunction()
  return()
endif()

string(REPLACE "," ";" patterns "${PATTERNS}")
list(TRANSFORM patterns PREPEND ${FOLDER}/)
file(GLOB_RECURSE files RELATIVE ${FOLDER} ${patterns})
list(SORT files)
set(texts "")
set(entries "")
set(number 0)
foreach(file ${files})
  # Bytes rather than a literal: no character can end it, and it may be of any length.
  file(READ ${FOLDER}/${file} digits HEX)
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${digits}")
  string(APPEND texts "const unsigned char kText${number}[] = {${bytes}};\n")
  string(REGEX REPLACE "^(.+)${WITHOUT}$" "\\1" name "${file}")
  string(APPEND entries "      {\"${name}\", text(kText${number})},\n")
  math(EXPR number "${number} + 1")
endforeach()
file(WRITE ${OUTPUT} "#include \"${HEADER}\"

#include <cstddef>

namespace ${NAMESPACE} {
namespace {

template <std::size_t kLength>
std::string_view text(const unsigned char (&bytes)[kLength]) {
  return {reinterpret_cast<const char*>(bytes), kLength};
}

${texts}
}  // namespace

std::span<const ${TYPE}> ${FUNCTION}() {
  static const ${TYPE} kFiles[] = {
${entries}  };
  return kFiles;
}

}  // namespace ${NAMESPACE}
")
