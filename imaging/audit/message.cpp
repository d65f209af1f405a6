#include "imaging/audit/message.h"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <utility>
#include <vector>

#include "core/base64.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;
using Kind = AuditEvent::Kind;

constexpr std::size_t kLongestValue = 1024;       // bytes of a text before it is escaped
constexpr std::size_t kLongestAuditQuery = 8192;  // bytes of a query
constexpr std::size_t kMostAuditFiles = 4;        // that are named; of more the number is
constexpr std::size_t kMostAuditClasses = 40;

// A coded value (PS3.15 A.5.1, CodedValueType).
struct Code {
  const char* code;
  const char* meaning;
  const char* system = "DCM";
};

constexpr Code kApplication{"110150", "Application"};
constexpr Code kLauncher{"110151", "Application Launcher"};
constexpr Code kDestination{"110152", "Destination Role ID"};
constexpr Code kSource{"110153", "Source Role ID"};
constexpr Code kDestinationMedia{"110154", "Destination Media"};
constexpr Code kSourceMedia{"110155", "Source Media"};
constexpr Code kStudyUid{"110180", "Study Instance UID"};
constexpr Code kClassUid{"110181", "SOP Class UID"};
constexpr Code kMediaUri{"110037", "URI"};
constexpr Code kPatientNumber{"2", "Patient Number", "RFC-3881"};
constexpr Code kUri{"12", "URI", "RFC-3881"};
constexpr Code kNone{"", ""};

// The event of a kind (A.5.3): its code, its type where it has one, and what was done (EventActionCode).
struct EventCodes {
  Code id;
  Code type;
  const char* action;
};

EventCodes codes_of(Kind kind) {
  switch (kind) {
    case Kind::started:
      return {{"110100", "Application Activity"}, {"110120", "Application Start"}, "E"};
    case Kind::stopped:
      return {{"110100", "Application Activity"}, {"110121", "Application Stop"}, "E"};
    case Kind::accessed:
      return {{"110103", "DICOM Instances Accessed"}, kNone, "R"};
    case Kind::received:
    case Kind::sent:
      return {{"110104", "DICOM Instances Transferred"}, kNone, "C"};
    case Kind::exported:
      return {{"110106", "Export"}, kNone, "R"};
    case Kind::imported:
      return {{"110107", "Import"}, kNone, "C"};
    case Kind::queried:
      return {{"110112", "Query"}, kNone, "E"};
  }
  return {kNone, kNone, "E"};
}

// At most so many bytes, of whole characters.
std::string shortened(std::string text, std::size_t most = kLongestValue) {
  if (text.size() <= most) return text;
  text.resize(most);
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) text.pop_back();
  if (!text.empty() && (static_cast<unsigned char>(text.back()) & 0x80U) != 0) text.pop_back();
  return text + "...";
}

// An element: its attributes in the order in which they come, and what is in it.
using Attributes = std::vector<std::pair<const char*, std::string>>;
std::string element(const std::string& name, const Attributes& attributes, const std::string& inside = {}) {
  std::string text = "<" + name;
  for (const auto& [key, value] : attributes) {
    text += fmt::format(" {}=\"{}\"", key, xml_text(shortened(value)));
  }
  return inside.empty() ? text + "/>" : fmt::format("{}>{}</{}>", text, inside, name);
}

std::string coded(const char* name, const Code& code) {
  if (*code.code == '\0') return {};
  return element(name,
                 {{"csd-code", code.code}, {"codeSystemName", code.system}, {"originalText", code.meaning}});
}

std::string identification(const AuditEvent& event) {
  const EventCodes codes = codes_of(event.kind);
  std::string inside = coded("EventID", codes.id) + coded("EventTypeCode", codes.type);
  if (!event.failure.empty())
    inside += element("EventOutcomeDescription", {}, xml_text(shortened(event.failure)));
  constexpr const char* kSuccess = "0";
  constexpr const char* kMinorFailure = "4";
  return element("EventIdentification",
                 {{"EventActionCode", codes.action},
                  {"EventDateTime", utc_text(event.time)},
                  {"EventOutcomeIndicator", event.failure.empty() ? kSuccess : kMinorFailure}},
                 inside);
}

