// The use of ITK's image IO classes, common to reading and writing. Private to this folder.
#pragma once

#include <itkImageIOBase.h>

#include <locale.h>

#include <filesystem>

#include "core/unfinished.h"
#include "imaging/guard/pixel_layout.h"

namespace tidemark::imaging::files {

// While one lives, this thread parses and prints numbers with '.', and ITK prints no warnings.
class ItkScope {
 public:
  ItkScope();
  ~ItkScope();
  ItkScope(const ItkScope&) = delete;
  ItkScope& operator=(const ItkScope&) = delete;

 private:
  locale_t numbers_;
  locale_t before_;
};

// The IO class of the format, with its file name set. ITK's factories are not used: they depend on what a
// program has registered.
itk::ImageIOBase::Pointer make_image_io(Format format, const std::filesystem::path& file);

// A name under which ITK reads or writes a file. Its NIfTI and GIPL classes, and the others when they write,
// go by suffixes of one case. A file with a suffix in another case is linked under such a name in a temporary
// folder, which the object removes.
class ItkName {
 public:
  enum class Use { read, write };
  // Fails (ErrorKind::write) when there is no such folder to be had.
  static Result<ItkName> create(Format format, const std::filesystem::path& file, Use use);
  ~ItkName();
  ItkName(ItkName&& other) noexcept;
  ItkName& operator=(ItkName&& other) noexcept;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  ItkName() = default;
  std::filesystem::path path_;
  std::filesystem::path folder_;  // empty when the file is read under its own name
  Unfinished unfinished_;
};

// The text of an ITK exception, on one line, without the source locations that ITK puts first.
std::string one_line(const std::exception& exception);

}  // namespace tidemark::imaging::files
