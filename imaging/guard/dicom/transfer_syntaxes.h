// The transfer syntaxes that are read, and what their UIDs say (DICOM PS3.5 10, PS3.6 A).
#pragma once

#include <string_view>

namespace tidemark::imaging {

// The compression of pixels in fragments.
enum class FrameCoding { native, rle, jpeg, jpeg_ls, jpeg_2000 };

struct TransferSyntax {
  std::string_view uid;
  std::string_view name;
  bool is_explicit = true;  // every element states its value representation
  bool is_big_endian = false;
  bool is_deflated = false;
  bool is_read = true;
  FrameCoding frames = FrameCoding::native;
  bool is_lossy = false;  // pixels may lose by it

  [[nodiscard]] bool is_encapsulated() const { return frames != FrameCoding::native; }
};

// Null for a UID that is neither read nor known by name.
[[nodiscard]] const TransferSyntax* find_transfer_syntax(std::string_view uid);

inline constexpr std::string_view kImplicitLittleEndian = "1.2.840.10008.1.2";
inline constexpr std::string_view kExplicitLittleEndian = "1.2.840.10008.1.2.1";
inline constexpr std::string_view kExplicitBigEndian = "1.2.840.10008.1.2.2";

}  // namespace tidemark::imaging