// A machine: by its name, or by an IPv4 address.
void add_machine(Attributes& attributes, const std::string& host) {
  if (host.empty()) return;
  const bool is_address = host.find_first_not_of("0123456789.") == std::string::npos;
  attributes.emplace_back("NetworkAccessPointID", host);
  attributes.emplace_back("NetworkAccessPointTypeCode", is_address ? "2" : "1");
}

std::string user(const AuditOrigin& origin, const Code& role) {
  Attributes attributes{{"UserID", origin.login + "@" + origin.host}, {"AlternativeUserID", origin.login}};
  if (!origin.user_name.empty()) attributes.emplace_back("UserName", origin.user_name);
  attributes.emplace_back("UserIsRequestor", "true");
  add_machine(attributes, origin.host);
  return element("ActiveParticipant", attributes, coded("RoleIDCode", role));
}

std::string process(const AuditOrigin& origin, const std::string& ae_title, const Code& role) {
  Attributes attributes{{"UserID", origin.process_id}};
  if (!ae_title.empty()) attributes.emplace_back("AlternativeUserID", "AETITLES=" + ae_title);
  attributes.emplace_back("UserName", origin.program);
  attributes.emplace_back("UserIsRequestor", "false");
  add_machine(attributes, origin.host);
  return element("ActiveParticipant", attributes, coded("RoleIDCode", role));
}

std::string other_side(const AuditedPeer& peer, const Code& role) {
  Attributes attributes{{"UserID", peer.url.empty() ? peer.host : peer.url}};
  if (!peer.ae_title.empty()) attributes.emplace_back("AlternativeUserID", "AETITLES=" + peer.ae_title);
  attributes.emplace_back("UserIsRequestor", "false");
  add_machine(attributes, peer.host);
  return element("ActiveParticipant", attributes, coded("RoleIDCode", role));
}

// "file:///a/mask.nii.gz; file:///a/surface.stl"
std::string uris_of(const std::vector<fs::path>& files) {
  std::string all;
  for (std::size_t i = 0; i < std::min(files.size(), kMostAuditFiles); ++i) {
    all += (i == 0 ? "file://" : "; file://") + files[i].string();
  }
  if (files.size() > kMostAuditFiles) all += fmt::format("; and {} more", files.size() - kMostAuditFiles);
  return all;
}

// Files, or a peer that got copies.
std::string media(const AuditEvent& event, const Code& role) {
  Attributes attributes{{"UserID", uris_of(event.files)}, {"UserIsRequestor", "false"}};
  if (event.files.empty()) {
    attributes.front().second = event.peer.url.empty() ? event.peer.host : event.peer.url;
    add_machine(attributes, event.peer.host);
  }
  const std::string identifier = element("MediaIdentifier", {}, coded("MediaType", kMediaUri));
  return element("ActiveParticipant", attributes, coded("RoleIDCode", role) + identifier);
}

std::string participants(const AuditEvent& event, const AuditOrigin& origin) {
  const AuditedPeer& peer = event.peer;
  const auto ours = [&](const Code& of_user, const Code& of_process) {
    return user(origin, of_user) + process(origin, peer.own_ae_title, of_process);
  };
  switch (event.kind) {
    case Kind::started:
    case Kind::stopped:
      return ours(kLauncher, kApplication);
    case Kind::accessed:
      return ours(kNone, kApplication);
    case Kind::received:
      return other_side(peer, kSource) + ours(kNone, kDestination);
    case Kind::sent:
      return ours(kNone, kSource) + other_side(peer, kDestination);
    case Kind::exported:
      return ours(kSource, kSource) + media(event, kDestinationMedia);
    case Kind::imported:
      return ours(kDestination, kDestination) + media(event, kSourceMedia);
    case Kind::queried:
      return ours(kNone, kSource) + other_side(peer, kDestination);
  }
  return {};
}

// What took part: the type 1 is a person, 2 a thing of the system; the role 1 is a patient, 3 a report.
std::string object(const char* type, const char* role, const std::string& id, const std::string& inside) {
  return element("ParticipantObjectIdentification",
                 {{"ParticipantObjectID", id},
                  {"ParticipantObjectTypeCode", type},
                  {"ParticipantObjectTypeCodeRole", role}},
                 inside);
}

std::string named(const std::string& name) {
  return "<ParticipantObjectName>" + xml_text(shortened(name)) + "</ParticipantObjectName>";
}

