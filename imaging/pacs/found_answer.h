// A server's answer to a query, in whichever form it came.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "imaging/pacs/services.h"

class DcmTagKey;

namespace tidemark::imaging {

class FoundAnswer {
 public:
  virtual ~FoundAnswer() = default;
  // Clean (see clean_text()); several values have backslashes between them; empty where there is none.
  [[nodiscard]] virtual std::string text(const DcmTagKey& key) const = 0;
  // Empty where it is none.
  [[nodiscard]] std::string uid(const DcmTagKey& key) const {
    std::string value = text(key);
    return is_uid(value) ? value : std::string();
  }
};

// False: that was enough.
using TakeAnswer = std::function<bool(const FoundAnswer&)>;

// What a query asks for: values to match, which may hold wildcards; those that are empty are to be returned.
using QueryKeys = std::vector<std::pair<DcmTagKey, std::string>>;

}  // namespace tidemark::imaging
