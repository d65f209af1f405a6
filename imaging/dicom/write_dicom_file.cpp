#include "imaging/dicom/write_dicom_file.h"

#include <dcmtk/dcmdata/dcostrmb.h>
#include <dcmtk/dcmdata/dcwcache.h>

#include <vector>

#include "core/atomic_file.h"

namespace tidemark::imaging {

Result<std::string> encode_dicom_file(DcmFileFormat& object, E_TransferSyntax syntax) {
  std::vector<char> buffer(std::size_t{1} << 20);
  DcmOutputBufferStream stream(buffer.data(), static_cast<offile_off_t>(buffer.size()));
  DcmWriteCache cache;
  std::string bytes;
  object.transferInit();
  OFCondition condition = EC_StreamNotifyClient;
  while (condition == EC_StreamNotifyClient) {
    condition = object.write(stream, syntax, EET_ExplicitLength, &cache, EGL_recalcGL);
    void* filled = nullptr;
    offile_off_t length = 0;
    stream.flushBuffer(filled, length);
    bytes.append(static_cast<const char*>(filled), static_cast<std::size_t>(length));
  }
  object.transferEnd();
  if (condition.bad()) return fail(ErrorKind::write, "{}", condition.text());
  return bytes;
}

// Encoded in memory, because DCMTK does not report a file that could not be written to its end.
Status write_dicom_file(DcmFileFormat& object, E_TransferSyntax syntax, const std::filesystem::path& file) {
  const auto bytes = encode_dicom_file(object, syntax);
  if (bytes) return write_file(file, *bytes);
  return fail(bytes.error().kind, "{}: cannot write: {}", file.string(), bytes.error().message);
}

}  // namespace tidemark::imaging