std::string study_object(const AuditedStudy& study, bool is_deidentified) {
  std::string description;
  std::size_t classes = 0;
  for (const auto& [sop_class, count] : study.objects) {
    if (++classes > kMostAuditClasses) break;
    description += element("SOPClass", {{"UID", sop_class}, {"NumberOfInstances", fmt::format("{}", count)}});
  }
  if (is_deidentified) description += "<Anonymized>true</Anonymized>";
  std::string inside = coded("ParticipantObjectIDTypeCode", kStudyUid) + named(study.study_uid);
  if (!description.empty()) inside += element("ParticipantObjectDescription", {}, description);
  return object("2", "3", study.study_uid, inside);
}

std::string patient_object(const AuditedStudy& study) {
  return object("1", "1", study.patient_id,
                coded("ParticipantObjectIDTypeCode", kPatientNumber) + named(study.patient_name));
}

std::string query_object(const AuditEvent& event) {
  // A dataset that is cut is still one to its last whole element; no query of ours is as long.
  const std::string query = "<ParticipantObjectQuery>" +
                            to_base64(event.query.substr(0, kLongestAuditQuery)) +
                            "</ParticipantObjectQuery>";
  if (event.query_class.empty())
    return object("2", "3", event.peer.url, coded("ParticipantObjectIDTypeCode", kUri) + query);
  constexpr const char* kExplicitLittleEndian = "1.2.840.10008.1.2.1";
  const std::string syntax = element(
      "ParticipantObjectDetail", {{"type", "TransferSyntax"}, {"value", to_base64(kExplicitLittleEndian)}});
  return object("2", "3", event.query_class,
                coded("ParticipantObjectIDTypeCode", kClassUid) + query + syntax);
}

std::string objects(const AuditEvent& event) {
  switch (event.kind) {
    case Kind::started:
    case Kind::stopped:
      return {};
    case Kind::queried:
      return query_object(event);
    default: {
      std::string all;
      if (!event.study.study_uid.empty()) all += study_object(event.study, event.is_deidentified);
      return all + patient_object(event.study);
    }
  }
}

std::string source(const AuditOrigin& origin) {
  Attributes attributes;
  if (!origin.site.empty()) attributes.emplace_back("AuditEnterpriseSiteID", origin.site);
  attributes.emplace_back("AuditSourceID", origin.source);
  constexpr const char* kEndUserDevice = "1";
  return element("AuditSourceIdentification", attributes,
                 element("AuditSourceTypeCode", {{"csd-code", kEndUserDevice}}));
}

}  // namespace

AuditOrigin AuditOrigin::of_this_process(std::string program) {
  AuditOrigin origin;
  origin.program = std::move(program);
  origin.process_id = fmt::format("{}", ::getpid());
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) == 0) origin.host = host.data();
  if (origin.host.empty()) origin.host = "localhost";
  origin.source = origin.host;
  passwd entry{};
  passwd* found = nullptr;
  std::array<char, 4096> room{};
  if (::getpwuid_r(::geteuid(), &entry, room.data(), room.size(), &found) == 0 && found != nullptr) {
    origin.login = entry.pw_name;
    const std::string details = entry.pw_gecos != nullptr ? entry.pw_gecos : "";
    origin.user_name = details.substr(0, details.find(','));
  }
  if (origin.login.empty()) origin.login = fmt::format("uid {}", ::geteuid());
  return origin;
}

std::string audit_message(const AuditEvent& event, const AuditOrigin& origin) {
  return R"(<?xml version="1.0" encoding="UTF-8"?>)" +
         element("AuditMessage", {},
                 identification(event) + participants(event, origin) + source(origin) + objects(event));
}

std::string utc_text(std::chrono::system_clock::time_point time) {
  using std::chrono::duration_cast, std::chrono::microseconds, std::chrono::seconds;
  const auto since = time.time_since_epoch();
  const auto whole = std::chrono::floor<seconds>(since);
  const std::time_t second = whole.count();
  std::tm parts{};
  ::gmtime_r(&second, &parts);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:06}Z", parts.tm_year + 1900, parts.tm_mon + 1,
                     parts.tm_mday, parts.tm_hour, parts.tm_min, parts.tm_sec,
                     duration_cast<microseconds>(since - whole).count());
}

}  // namespace tidemark::imaging
