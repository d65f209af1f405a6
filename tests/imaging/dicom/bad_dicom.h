// The one check that every test of bad DICOM files makes.
#pragma once

#include <string>
#include <vector>

#include "tests/support/support.h"

namespace tidemark::test {

struct BadDicom {
  std::string what;
  std::string bytes;
  std::string field;  // must be in the message
};

// The columns of a test function's table, and a row a file. Says how many there are.
void add_rows(const std::vector<BadDicom>& files);

// Takes the row's file through everything that reads DICOM: each must refuse it within a second, in one line
// that names the file and the field.
void verify_refused();

}  // namespace tidemark::test
