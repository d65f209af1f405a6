// The changes of a file's attributes, without their old values.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tidemark::imaging {

enum class Change { removed, emptied, replaced, shifted, added };
inline constexpr std::array<std::string_view, 5> kChangeNames{"removed", "emptied", "replaced", "shifted",
                                                              "added"};

struct ChangedAttribute {
  std::string path;     // "(0008,1140)[1].(0008,1155)": items count from 1
  std::string keyword;  // the data dictionary's; "private", "unknown"
  Change change = Change::removed;
};

// What became of an attribute, in how many values of all files.
struct ChangeTotal {
  ChangedAttribute attribute;  // its path without the numbers of items
  std::int64_t values = 0;
};

struct ChangeCounts {
  std::array<std::int64_t, kChangeNames.size()> of{};

  std::int64_t& operator[](Change change) { return of[static_cast<std::size_t>(change)]; }
  std::int64_t operator[](Change change) const { return of[static_cast<std::size_t>(change)]; }
};

}  // namespace tidemark::imaging
