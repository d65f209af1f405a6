#include "imaging/files/itk_io.h"

#include <itkGiplImageIO.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <stdlib.h>

#include <algorithm>
#include <utility>

namespace tidemark::imaging::files {
namespace {

constexpr const char* kSuffixes[] = {".nii", ".nii.gz", ".nrrd", ".mha", ".gipl", ".gipl.gz"};

}  // namespace

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

Result<ItkName> ItkName::create(Format format, const std::filesystem::path& file, Use use) {
  ItkName name;
  name.path_ = file;
  const auto suffix = std::find_if(std::begin(kSuffixes), std::end(kSuffixes),
                                   [&](const char* known) { return has_suffix(file, known); });
  const bool by_suffix = use == Use::write || format == Format::nifti || format == Format::gipl;
  if (!by_suffix || suffix == std::end(kSuffixes) || file.filename().string().ends_with(*suffix)) return name;

  std::error_code error;
  std::string pattern = (std::filesystem::temp_directory_path(error) / "tidemark-XXXXXX").string();
  if (error || ::mkdtemp(pattern.data()) == nullptr) {
    return fail(ErrorKind::write, "{}: its suffix needs a temporary folder, and none can be made",
                file.string());
  }
  name.folder_ = pattern;
  name.unfinished_ = Unfinished(name.folder_);
  name.path_ = name.folder_ / (std::string("volume") + *suffix);
  const auto absolute = std::filesystem::absolute(file, error);
  if (!error) std::filesystem::create_symlink(absolute, name.path_, error);
  if (error) return fail(ErrorKind::write, "{}: {}", name.path_.string(), error.message());
  return name;
}

ItkName::~ItkName() {
  std::error_code ignored;
  if (folder_.empty()) return;
  std::filesystem::remove(path_, ignored);
  std::filesystem::remove(folder_, ignored);
}

ItkName::ItkName(ItkName&& other) noexcept
    : path_(std::exchange(other.path_, {})),
      folder_(std::exchange(other.folder_, {})),
      unfinished_(std::move(other.unfinished_)) {}

ItkName& ItkName::operator=(ItkName&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(folder_, other.folder_);
  std::swap(unfinished_, other.unfinished_);
  return *this;
}

std::string one_line(const std::exception& exception) {
  const auto* itk_exception = dynamic_cast<const itk::ExceptionObject*>(&exception);
  std::string text = itk_exception != nullptr ? itk_exception->GetDescription() : exception.what();
  // "itk::ERROR: NrrdImageIO(0x55...): what happened", or "ITK ERROR: what happened"
  const std::string start = text.substr(0, 10);
  if (start == "ITK ERROR:" || start == "itk::ERROR") {
    const auto at = text.find("): ");
    text.erase(0, at != std::string::npos ? at + 3 : text.find(": ") + 2);
  }
  // The NRRD library tells the whole chain of calls; the last is the cause.
  if (const auto at = text.rfind("[nrrd] "); at != std::string::npos) text.erase(0, at + 7);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace tidemark::imaging::files
