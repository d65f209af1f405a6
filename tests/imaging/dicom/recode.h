// DICOM files in other transfer syntaxes.
#pragma once

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace tidemark::test {

// Registers DCMTK's encoders, which recode() needs. To be called once.
void register_encoders();

// Saves the file again in another transfer syntax; false when that fails, and where a picture is too small
// for JPEG-LS: DCMTK's encoder (3.6.7) writes beyond its buffer where a stream is longer than the pixels.
bool recode(const std::filesystem::path& file, E_TransferSyntax syntax, bool is_signed);

// A JPEG 2000 codestream of one component; empty on failure.
std::vector<std::uint8_t> encode_j2k(const std::vector<std::int32_t>& values, int columns, int rows,
                                     int precision, bool is_signed, bool lossy);

// Replaces the pixel data by a codestream in `fragments` pieces.
void encapsulate(DcmDataset& dataset, E_TransferSyntax syntax, std::vector<std::uint8_t> stream,
                 int fragments);

}  // namespace tidemark::test
