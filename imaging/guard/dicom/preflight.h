// The check of a DICOM file before DCMTK sees it. DCMTK recurses into sequences until the stack ends,
// believes lengths, and inflates any stream; nothing here does, and no type of DCMTK is used.
//
// Memory: a window of some kilobytes, whatever the file says. Limits: sequences 64 deep; a deflated dataset
// of 64 MiB; elements for which DCMTK takes 64 MiB and as many bytes as the file has; compressed frames of
// 4096 times their file.
//
// With sequences 64 deep DCMTK needs no thread of its own with a large stack: they were seen to fit one of
// 128 KiB, where 2,000 end one of 1 MiB.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "imaging/guard/dicom/tag_walk.h"
#include "imaging/guard/dicom/transfer_syntaxes.h"

namespace tidemark::imaging {

struct Preflight {
  enum class Verdict {
    good,
    bad_pixels,      // may be parsed, but PixelData cannot be what the header promises
    unknown_syntax,  // must not be parsed: the transfer syntax is none that is read
    damaged,         // must not be parsed
    not_dicom,       // the same: it does not begin as DICOM does (check_dicom())
  };
  Verdict verdict = Verdict::good;
  TagDamage reason;  // unless good; the tag (0000,0000) stands for the dataset itself
  // The syntax that the file names, or that its first element shows when it names none. Not null when the
  // file may be parsed.
  const TransferSyntax* syntax = nullptr;
  // SeriesInstanceUID (0020,000E), also of a damaged file if the damage comes after it; else empty.
  std::string series_uid;
  // Where PixelData is, in the dataset's bytes: the file's, or those that a deflated one inflates to from
  // `dataset` on. Nothing without PixelData.
  std::optional<ElementHeader> pixels;
  std::optional<Fragments> fragments;  // of compressed pixels
  std::int64_t dataset = 0;            // its offset; meaningful when the file may be parsed

  [[nodiscard]] bool may_be_parsed() const {
    return verdict == Verdict::good || verdict == Verdict::bad_pixels;
  }
};

// Beyond what a deflated dataset may not inflate.
inline constexpr std::int64_t kLargestInflation = std::int64_t{64} << 20;

[[nodiscard]] Preflight preflight_dicom(ByteSource& bytes);

// The same of a file that nothing but the walk is going to read, through `observe`: any number of elements is
// good, as no parser makes objects of them. When `observe` ends the walk the file counts as damaged.
[[nodiscard]] Preflight walk_dicom(ByteSource& bytes, const TagWalk::Observer& observe);

}  // namespace tidemark::imaging
