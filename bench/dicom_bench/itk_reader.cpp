#include "bench/dicom_bench/itk_reader.h"

#include <itkGDCMImageIO.h>
#include <itkGDCMSeriesFileNames.h>
#include <itkImage.h>
#include <itkImageSeriesReader.h>

#include <numeric>

namespace tidemark::bench {

std::int64_t read_with_itk(const std::filesystem::path& folder) {
  const auto names = itk::GDCMSeriesFileNames::New();
  names->SetUseSeriesDetails(false);
  names->SetDirectory(folder.string());
  using Image = itk::Image<std::int16_t, 3>;
  const auto reader = itk::ImageSeriesReader<Image>::New();
  reader->SetImageIO(itk::GDCMImageIO::New());
  reader->SetFileNames(names->GetFileNames(names->GetSeriesUIDs().at(0)));
  reader->Update();
  const Image& image = *reader->GetOutput();
  const auto count = static_cast<std::ptrdiff_t>(image.GetBufferedRegion().GetNumberOfPixels());
  return std::accumulate(image.GetBufferPointer(), image.GetBufferPointer() + count, std::int64_t{0});
}

}  // namespace tidemark::bench
