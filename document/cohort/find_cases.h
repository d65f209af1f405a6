// The cases of a cohort, found in a folder or in a list, and what is wrong with them before anything is
// computed.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "core/progress.h"
#include "document/cohort/pacs_cases.h"
#include "document/cohort/shared_recipe.h"
#include "document/cohort/work_list.h"

namespace tidemark::cohort {

struct FindOptions {
  // In folders: the inputs that count, by file name or by path below the folder (as the shell's *.nii.gz);
  // empty: all.
  std::string match;
  // In folders: a file beside each input, from its folder on, {name} being the input's without its suffix:
  // "{name}_mask.nii.gz", "../truth.nii.gz". Where there is none the case has none. Empty: none.
  std::string mask, truth;
  PacsQuery query;                     // of servers
  imaging::PacsConfiguration servers;  // for "pacs:SERVER", and for lists that name servers
};

struct FoundCases {
  std::string source;  // "folder", "bids", "list", "cohort" or "pacs"
  std::string place;   // where it was looked: an absolute path, or "pacs:SERVER"
  WorkList list;
  std::map<std::string, Geometry> grids;  // of inputs whose headers were read, by their path
  std::vector<std::string> left_out;      // what was found and is no case, one sentence each
  std::vector<std::string> remarks;       // on recipes of rows: what is left out of them, one sentence each
};

// In a list (.csv), in the work list of another cohort, on a server ("pacs:SERVER"), in BIDS (a folder with
// dataset_description.json: sub-*/[ses-*/]anat), or in any folder: each series that can be loaded. No voxels
// are read. Fails (ErrorKind::input) where there are none; (ErrorKind::usage) for an unknown server.
Result<FoundCases> find_cases(const std::string& source, const FindOptions& options,
                              const Progress& progress = {});

// Adds what is wrong with rows to the list's problems: files that are not there, headers that are refused,
// servers that are not known, starts outside of the volume, and what is missing for a run with that recipe
// (null: none). Recipes of rows may hold no edits, unless `without_edits` leaves them out; what is left out
// of them is among the remarks. `file` names the list. Of DICOM no header is read: finding them has done so,
// or a run will. Returns whether each row is good.
std::vector<bool> check_cases(FoundCases& found, const std::string& file, const SharedRecipe* recipe,
                              bool without_edits, const imaging::PacsConfiguration& servers,
                              const Progress& progress = {});

}  // namespace tidemark::cohort
