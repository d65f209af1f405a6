#include "imaging/web/form_data.h"

#include <fmt/format.h>

#include <random>
#include <utility>

namespace tidemark::imaging {

FormData::FormData() : boundary_("tidemark") {
  // So long that it is in no file.
  std::random_device random;
  for (int i = 0; i < 6; ++i) boundary_ += fmt::format("-{:08x}", random());
}

void FormData::put(std::string text) {
  texts_.push_back(std::move(text));
  const std::string& kept = texts_.back();
  between_.emplace_back(
      std::span<const std::uint8_t>{reinterpret_cast<const std::uint8_t*>(kept.data()), kept.size()});
  parts_.push_back(&between_.back());
}

void FormData::add(const std::string& name, const std::string& text) {
  put(fmt::format("--{}\r\nContent-Disposition: form-data; name=\"{}\"\r\n\r\n{}\r\n", boundary_, name,
                  text));
}

void FormData::add_file(const std::string& name, const std::string& file_name, const std::string& type,
                        ByteSource& bytes) {
  put(fmt::format(
      "--{}\r\nContent-Disposition: form-data; name=\"{}\"; filename=\"{}\"\r\nContent-Type: {}\r\n\r\n",
      boundary_, name, file_name, type));
  parts_.push_back(&bytes);
  put("\r\n");
}

std::vector<ByteSource*> FormData::body() {
  put(fmt::format("--{}--\r\n", boundary_));
  return parts_;
}

}  // namespace tidemark::imaging
