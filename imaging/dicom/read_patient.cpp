#include "imaging/dicom/read_patient.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "imaging/dicom/character_sets.h"
#include "imaging/dicom/date.h"
#include "imaging/dicom/element_text.h"

namespace tidemark::imaging {
namespace {

std::string patient_text(DcmItem& dataset, const DcmTagKey& key, const std::string& delimiters = {}) {
  return tidied(
      in_utf8(element_text(dataset, key), element_text(dataset, DCM_SpecificCharacterSet), delimiters));
}

// The first `count` parts of a text between delimiters; those that it does not have are empty.
template <std::size_t count>
std::array<std::string, count> parts_of(std::string_view whole, char delimiter) {
  std::array<std::string, count> parts;
  for (std::string& part : parts) {
    const std::size_t end = std::min(whole.find(delimiter), whole.size());
    part = tidied(whole.substr(0, end));
    whole.remove_prefix(std::min(end + 1, whole.size()));
  }
  return parts;
}

// One of the representations of a name (PS3.5 6.2.1): family, given and middle name, prefix and suffix.
std::string readable_name(const std::string& representation, const char* behind_family) {
  const auto components = parts_of<5>(representation, '^');
  std::string others;
  for (std::size_t i = 1; i < components.size(); ++i) {
    if (components[i].empty()) continue;
    if (!others.empty()) others += ' ';
    others += components[i];
  }
  const std::string& family = components[0];
  return family.empty() || others.empty() ? family + others : family + behind_family + others;
}

std::string name(DcmItem& dataset) {
  const auto [alphabetic, ideographic, phonetic] =
      parts_of<3>(patient_text(dataset, DCM_PatientName, "^="), '=');
  const std::string latin = readable_name(alphabetic, ", ");
  const std::string original = readable_name(ideographic, " ");
  if (original.empty()) return latin.empty() ? readable_name(phonetic, " ") : latin;
  return latin.empty() ? original : fmt::format("{} ({})", original, latin);
}

std::string sex(DcmItem& dataset) {
  const std::string value = patient_text(dataset, DCM_PatientSex);
  return value == "F" || value == "M" || value == "O" ? value : std::string();
}

// The file's own ("045Y"; some write "000Y" for unknown), else from the date of birth.
std::string age(DcmItem& dataset, const std::string& study_date) {
  const std::string own = patient_text(dataset, DCM_PatientAge);
  const std::size_t zeros = std::min(own.find_first_not_of('0'), own.size());
  const std::size_t digits = std::min(own.find_first_not_of("0123456789"), own.size());
  const bool is_age = digits > zeros && digits <= 3 && digits + 1 == own.size() &&
                      std::string_view("DWMY").find(own.back()) != std::string_view::npos;
  if (is_age) return own.substr(zeros);
  return age_between(iso_date(patient_text(dataset, DCM_PatientBirthDate)), study_date);
}

}  // namespace

Patient read_patient(DcmItem& dataset, const std::string& study_date) {
  return {name(dataset), patient_text(dataset, DCM_PatientID), sex(dataset), age(dataset, study_date)};
}

AuditedStudy read_audited_study(DcmItem& dataset) {
  return {patient_text(dataset, DCM_PatientID),
          name(dataset),
          element_text(dataset, DCM_StudyInstanceUID),
          {{element_text(dataset, DCM_SOPClassUID), 1}}};
}

}  // namespace tidemark::imaging
