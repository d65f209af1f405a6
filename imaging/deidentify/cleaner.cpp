#include "imaging/deidentify/cleaner.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "imaging/deidentify/dummy_value.h"
#include "imaging/deidentify/method_codes.h"
#include "imaging/deidentify/profile.h"
#include "imaging/deidentify/shifted_date.h"
#include "imaging/dicom/character_sets.h"
#include "imaging/dicom/element_text.h"

namespace tidemark::imaging {
namespace {

// Ages above this one tell too much about a patient; they become the next one.
constexpr int kHighestAge = 89;

bool is_sequence(const DcmElement& element) {
  return element.ident() == EVR_SQ;
}

// Representations whose values may be any words.
bool is_free_text(DcmEVR vr) {
  constexpr DcmEVR kFree[] = {EVR_LO, EVR_LT, EVR_PN, EVR_SH, EVR_ST, EVR_UC, EVR_UR, EVR_UT};
  return std::find(std::begin(kFree), std::end(kFree), vr) != std::end(kFree);
}

// What a dummy may stand for where all text is replaced: everything but numbers, terms and structure.
bool may_tell(DcmEVR vr) {
  constexpr DcmEVR kOthers[] = {EVR_AE, EVR_AS, EVR_DA, EVR_DT, EVR_TM, EVR_OB, EVR_UN};
  return is_free_text(vr) || std::find(std::begin(kOthers), std::end(kOthers), vr) != std::end(kOthers);
}

// Whether the element is what the dictionary says of its tag, as far as that matters: sequences are
// sequences, and numbers are no words.
bool fits_dictionary(const DcmElement& element, DcmEVR known) {
  const DcmEVR vr = element.ident();
  if (is_sequence(element) != (known == EVR_SQ)) return false;
  if (vr == EVR_UN) return known == EVR_UN;
  return !is_free_text(vr) || is_free_text(known);
}

std::string_view letters(DcmEVR vr) {
  if (vr == EVR_UNKNOWN || vr == EVR_UNKNOWN2B) return {};
  return DcmVR(vr).getVRName();
}

// "095Y" as "090Y"; any other age as it is.
std::string capped_age(const std::string& age) {
  int years = 0;
  const bool is_years =
      age.ends_with('Y') &&
      std::from_chars(age.data(), age.data() + age.size(), years).ptr == age.data() + age.size() - 1;
  return is_years && years > kHighestAge ? fmt::format("{:03}Y", kHighestAge + 1) : age;
}

std::string path_of(const DcmTagKey& key, const std::string& path) {
  return fmt::format("{}({:04X},{:04X})", path, key.getGroup(), key.getElement());
}

std::string keyword_of(const DcmTagKey& key) {
  if (key.isPrivate()) return "private";
  const std::string name = DcmTag(key).getTagName();
  constexpr std::string_view kRetired = "RETIRED_";
  if (name == DcmTag_ERROR_TagName) return "unknown";
  return name.starts_with(kRetired) ? name.substr(kRetired.size()) : name;
}

}  // namespace

PatientIdentity identity_of(DcmDataset& dataset) {
  const std::string character_set = element_text(dataset, DCM_SpecificCharacterSet);
  const auto text = [&](const DcmTagKey& key) {
    return in_utf8_or_latin_1(element_text(dataset, key), character_set, "^=");
  };
  if (std::string id = text(DCM_PatientID); !id.empty()) return {std::move(id), text(DCM_IssuerOfPatientID)};
  if (std::string name = text(DCM_PatientName); !name.empty()) return {std::move(name), {}};
  return {text(DCM_StudyInstanceUID), {}};
}

void Cleaner::note(const DcmTagKey& key, const std::string& path, Change change) {
  ++counts_[change];
  if (records()) changes_.push_back({path_of(key, path), keyword_of(key), change});
}

std::unique_ptr<DcmElement> Cleaner::with_text(std::unique_ptr<DcmElement> element, const std::string& path,
                                               const std::string& text, Change change) {
  const DcmTagKey key = element->getTag();
  auto fresh = empty_element(key);
  if (text.empty() || fresh->putString(text.c_str()).bad()) {
    fresh = empty_element(key);
    change = Change::emptied;
  }
  note(key, path, change);
  return fresh;
}

// A value that stays, or the items of a sequence, each by itself.
std::unique_ptr<DcmElement> Cleaner::kept(std::unique_ptr<DcmElement> element, const std::string& path,
                                          bool is_all_text_replaced) {
  const DcmTagKey key = element->getTag();
  if (is_sequence(*element)) {
    auto& sequence = static_cast<DcmSequenceOfItems&>(*element);
    std::size_t number = 0;
    for (DcmObject* item = nullptr; (item = sequence.nextInContainer(item)) != nullptr;) {
      ++number;
      const std::string inside =
          records() ? fmt::format("{}[{}].", path_of(key, path), number) : std::string();
      clean_item(static_cast<DcmItem&>(*item), inside, is_all_text_replaced);
    }
    return element;
  }
  if (element->ident() == EVR_AS) {
    const std::string age = element_text(*element);
    if (const std::string capped = capped_age(age); capped != age) {
      return with_text(std::move(element), path, capped, Change::replaced);
    }
  }
  return element;
}

std::unique_ptr<DcmElement> Cleaner::cleaned(std::unique_ptr<DcmElement> element, const std::string& path,
                                             bool is_all_text_replaced) {
  const DcmTagKey key = element->getTag();
  const DcmEVR known = DcmTag(key).getEVR();
  Fate fate = fate_of({key.getGroup(), key.getElement()}, letters(known), options_);
  if (fate != Fate::remove && !fits_dictionary(*element, known)) fate = Fate::remove;
  if (fate == Fate::remove) {
    note(key, path, Change::removed);
    return nullptr;
  }
  if (is_all_text_replaced && (fate == Fate::keep || fate == Fate::empty) && may_tell(known)) {
    fate = Fate::replace;
  }
  const bool has_value = element->getLengthField() != 0;
  if (!has_value) return element;
  switch (fate) {
    case Fate::keep:
    case Fate::remove:
      return kept(std::move(element), path, is_all_text_replaced);
    case Fate::empty:
      note(key, path, Change::emptied);
      return empty_element(key);
    case Fate::replace:
      if (is_sequence(*element)) return kept(std::move(element), path, true);
      note(key, path, Change::replaced);
      return dummy_element(key);
    case Fate::map_uid: {
      const std::string old = element_text(*element);
      const std::string mapped = pseudonyms_.uids(old);
      if (mapped == old && !mapped.empty()) return element;
      return with_text(std::move(element), path, mapped, Change::replaced);
    }
    case Fate::shift: {
      const std::string shifted = shifted_dates(element_text(*element), days_);
      return with_text(std::move(element), path, shifted, Change::shifted);
    }
  }
  return nullptr;
}

// All elements are taken out and what stays is put back: removing from the middle would search each time.
void Cleaner::clean_item(DcmItem& item, const std::string& path, bool is_all_text_replaced) {
  std::vector<std::unique_ptr<DcmElement>> elements;
  elements.reserve(item.card());
  constexpr unsigned long kFirst = 0;
  while (DcmElement* element = item.remove(kFirst)) elements.emplace_back(element);
  for (std::unique_ptr<DcmElement>& element : elements) {
    auto stays = cleaned(std::move(element), path, is_all_text_replaced);
    if (stays == nullptr) continue;
    if (item.insert(stays.get()).good()) static_cast<void>(stays.release());
  }
}

Status Cleaner::clean(DcmDataset& dataset) {
  changes_.clear();
  const auto pseudonym = pseudonyms_.patient(identity_of(dataset));
  if (!pseudonym) return pass_on(pseudonym);
  days_ = pseudonym->days;
  for (const DcmTagKey& key : {DCM_PatientName, DCM_PatientID}) {
    const bool was_there = dataset.findAndDeleteElement(key).good();
    note(key, {}, was_there ? Change::replaced : Change::added);
  }
  clean_item(dataset, {}, false);
  const bool is_set = dataset.putAndInsertString(DCM_PatientName, pseudonym->name.c_str()).good() &&
                      dataset.putAndInsertString(DCM_PatientID, pseudonym->id.c_str()).good() &&
                      put_method(dataset, options_);
  if (!is_set) return fail(ErrorKind::internal, "an attribute cannot be set");
  for (const DcmTagKey& key :
       {DCM_PatientIdentityRemoved, DCM_DeidentificationMethod, DCM_DeidentificationMethodCodeSequence,
        DCM_LongitudinalTemporalInformationModified}) {
    note(key, {}, Change::added);
  }
  return {};
}

}  // namespace tidemark::imaging
