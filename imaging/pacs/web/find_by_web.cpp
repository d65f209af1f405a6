#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "core/json/json_field.h"
#include "core/stopwatch.h"
#include "imaging/pacs/web/web_services.h"
#include "imaging/web/clean_text.h"
#include "imaging/web/json_answer.h"
#include "imaging/web/web_address.h"

namespace tidemark::imaging {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20;  // of the answers to a query
constexpr std::size_t kMostValues = 1'000;                 // of an attribute
constexpr std::size_t kMostRead = 8192;  // bytes of a value, of which clean_text() keeps 512

std::string tag_of(const DcmTagKey& key) {
  return fmt::format("{:04X}{:04X}", key.getGroup(), key.getElement());
}

// A dataset in the JSON of DICOM (PS3.18, F.2).
class JsonAnswer final : public FoundAnswer {
 public:
  explicit JsonAnswer(JsonField dataset) : dataset_(std::move(dataset)) {}
  [[nodiscard]] std::string text(const DcmTagKey& key) const override {
    const std::string tag = tag_of(key);
    if (!dataset_.has(tag.c_str())) return {};
    const JsonField attribute = dataset_.at(tag.c_str());
    if (!attribute.has("Value")) return {};
    const JsonField values = attribute.at("Value");
    std::string all;
    for (std::size_t i = 0; i < values.size(kMostValues); ++i) {
      if (i > 0) all += '\\';
      all += value_of(values.at(i));
    }
    return clean_text(all);
  }

 private:
  // A name has up to three forms, which are divided by "=" elsewhere.
  static std::string value_of(const JsonField& value) {
    if (value.is_text()) return value.text(kMostRead);
    if (value.is_number()) return fmt::format("{}", value.number());
    std::string name;
    std::string divider;
    for (const char* form : {"Alphabetic", "Ideographic", "Phonetic"}) {
      if (value.has(form)) {
        name += divider;
        name += value.at(form).text(kMostRead);
        divider.clear();
      }
      divider += '=';
    }
    return name;
  }

  JsonField dataset_;
};

Result<std::string> text_from(HttpConnection& connection, const std::string& resource) {
  return ask_for_json(connection, {resource, kDicomJson, static_cast<std::int64_t>(kMostBytes)});
}

}  // namespace

std::string question(const std::string& resource, const QueryKeys& keys, std::int64_t limit) {
  std::string all = fmt::format("{}?limit={}", resource, limit);
  for (const auto& [key, value] : keys) {
    all += value.empty() ? fmt::format("&includefield={}", tag_of(key))
                         : fmt::format("&{}={}", tag_of(key), escaped(value));
  }
  return all;
}

Result<double> echo_by_web(const PacsServer& server, const Progress& progress) {
  progress(0.0, "calling the server");
  const auto connection = open_web(server, progress.stop);
  if (!connection) return pass_on(connection);
  const Stopwatch stopwatch;
  // DICOMweb has no service for it.
  const auto text = text_from(**connection, "studies?limit=1");
  if (!text) return pass_on(text);
  return stopwatch.seconds();
}

Result<bool> ask_by_web(const PacsServer& server, const std::string& resource, const QueryKeys& keys,
                        std::int64_t most, const TakeAnswer& take, const Progress& progress) {
  progress(-1.0, "asking the server");
  const auto connection = open_web(server, progress.stop);
  if (!connection) return pass_on(connection);
  const auto text = text_from(**connection, question(resource, keys, most + 1));
  if (!text) return pass_on(text);
  if (text->empty()) return false;
  const auto document = JsonDocument::parse(*text, (*connection)->peer(), {.bytes = kMostBytes});
  if (!document) return pass_on(document);
  const JsonField root = root_of(*document, (*connection)->peer());
  const std::size_t count = root.size(kMostBytes);
  for (std::size_t i = 0; i < count; ++i) {
    if (!take(JsonAnswer(root.at(i)))) return true;
    if (!root.good()) break;
  }
  if (!root.good()) return pass_on(root.status());
  return false;
}

}  // namespace tidemark::imaging
