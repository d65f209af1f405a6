// The bytes of DICOM's upper layer and of DIMSE messages (PS3.8 9.3, PS3.7 E), written by hand, so that they
// may also be wrong.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace tidemark::test {

// One context that was proposed in an A-ASSOCIATE-RQ.
struct ProposedContext {
  int id = 0;
  std::string abstract_syntax;
  std::string first_transfer_syntax;
};
std::vector<ProposedContext> contexts_of(const std::string& association_request);

// A protocol data unit of that type.
std::string pdu(int type, const std::string& body);
// Accepts all contexts, each in its first transfer syntax, and takes PDUs of any size.
std::string accept_all(const std::vector<ProposedContext>& contexts);
std::string reject(int result, int source, int reason);
// P-DATA-TF PDUs of at most 16 KiB with a command or data.
std::string data_pdus(int context, bool is_command, const std::string& bytes, bool is_last = true);

// Attributes in implicit little endian; even lengths are made by the padding that their representation has.
std::string text_attribute(int group, int element, std::string value, char padding = ' ');
std::string uid_attribute(int group, int element, const std::string& value);
std::string short_attribute(int group, int element, int value);
// A command set: the group length is put in front.
std::string command(const std::string& attributes);

// The value of a short attribute in a command that came; -1 when it is not there.
int short_value(const std::string& command, int element);

// Ready commands.
std::string store_request(int message_id, const std::string& sop_class, const std::string& sop_instance);
std::string response(int command_field, int message_id, int status, bool has_data,
                     const std::string& more = {});

constexpr int kEchoResponse = 0x8030;
constexpr int kFindResponse = 0x8020;
constexpr int kGetResponse = 0x8010;
constexpr int kPending = 0xff00;
constexpr const char* kImplicitSyntax = "1.2.840.10008.1.2";
constexpr const char* kCt = "1.2.840.10008.5.1.4.1.1.2";

// In explicit little endian.
std::string explicit_attribute(int group, int element, const char* representation, std::string value);

// The smallest object that is one: identity alone, in explicit little endian.
std::string object(const std::string& sop_class, const std::string& sop_instance, const std::string& study,
                   const std::string& series);

}  // namespace tidemark::test
