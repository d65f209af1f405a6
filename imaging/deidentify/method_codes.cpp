#include "imaging/deidentify/method_codes.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

namespace tidemark::imaging {

std::vector<MethodCode> method_codes(const DeidentifyOptions& options) {
  std::vector<MethodCode> codes{{"113100", "Basic Application Confidentiality Profile"}};
  if (options.shift_dates) {
    codes.push_back({"113107", "Retain Longitudinal Temporal Information Modified Dates Option"});
  }
  if (options.keep_characteristics) codes.push_back({"113108", "Retain Patient Characteristics Option"});
  if (options.keep_device) codes.push_back({"113109", "Retain Device Identity Option"});
  if (options.keep_uids) codes.push_back({"113110", "Retain UIDs Option"});
  if (options.keep_institution) codes.push_back({"113112", "Retain Institution Identity Option"});
  return codes;
}

bool put_method(DcmItem& dataset, const DeidentifyOptions& options) {
  OFCondition put = EC_Normal;
  const auto text = [&put](DcmItem& item, const DcmTagKey& key, const char* value) {
    if (put.good()) put = item.putAndInsertString(DcmTag(key), value);
  };
  text(dataset, DCM_PatientIdentityRemoved, "YES");
  text(dataset, DCM_DeidentificationMethod, "Tidemark " TIDEMARK_VERSION ": DICOM PS3.15 Basic Profile");
  text(dataset, DCM_LongitudinalTemporalInformationModified, options.shift_dates ? "MODIFIED" : "REMOVED");
  dataset.findAndDeleteElement(DCM_DeidentificationMethodCodeSequence);
  long index = 0;
  for (const MethodCode& code : method_codes(options)) {
    DcmItem* item = nullptr;
    if (put.good()) {
      put = dataset.findOrCreateSequenceItem(DCM_DeidentificationMethodCodeSequence, item, index++);
    }
    if (put.bad() || item == nullptr) return false;
    text(*item, DCM_CodeValue, code.value);
    text(*item, DCM_CodingSchemeDesignator, "DCM");
    text(*item, DCM_CodeMeaning, code.meaning);
  }
  return put.good();
}

}  // namespace tidemark::imaging
