// JPEG 2000 for DCMTK, which has no codec for it.
#pragma once

namespace tidemark::imaging {

// Registers a decoder for the transfer syntaxes JPEG 2000 (lossless only and lossy) with DCMTK. To be called
// once.
void register_j2k_decoder();

}  // namespace tidemark::imaging
