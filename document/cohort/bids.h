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

// sub-X/[ses-Y/]anat/..._desc-tidemarkT1w_mask.nii.gz with a .json beside it, of each case with a result, and
// dataset_description.json with GeneratedBy and SourceDatasets (BIDS 1.9, derivatives). A case that is not
// from BIDS is a subject of its own, named by the letters and digits of its id. The folder takes the place of
// an older one when all is in it. Returns how many masks there are. Fails with ErrorKind::write, and with
// ErrorKind::cancelled.
Result<std::int64_t> write_bids(const CohortFolder& folder, const Review& review, const BidsOptions& options,
                                const std::filesystem::path& to, const Progress& progress = {});

}  // namespace tidemark::cohort
