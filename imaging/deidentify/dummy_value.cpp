#include "imaging/deidentify/dummy_value.h"

#include <dcmtk/dcmdata/dctk.h>

#include <array>
#include <new>

namespace tidemark::imaging {
namespace {

const char* dummy_text(DcmEVR vr) {
  switch (vr) {
    case EVR_AS:
      return "000Y";
    case EVR_DA:
      return "20000101";
    case EVR_DT:
      return "20000101000000";
    case EVR_TM:
      return "000000";
    case EVR_DS:
    case EVR_IS:
      return "0";
    case EVR_UR:
      return "urn:dummy";
    case EVR_AE:
    case EVR_CS:
    case EVR_LO:
    case EVR_LT:
    case EVR_PN:
    case EVR_SH:
    case EVR_ST:
    case EVR_UC:
    case EVR_UT:
      return "DUMMY";
    default:
      return nullptr;
  }
}

}  // namespace

std::unique_ptr<DcmElement> empty_element(const DcmTagKey& key) {
  DcmElement* made = nullptr;
  if (DcmItem::newDicomElement(made, DcmTag(key)).bad() || made == nullptr) throw std::bad_alloc();
  return std::unique_ptr<DcmElement>(made);
}

std::unique_ptr<DcmElement> dummy_element(const DcmTagKey& key) {
  auto element = empty_element(key);
  const DcmEVR vr = element->getTag().getEVR();
  constexpr std::array<Uint8, 2> kZeros{};
  OFCondition put = EC_Normal;
  if (const char* text = dummy_text(vr)) {
    put = element->putString(text);
  } else if (vr == EVR_OB || vr == EVR_UN) {
    put = element->putUint8Array(kZeros.data(), kZeros.size());
  }
  if (put.bad()) element = empty_element(key);
  return element;
}

}  // namespace tidemark::imaging
