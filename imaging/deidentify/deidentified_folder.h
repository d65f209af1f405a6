// De-identified copies in a folder, with the list of what was changed and the key that undoes it.
#pragma once

#include "imaging/deidentify/deidentify.h"

namespace tidemark::imaging {

struct DeidentifyPlaces {
  std::filesystem::path source;  // the file or folder that is read
  std::filesystem::path folder;  // gets the copies: a new or an empty one
  std::filesystem::path list;    // .csv or .json; empty: none
  std::filesystem::path key;     // .json, for its owner alone; empty: none
};

// Neither the list nor the key lies in the source or in the folder, and a key is not overwritten. Fails
// (ErrorKind::usage) naming the place.
[[nodiscard]] Status check_places(const DeidentifyPlaces& places);

// As deidentify(), after check_places(); the folder, the list and the key are there when it returns, or none
// of them. The list is JSON where its name does not end in .csv.
[[nodiscard]] Result<Deidentified> write_deidentified(const std::vector<std::filesystem::path>& files,
                                                      const DeidentifyPlaces& places,
                                                      DeidentifyOptions options,
                                                      const Progress& progress = {});

}  // namespace tidemark::imaging
