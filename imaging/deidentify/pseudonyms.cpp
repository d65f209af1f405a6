#include "imaging/deidentify/pseudonyms.h"

#include <algorithm>
#include <random>

#include "imaging/dicom/dicom_values.h"

namespace tidemark::imaging {
namespace {

// Back, because dates to come make other programs stumble.
constexpr int kMostDaysBack = 3650;

bool is_of_dicom(std::string_view uid) {
  const auto is_part = [](char c) { return (c >= '0' && c <= '9') || c == '.'; };
  return uid.starts_with("1.2.840.10008.") && uid.size() <= 64 &&
         std::all_of(uid.begin(), uid.end(), is_part);
}

std::string_view without_padding(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

}  // namespace

std::string Pseudonyms::uids(std::string_view values) {
  std::string mapped;
  for (;;) {
    const std::size_t end = std::min(values.find('\\'), values.size());
    const std::string_view old = without_padding(values.substr(0, end));
    if (is_of_dicom(old)) {
      mapped += old;
    } else if (!old.empty()) {
      std::string& uid = uids_[std::string(old)];
      if (uid.empty()) uid = make_uid();
      mapped += uid;
    }
    if (end == values.size()) return mapped;
    mapped += '\\';
    values.remove_prefix(end + 1);
  }
}

// An ID alone is the first issuer's. Results often lack the issuer that their images have.
std::string Pseudonyms::known_as(const PatientIdentity& patient) {
  if (patient.issuer.empty()) return patient.id;
  const std::string& first = first_issuers_.try_emplace(patient.id, patient.issuer).first->second;
  return patient.issuer == first ? patient.id : fmt::format("{} ({})", patient.id, patient.issuer);
}

Result<Pseudonym> Pseudonyms::patient(const PatientIdentity& identity) {
  const std::string old = known_as(identity);
  if (const auto known = patients_.find(old); known != patients_.end()) return known->second;
  if (!patients_.empty() && (options_.patient_id || options_.patient_name)) {
    return fail(ErrorKind::usage,
                "the files are of more than one patient, and one ID or name cannot be theirs");
  }
  std::random_device random;
  Pseudonym pseudonym;
  pseudonym.id = options_.patient_id.value_or(fmt::format("P{:08X}{:02X}", random(), random() & 0xffU));
  pseudonym.name = options_.patient_name.value_or(pseudonym.id);
  if (options_.shift_dates) {
    std::uniform_int_distribution<int> days(-kMostDaysBack, -1);
    pseudonym.days = options_.shift_days ? *options_.shift_days : days(random);
  }
  return patients_.emplace(old, std::move(pseudonym)).first->second;
}

}  // namespace tidemark::imaging
