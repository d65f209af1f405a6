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

# The target's files are compiled with these headers read beforehand, which takes a third to a half off. It changes nothing else: every file still includes what it uses.
#   tidemark_precompile(target header...)
function(tidemark_precompile target)
  target_precompile_headers(${target} PRIVATE ${ARGN})
  tidemark_cache_precompiled(${target})
endfunction()

# A file that a command of this folder makes out of the project's own files. Ninja lets a command wait for what all
# targets with its output wait for. One more target, which waits for nothing, spares it the libraries of the others.
function(tidemark_wait_for_nothing file)
  cmake_path(GET file FILENAME name)
  add_custom_target(make_${name} DEPENDS ${file})
endfunction()

# The target's headers go through Qt's moc.
function(tidemark_moc target)
  get_target_property(qt_moc Qt6::moc LOCATION)
  configure_file(${CMAKE_SOURCE_DIR}/cmake/moc_alone.in ${CMAKE_BINARY_DIR}/moc_alone @ONLY)
  set_target_properties(${target} PROPERTIES AUTOMOC ON AUTOMOC_EXECUTABLE ${CMAKE_BINARY_DIR}/moc_alone
    AUTOGEN_ORIGIN_DEPENDS OFF)  # it reads no file that a library makes
endfunction()

# For code whose time goes into what it calls: a test, a command, a panel.
set(TIDEMARK_COMPILED_QUICKLY $<$<CONFIG:Release>:-O1>)

# A test's code: GCC compiles it in four fifths of the time with -Og, and in no less with -O0. It then finds values
# uninitialized in the standard library that are not.
set(TIDEMARK_TEST_OPTIONS $<$<CONFIG:Release>:-Og>
    $<$<AND:$<CONFIG:Release>,$<COMPILE_LANG_AND_ID:CXX,GNU>>:-Wno-maybe-uninitialized>)
# lld links a test program in a tenth of the time.
find_program(TIDEMARK_LLD ld.lld)
mark_as_advanced(TIDEMARK_LLD)
set(TIDEMARK_TEST_LINK_OPTIONS $<$<BOOL:${TIDEMARK_LLD}>:-fuse-ld=lld>)
if(CMAKE_UNITY_BUILD)
  # In a joined file a test's own types seem to be of a header.
  list(APPEND TIDEMARK_TEST_OPTIONS $<$<COMPILE_LANG_AND_ID:CXX,GNU>:-Wno-subobject-linkage>)
endif()

# A target that is nothing but these headers, read once for all the targets that take them over.
#   tidemark_headers(target [OPTIONS compiler's option...] LINKS lib... HEADERS header...)
function(tidemark_headers target)
  cmake_parse_arguments(arg "" "" "OPTIONS;LINKS;HEADERS" ${ARGN})
  set(file ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  file(CONFIGURE OUTPUT ${file} CONTENT "// Precompiled headers belong to a target, and a target has a file.\n")
  add_library(${target} STATIC ${file})
  target_compile_options(${target} PRIVATE ${arg_OPTIONS})
  target_link_libraries(${target} PRIVATE ${arg_LINKS})
  tidemark_precompile(${target} ${arg_HEADERS})
endfunction()

# Takes over the precompiled headers of another target; both are compiled with the same options.
function(tidemark_take_headers target from)
  target_precompile_headers(${target} REUSE_FROM ${from})
  tidemark_cache_precompiled(${target})
endfunction()

# Of a library that talks to people, files and servers, and computes nothing of its own.
function(tidemark_compile_quickly target)
  target_compile_options(${target} PRIVATE ${TIDEMARK_COMPILED_QUICKLY})
  tidemark_take_headers(${target} tidemark_quick_headers)
endfunction()

# A precompiled header is the same for ccache (cmake/compile_cached) each time it is made of the same.
function(tidemark_cache_precompiled target)
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
                         "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endfunction()

# A test program: one for a folder, of as many test classes as its folder has (tests/support/test_program.h).
#   tidemark_test_program(name [WINDOWS] [MAIN lib] [HEADERS target] [RUNS program...] [SOURCES helper.cpp...] LINKS lib...)
# WINDOWS: it runs on a screen of its own that nobody sees. RUNS: it starts these programs of ours. MAIN: who has main();
# HEADERS: whose precompiled headers it takes over. Both have a suitable default; HEADERS NONE is for programs that see
# Qt Gui without Qt's widgets.
function(tidemark_test_program name)
  cmake_parse_arguments(arg "WINDOWS" "MAIN;HEADERS" "RUNS;SOURCES;LINKS" ${ARGN})
  if(NOT arg_MAIN)
    set(arg_MAIN $<IF:$<BOOL:${arg_WINDOWS}>,tidemark_window_test_main,tidemark_test_main>)
  endif()
  if(NOT arg_HEADERS)
    set(arg_HEADERS tidemark_test_headers)
    if(arg_WINDOWS)
      set(arg_HEADERS tidemark_window_test_headers)
    endif()
  endif()
  add_executable(${name} ${arg_SOURCES})
  if(NOT arg_HEADERS STREQUAL NONE)
    tidemark_take_headers(${name} ${arg_HEADERS})
  endif()
  target_compile_options(${name} PRIVATE ${TIDEMARK_TEST_OPTIONS})
  target_link_options(${name} PRIVATE ${TIDEMARK_TEST_LINK_OPTIONS})
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
  if(arg_RUNS)
    add_dependencies(${name} ${arg_RUNS})
    list(TRANSFORM arg_RUNS REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE programs)
    set_target_properties(${name} PROPERTIES TIDEMARK_RUNS "${programs}")
  endif()
  if(arg_WINDOWS)
    set_target_properties(${name} PROPERTIES
      CROSSCOMPILING_EMULATOR "xvfb-run;-a;-s;-screen 0 2600x1700x24 -nolisten tcp")
  endif()
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR})
  target_link_libraries(${name} PRIVATE ${arg_MAIN} tidemark_test_support Qt6::Test ${arg_LINKS})
