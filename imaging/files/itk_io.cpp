#include "imaging/files/itk_io.h"

#include <itkGiplImageIO.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>

namespace tidemark::files {

ItkScope::ItkScope() : numbers_(newlocale(LC_NUMERIC_MASK, "C", duplocale(uselocale(nullptr)))) {
  before_ = uselocale(numbers_);
  itk::Object::GlobalWarningDisplayOff();
}

ItkScope::~ItkScope() {
  uselocale(before_);
  if (numbers_ != nullptr) freelocale(numbers_);
}

itk::ImageIOBase::Pointer make_image_io(Format format, const std::filesystem::path& file) {
  itk::ImageIOBase::Pointer io;
  switch (format) {
    case Format::nifti: {
      const auto nifti = itk::NiftiImageIO::New();
      nifti->SetLegacyAnalyze75Mode(itk::NiftiImageIOEnums::Analyze75Flavor::AnalyzeReject);
      io = nifti;
      break;
    }
    case Format::nrrd:
      io = itk::NrrdImageIO::New();
      break;
    case Format::meta:
      io = itk::MetaImageIO::New();
      break;
    case Format::gipl:
      io = itk::GiplImageIO::New();
      break;
  }
  io->SetFileName(file.string());
  return io;
}

std::string one_line(const std::exception& exception) {
  const auto* itk_exception = dynamic_cast<const itk::ExceptionObject*>(&exception);
  std::string text = itk_exception != nullptr ? itk_exception->GetDescription() : exception.what();
  // "ITK ERROR: NiftiImageIO(0x55...): what happened"
  if (const auto at = text.find("): "); text.starts_with("ITK ERROR") && at != std::string::npos) {
    text.erase(0, at + 3);
  }
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace tidemark::files
