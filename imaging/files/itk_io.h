// What reading and writing through ITK's image IO classes have in common. Private to this folder.
#pragma once

#include <itkImageIOBase.h>

#include <locale.h>

#include <filesystem>

#include "imaging/files/pixel_layout.h"

namespace tidemark::files {

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

// What an ITK exception says, on one line, without the source locations that ITK puts first.
std::string one_line(const std::exception& exception);

}  // namespace tidemark::files
