// A form with files, as browsers send it (multipart/form-data, RFC 7578).
#pragma once

#include <list>
#include <string>
#include <vector>

#include "imaging/guard/byte_source.h"

namespace tidemark::imaging {

// Names and types are ours: nothing in them needs to be escaped. It is not moved while it is sent.
class FormData {
 public:
  FormData();
  FormData(const FormData&) = delete;
  FormData& operator=(const FormData&) = delete;

  void add(const std::string& name, const std::string& text);
  // The bytes must outlive the form.
  void add_file(const std::string& name, const std::string& file_name, const std::string& type,
                ByteSource& bytes);
  // After the last part: what HttpRequest takes.
  [[nodiscard]] std::vector<ByteSource*> body();
  [[nodiscard]] std::string type() const { return "multipart/form-data;boundary=" + boundary_; }

 private:
  void put(std::string text);

  std::string boundary_;
  std::list<std::string> texts_;  // lists: what was put in stays where it is
  std::list<MemoryBytes> between_;
  std::vector<ByteSource*> parts_;
};

}  // namespace tidemark::imaging
