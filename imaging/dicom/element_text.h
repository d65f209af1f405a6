// The text of a DICOM element, in time that is linear in its length: what DCMTK's own getOFStringArray() does
// takes the square of the number of values, so that 64 KB of backslashes keep it busy for seconds.
#pragma once

#include <cstddef>
#include <string>

class DcmElement;
class DcmItem;
class DcmTagKey;

namespace tidemark::imaging {

// No attribute that is read as text is longer; of the longest (a vector that says of 65,535 frames which
// slice each is) half as much is in use.
inline constexpr std::size_t kLongestText = std::size_t{1} << 20;

// Values with backslashes between them, whatever their representation, each without the blanks around it; in
// representations of one value (LT, ST, UT) a backslash is a letter. Ends before the first NUL. Empty when it
// has no text, or is longer than kLongestText.
[[nodiscard]] std::string element_text(DcmElement& element);

// Of the item's own element with that tag; empty when there is none.
[[nodiscard]] std::string element_text(DcmItem& item, const DcmTagKey& key);

}  // namespace tidemark::imaging
