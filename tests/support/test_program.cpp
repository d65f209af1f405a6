#include "tests/support/test_program.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <string>

namespace tidemark::test {
namespace {

// Made at the first registration: the order in which files are initialised is not known.
std::map<std::string, TestFunction>& tests_by_name() {
  static std::map<std::string, TestFunction> tests;
  return tests;
}

}  // namespace

RegisteredTest::RegisteredTest(const char* file, TestFunction run) {
  tests_by_name().emplace(std::filesystem::path(file).stem().string(), run);
}

int run_named_test(int argc, char** argv) {
  const auto found = argc > 1 ? tests_by_name().find(argv[1]) : tests_by_name().end();
  if (found != tests_by_name().end()) return found->second(argc - 1, argv + 1);
  std::fprintf(stderr, "Usage: %s TEST [FUNCTION...]\nTests:\n", argv[0]);
  for (const auto& [name, run] : tests_by_name()) std::fprintf(stderr, "  %s\n", name.c_str());
  return 2;
}

}  // namespace tidemark::test
