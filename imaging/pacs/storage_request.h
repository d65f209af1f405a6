// An object that the peer sends us.
#pragma once

#include "core/result.h"
#include "imaging/pacs/association.h"
#include "imaging/pacs/retrieval_folder.h"

namespace tidemark::imaging {

// Answers a C-STORE request that came on `context`: takes the object into the retrieval_folder, or lets it
// pass and refuses it. Fails where the conversation cannot go on.
Status answer_storage_request(Association& association, int context, const T_DIMSE_Message& request,
                              RetrievalFolder& retrieval_folder, const PacsLimits& limits);

}  // namespace tidemark::imaging
