// The fate of an attribute, by Table E.1-1 of DICOM PS3.15 (profile_table.inc).
#pragma once

#include <string_view>

#include "imaging/deidentify/options.h"
#include "imaging/guard/dicom/tag_walk.h"

namespace tidemark::imaging {

enum class Fate {
  keep,     // a sequence's items are looked at each by itself
  remove,   // with all that is in it
  empty,    // the attribute stays, without a value
  replace,  // by a value that says nothing; in a sequence each text is
  map_uid,  // by another UID, the same for the same
  shift,    // a date, by the patient's days
};

// `representation` is the data dictionary's, two letters, empty for an attribute that the dictionary does not
// have.
//
// Where the table leaves a choice (X/Z, X/D, X/Z/D, Z/D: what the object's definition needs is to stay) a
// value is replaced, else emptied, because that suits every definition; a sequence is removed where it may
// be. X/Z/U* keeps the sequence, with other UIDs in it. Beyond the table these go, too: whatever the
// dictionary does not know, groups 60xx as a whole, and addresses (UR) that no row names. Names of persons
// (PN), dates, times and free text (LT, ST, UT) that no row names are replaced, and UIDs mapped.
[[nodiscard]] Fate fate_of(DicomTag tag, std::string_view representation, const DeidentifyOptions& options);

}  // namespace tidemark::imaging
