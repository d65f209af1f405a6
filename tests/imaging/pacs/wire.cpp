#include "tests/imaging/pacs/wire.h"

#include <algorithm>

namespace tidemark::test {
namespace {

std::string big(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xff);
  return text;
}

std::string little(std::uint64_t value, int bytes) {
  std::string text = big(value, bytes);
  std::reverse(text.begin(), text.end());
  return text;
}

std::size_t big_at(const std::string& bytes, std::size_t at, std::size_t count) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return value;
}

std::string item(int type, const std::string& body) {
  return big(static_cast<unsigned>(type), 1) + big(0, 1) + big(body.size(), 2) + body;
}

// The items that lie one after the other in `bytes`.
template <class Take>
void each_item(const std::string& bytes, std::size_t at, const Take& take) {
  while (at + 4 <= bytes.size()) {
    const std::size_t length = big_at(bytes, at + 2, 2);
    take(static_cast<unsigned char>(bytes[at]), bytes.substr(at + 4, length));
    at += 4 + length;
  }
}

std::string attribute(int group, int element, const std::string& value) {
  return little(static_cast<unsigned>(group), 2) + little(static_cast<unsigned>(element), 2) +
         little(value.size(), 4) + value;
}

constexpr std::size_t kFixedFields = 68;  // of an A-ASSOCIATE, before its items

}  // namespace

std::vector<ProposedContext> contexts_of(const std::string& association_request) {
  std::vector<ProposedContext> contexts;
  each_item(association_request, kFixedFields, [&](int type, const std::string& body) {
    if (type != 0x20) return;
    ProposedContext context;
    context.id = static_cast<unsigned char>(body.at(0));
    each_item(body, 4, [&](int kind, const std::string& name) {
      if (kind == 0x30) context.abstract_syntax = name;
      if (kind == 0x40 && context.first_transfer_syntax.empty()) context.first_transfer_syntax = name;
    });
    contexts.push_back(context);
  });
  return contexts;
}

std::string pdu(int type, const std::string& body) {
  return big(static_cast<unsigned>(type), 1) + big(0, 1) + big(body.size(), 4) + body;
}

std::string accept_all(const std::vector<ProposedContext>& contexts) {
  std::string body =
      big(1, 2) + big(0, 2) + std::string(16, 'A') + std::string(16, 'B') + std::string(32, '\0');
  body += item(0x10, "1.2.840.10008.3.1.1.1");
  std::string roles;
  for (const ProposedContext& context : contexts) {
    body += item(0x21, big(static_cast<unsigned>(context.id), 1) + std::string(3, '\0') +
                           item(0x40, context.first_transfer_syntax));
    // For classes of objects: we are the one who stores.
    if (context.abstract_syntax.find("10008.5.1.4.1.1.") == std::string::npos) continue;
    roles +=
        item(0x54, big(context.abstract_syntax.size(), 2) + context.abstract_syntax + big(0, 1) + big(1, 1));
  }
  body += item(0x50, item(0x51, big(0, 4)) + item(0x52, "1.2.3.4") + roles);
  return pdu(2, body);
}

std::string reject(int result, int source, int reason) {
  std::string body(1, '\0');
  for (const int value : {result, source, reason}) body += static_cast<char>(value);
  return pdu(3, body);
}

std::string data_pdus(int context, bool is_command, const std::string& bytes, bool is_last) {
  constexpr std::size_t kPiece = 16000;
  std::string all;
  std::size_t at = 0;
  do {
    const std::string piece = bytes.substr(at, kPiece);
    at += piece.size();
    const bool ends = is_last && at == bytes.size();
    const int header = (is_command ? 1 : 0) | (ends ? 2 : 0);
    all += pdu(4, big(piece.size() + 2, 4) + static_cast<char>(context) + static_cast<char>(header) + piece);
  } while (at < bytes.size());
  return all;
}

std::string text_attribute(int group, int element, std::string value, char padding) {
  if (value.size() % 2 != 0) value += padding;
  return attribute(group, element, value);
}

std::string uid_attribute(int group, int element, const std::string& value) {
  return text_attribute(group, element, value, '\0');
}

std::string short_attribute(int group, int element, int value) {
  return attribute(group, element, little(static_cast<unsigned>(value), 2));
}

std::string command(const std::string& attributes) {
  return attribute(0, 0, little(attributes.size(), 4)) + attributes;
}

int short_value(const std::string& command, int element) {
  for (std::size_t at = 0; at + 8 <= command.size();) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(command.at(at + i)); };
    const std::size_t length = byte(4) | byte(5) << 8 | byte(6) << 16;
    if ((byte(2) | byte(3) << 8) == element && length == 2) return byte(8) | byte(9) << 8;
    at += 8 + length;
  }
  return -1;
}

std::string store_request(int message_id, const std::string& sop_class, const std::string& sop_instance) {
  return command(uid_attribute(0, 0x0002, sop_class) + short_attribute(0, 0x0100, 1) +
                 short_attribute(0, 0x0110, message_id) + short_attribute(0, 0x0700, 0) +
                 short_attribute(0, 0x0800, 1) + uid_attribute(0, 0x1000, sop_instance));
}

std::string response(int command_field, int message_id, int status, bool has_data, const std::string& more) {
  return command(short_attribute(0, 0x0100, command_field) + short_attribute(0, 0x0120, message_id) +
                 short_attribute(0, 0x0800, has_data ? 1 : 0x0101) + short_attribute(0, 0x0900, status) +
                 more);
}

std::string explicit_attribute(int group, int element, const char* representation, std::string value) {
  if (value.size() % 2 != 0) value += representation == std::string("UI") ? '\0' : ' ';
  return little(static_cast<unsigned>(group), 2) + little(static_cast<unsigned>(element), 2) +
         representation + little(value.size(), 2) + value;
}

std::string object(const std::string& sop_class, const std::string& sop_instance, const std::string& study,
                   const std::string& series) {
  return explicit_attribute(0x0008, 0x0016, "UI", sop_class) +
         explicit_attribute(0x0008, 0x0018, "UI", sop_instance) +
         explicit_attribute(0x0020, 0x000d, "UI", study) + explicit_attribute(0x0020, 0x000e, "UI", series);
}

}  // namespace tidemark::test
