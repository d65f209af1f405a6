// The masks of a cohort as a dataset of BIDS derivatives.
#pragma once

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "document/cohort/review.h"

namespace tidemark::cohort {

struct BidsOptions {
  std::string source;   // the folder of the raw dataset; its studies keep their places
  std::string program;  // version
};

// Whether a dataset may be written to that folder: what is there would be lost. It is new, empty, or an
// earlier dataset of write_bids() of the same source, with nothing else in it. It neither lies in the
// cohort's folder or the source, nor holds one of them; but it may lie in the source's derivatives/. Fails
// (ErrorKind::usage).
Status check_bids_folder(const CohortFolder& folder, const std::string& source,
                         const std::filesystem::path& to);

// sub-X/[ses-Y/]anat/..._desc-tidemarkT1w_mask.nii.gz with a .json beside it, of each case with a result, and
// dataset_description.json with GeneratedBy and SourceDatasets (BIDS 1.9, derivatives). A case that is not
// from BIDS is a subject of its own, named by the letters and digits of its id. The folder takes the place of
// an older one when all is in it. Returns how many masks there are. Fails as check_bids_folder() does, with
// ErrorKind::write, and with ErrorKind::cancelled.
Result<std::int64_t> write_bids(const CohortFolder& folder, const Review& review, const BidsOptions& options,
                                const std::filesystem::path& to, const Progress& progress = {});

}  // namespace tidemark::cohort
