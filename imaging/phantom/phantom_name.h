// A phantom by one word: its kind, and its noise where that is not the usual one.
#pragma once

#include <string>
#include <string_view>

#include "imaging/phantom/phantom.h"

namespace tidemark::imaging {

struct PhantomName {
  std::string kind;
  PhantomOptions options;
};

// "sphere", or "sphere:20" with noise of 20 % of the brightest tissue. Fails (ErrorKind::usage) on an unknown
// kind, or noise that is no number from 0 to 100.
Result<PhantomName> parse_phantom_name(std::string_view name);

}  // namespace tidemark::imaging
