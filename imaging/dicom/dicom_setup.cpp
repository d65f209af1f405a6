#include "imaging/dicom/dicom_setup.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcdict.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dcvr.h>
#include <dcmtk/dcmjpeg/djdecode.h>
#include <dcmtk/dcmjpls/djdecode.h>
#include <dcmtk/oflog/oflog.h>

#include <mutex>

#include "imaging/dicom/j2k_codec.h"

namespace tidemark::imaging {
namespace {

void set_up_once() {
  // Problems reach the user as errors of ours that name the file; the log would only clutter stderr, and
  // it could carry patient data.
  OFLog::configure(OFLogger::OFF_LOG_LEVEL);
  // Tools that did not know an attribute wrote it as UN; the dictionary knows better.
  dcmEnableUnknownVRConversion.set(OFTrue);
  DcmRLEDecoderRegistration::registerCodecs();
  DJDecoderRegistration::registerCodecs();
  DJLSDecoderRegistration::registerCodecs();
  register_j2k_decoder();
}

}  // namespace

Status set_up_dicom() {
  static std::once_flag once;
  std::call_once(once, set_up_once);
  if (!dcmDataDict.isDictionaryLoaded()) {
    return fail(ErrorKind::capability,
                "the DICOM data dictionary of DCMTK was not found; set DCMDICTPATH to dicom.dic");
  }
  return {};
}

}  // namespace tidemark::imaging
