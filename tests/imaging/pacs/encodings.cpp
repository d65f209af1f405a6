#include "tests/imaging/pacs/encodings.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dctk.h>

namespace tidemark::test {

void compress_by_rle(const std::filesystem::path& file, const std::filesystem::path& target) {
  DcmRLEEncoderRegistration::registerCodecs();
  DcmFileFormat loaded;
  if (loaded.loadFile(file.c_str()).bad()) qFatal("cannot load %s", file.c_str());
  loaded.loadAllDataIntoMemory();
  if (loaded.getDataset()->chooseRepresentation(EXS_RLELossless, nullptr).bad() ||
      loaded.saveFile(target.c_str(), EXS_RLELossless).bad())
    qFatal("cannot compress %s", file.c_str());
}

QString syntax_of(const std::filesystem::path& file) {
  DcmFileFormat loaded;
  if (loaded.loadFile(file.c_str()).bad()) return {};
  return DcmXfer(loaded.getDataset()->getOriginalXfer()).getXferID();
}

}  // namespace tidemark::test
