#include "imaging/guard/dicom/transfer_syntaxes.h"

#include <algorithm>

namespace tidemark::imaging {
namespace {

constexpr TransferSyntax native(std::string_view uid, std::string_view name, bool is_explicit, bool is_big,
                                bool is_deflated) {
  return {uid, name, is_explicit, is_big, is_deflated, true, FrameCoding::native};
}
constexpr TransferSyntax compressed(std::string_view uid, std::string_view name, FrameCoding frames) {
  return {uid, name, true, false, false, true, frames};
}
constexpr TransferSyntax lossy(std::string_view uid, std::string_view name, FrameCoding frames) {
  return {uid, name, true, false, false, true, frames, true};
}
// For its name in the refusal.
constexpr TransferSyntax refused(std::string_view uid, std::string_view name) {
  return {uid, name, true, false, false, false, FrameCoding::jpeg};
}

constexpr TransferSyntax kSyntaxes[] = {
    native(kImplicitLittleEndian, "Little Endian Implicit", false, false, false),
    native(kExplicitLittleEndian, "Little Endian Explicit", true, false, false),
    native("1.2.840.10008.1.2.1.99", "Deflated Explicit VR Little Endian", true, false, true),
    native(kExplicitBigEndian, "Big Endian Explicit", true, true, false),
    compressed("1.2.840.10008.1.2.5", "RLE Lossless", FrameCoding::rle),
    lossy("1.2.840.10008.1.2.4.50", "JPEG Baseline", FrameCoding::jpeg),
    lossy("1.2.840.10008.1.2.4.51", "JPEG Extended, Process 2+4", FrameCoding::jpeg),
    lossy("1.2.840.10008.1.2.4.53", "JPEG Spectral Selection, Process 6+8", FrameCoding::jpeg),
    lossy("1.2.840.10008.1.2.4.55", "JPEG Full Progression, Process 10+12", FrameCoding::jpeg),
    compressed("1.2.840.10008.1.2.4.57", "JPEG Lossless, Non-hierarchical, Process 14", FrameCoding::jpeg),
    compressed("1.2.840.10008.1.2.4.70", "JPEG Lossless, Non-hierarchical, 1st Order Prediction",
               FrameCoding::jpeg),
    compressed("1.2.840.10008.1.2.4.80", "JPEG-LS Lossless", FrameCoding::jpeg_ls),
    lossy("1.2.840.10008.1.2.4.81", "JPEG-LS Lossy (Near-lossless)", FrameCoding::jpeg_ls),
    compressed("1.2.840.10008.1.2.4.90", "JPEG 2000 (Lossless only)", FrameCoding::jpeg_2000),
    lossy("1.2.840.10008.1.2.4.91", "JPEG 2000 (Lossless or Lossy)", FrameCoding::jpeg_2000),
    refused("1.2.840.10008.1.2.4.201", "High-Throughput JPEG 2000 (Lossless only)"),
    refused("1.2.840.10008.1.2.4.202", "High-Throughput JPEG 2000 with RPCL Options (Lossless only)"),
    refused("1.2.840.10008.1.2.4.203", "High-Throughput JPEG 2000"),
    refused("1.2.840.10008.1.2.4.92", "JPEG 2000 Part 2 Multi-component (Lossless only)"),
    refused("1.2.840.10008.1.2.4.93", "JPEG 2000 Part 2 Multi-component"),
    refused("1.2.840.10008.1.2.4.94", "JPIP Referenced"),
    refused("1.2.840.10008.1.2.4.95", "JPIP Referenced Deflate"),
    refused("1.2.840.10008.1.2.4.100", "MPEG2 Main Profile / Main Level"),
    refused("1.2.840.10008.1.2.4.101", "MPEG2 Main Profile / High Level"),
    refused("1.2.840.10008.1.2.4.102", "MPEG-4 AVC/H.264 High Profile / Level 4.1"),
    refused("1.2.840.10008.1.2.4.103", "MPEG-4 AVC/H.264 BD-compatible"),
    refused("1.2.840.10008.1.2.4.107", "HEVC/H.265 Main Profile / Level 5.1"),
    refused("1.2.840.10008.1.2.4.110", "JPEG XL Lossless"),
    refused("1.2.840.10008.1.2.4.111", "JPEG XL JPEG Recompression"),
    refused("1.2.840.10008.1.2.4.112", "JPEG XL"),
    refused("1.2.840.113619.5.2", "GE Private Implicit Little Endian with Big Endian Pixels"),
};

}  // namespace

const TransferSyntax* find_transfer_syntax(std::string_view uid) {
  const auto* const found =
      std::find_if(std::begin(kSyntaxes), std::end(kSyntaxes), [&](const auto& s) { return s.uid == uid; });
  return found != std::end(kSyntaxes) ? found : nullptr;
}

}  // namespace tidemark::imaging
