// DCMTK's settings before its first use in a process.
#pragma once

#include "core/result.h"

namespace tidemark::imaging {

// Silences DCMTK's log, registers the decoders and checks that the data dictionary is there. Safe to call
// from any thread, as often as one likes. Fails (ErrorKind::capability) without a data dictionary: files with
// implicit value representation could not be read.
[[nodiscard]] Status set_up_dicom();

}  // namespace tidemark::imaging
