// The one check that every test of bad volume files makes.
#pragma once

#include <string>
#include <vector>

#include "tests/support/support.h"

namespace tidemark::test {

struct BadFile {
  const char* what;
  const char* name;
  std::string bytes;
  const char* field;  // must be in the message
};

// The columns of a test function's table, and a row a file. Says how many there are.
void add_rows(const std::vector<BadFile>& files);

// The row's file is refused by a scan and a read, within a second, in one line that names the file and the
// field.
void verify_volume_refused();

std::string gzip(const std::string& bytes);
// Of 2 x 2 x 2 floats, the one at (1, 0, 1) is bad.
std::string float_voxels(float bad);

}  // namespace tidemark::test
