# One library a folder. A folder's headers are included as "folder/file.h" and are visible only to the
# targets that link the folder: each library publishes a directory of its own that holds nothing but a
# link to its folder. A wrong include therefore does not compile.

function(tidemark_library target folder)
  add_library(${target} STATIC ${ARGN})
  set(public_include ${CMAKE_BINARY_DIR}/include/${target})
  cmake_path(GET folder PARENT_PATH parent)
  file(MAKE_DIRECTORY ${public_include}/${parent})
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${folder} ${public_include}/${folder} SYMBOLIC)
  target_include_directories(${target} PUBLIC ${public_include})
endfunction()

# A test program of its own, run by Qt Test and registered with ctest under its name.
#   tidemark_test(name SOURCES a.cpp LINKS lib... [LABELS quick])
function(tidemark_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LINKS;LABELS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  set_target_properties(${name} PROPERTIES AUTOMOC ON RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  target_link_libraries(${name} PRIVATE tidemark_test_support Qt6::Test ${arg_LINKS})
  add_test(NAME ${name} COMMAND ${name})
  # Qt Test would end a function after five minutes, which is short under a sanitizer.
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT 900 SKIP_RETURN_CODE 77
                       ENVIRONMENT QTEST_FUNCTION_TIMEOUT=900000)
endfunction()

# A test that opens windows: the same, on a screen of its own that nobody sees. Its label is windows, whatever it
# is given: the sanitizers' build leaves the widgets out.
function(tidemark_gui_test name)
  tidemark_test(${name} ${ARGN})
  set_property(TARGET ${name} PROPERTY CROSSCOMPILING_EMULATOR
               xvfb-run -a -s "-screen 0 2600x1700x24 -nolisten tcp")
  set_property(TEST ${name} PROPERTY LABELS windows)
  set_property(TEST ${name} APPEND PROPERTY ENVIRONMENT QT_QPA_PLATFORM=xcb)
endfunction()