endfunction()

# The programs that have a test with the label "quick".
add_custom_target(quick_tests)

# Test classes of a program, each in a file of its own and known to ctest by the file's name. They are named in the
# folder that makes the program: the output of Qt's moc is known there alone.
#   tidemark_tests(program [LABELS label...] TESTS [folder/]name...)
# Tests of programs with windows have the label "windows" as well. Tests with the label "waits" wait for other programs
# or the disk most of their time.
function(tidemark_tests program)
  cmake_parse_arguments(arg "" "" "LABELS;TESTS" ${ARGN})
  foreach(test ${arg_TESTS})
    cmake_path(GET test FILENAME name)
    # By name: to look through its files would take longer than to compile some of them.
    qt_generate_moc(${test}.cpp ${CMAKE_CURRENT_BINARY_DIR}/${name}.moc)
    tidemark_wait_for_nothing(${CMAKE_CURRENT_BINARY_DIR}/${name}.moc)
    target_sources(${program} PRIVATE ${test}.cpp ${CMAKE_CURRENT_BINARY_DIR}/${name}.moc)
    target_include_directories(${program} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
    tidemark_ctest(${name} ${program} LABELS ${arg_LABELS} ARGUMENTS ${name})
  endforeach()
  if(quick IN_LIST arg_LABELS)
    add_dependencies(quick_tests ${program})
  endif()
endfunction()

# A run of a test program that ctest knows by a name: tidemark_ctest(name program [LABELS ...] [ARGUMENTS ...] [ENVIRONMENT ...])
function(tidemark_ctest name program)
  cmake_parse_arguments(arg "" "" "LABELS;ARGUMENTS;ENVIRONMENT" ${ARGN})
  add_test(NAME ${name} COMMAND ${program} ${arg_ARGUMENTS})
  # Qt Test would end a function after five minutes, which is short under a sanitizer.
  set(environment QTEST_FUNCTION_TIMEOUT=900000 ${arg_ENVIRONMENT})
  get_target_property(screen ${program} CROSSCOMPILING_EMULATOR)
  if(screen)
    list(APPEND arg_LABELS windows)
    list(APPEND environment QT_QPA_PLATFORM=xcb)
  endif()
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT 900 SKIP_RETURN_CODE 77
                       ENVIRONMENT "${environment}")
  if(waits IN_LIST arg_LABELS)
    # One at a time, from the beginning: several at once would leave the processors idle.
    set_tests_properties(${name} PROPERTIES RESOURCE_LOCK waits COST 40)
  endif()
  get_target_property(programs ${program} TIDEMARK_RUNS)
  if(programs)
    # tests/run_changed.py looks at them, too.
    set_tests_properties(${name} PROPERTIES REQUIRED_FILES "${programs}")
  endif()
endfunction()

# What includes a library's templates that a check of the sanitizers refuses. OpenVDB's trees hold TBB's hash map, which
# casts what is no iterator yet: alignment. ITK's iterators go on from null before they are placed: pointer-overflow.
#   tidemark_spare(target check source...)
function(tidemark_spare target check)
  if(TIDEMARK_SANITIZE)
    set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS -fno-sanitize=${check})
  endif()
endfunction()

# tidemark_kernels(target sources...): vectorised numerics, the solver's and those it is measured against. Mirrored
# fields give mirrored results to the last bit only if the compiler fuses nothing by itself. On x86 GCC does not order
# instructions before it allocates registers unless it is told to; then less goes through memory.
function(tidemark_kernels target)
  set(options -ffp-contract=off)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    list(APPEND options -fschedule-insns -fsched-pressure)
  endif()
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES COMPILE_OPTIONS "${options}")
endfunction()
