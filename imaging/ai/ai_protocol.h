// The common face of the protocols of servers with models, each with requests of its own.
#pragma once

#include <memory>

#include "imaging/ai/ai_services.h"
#include "imaging/web/http_connection.h"

namespace tidemark::imaging {

inline constexpr std::size_t kMostModels = 1'000;
inline constexpr std::size_t kMostLabels = 1'000;
inline constexpr std::size_t kLongestAiName = 255;                   // bytes
inline constexpr std::int64_t kLongestList = std::int64_t{4} << 20;  // bytes of an answer that is no image

class AiProtocol {
 public:
  virtual ~AiProtocol() = default;
  virtual Result<std::vector<AiModel>> models() = 0;
  // The values of the answer in the voxel order of the volume; they are not yet checked.
  virtual Result<std::vector<float>> segment(const Volume& volume, const AiRequest& request,
                                             const Progress& progress) = 0;
};

// The connection must outlive it; `server` is called anew where a conversation has to be ended.
std::unique_ptr<AiProtocol> monai_label(HttpConnection& connection);
std::unique_ptr<AiProtocol> dls(HttpConnection& connection, const WebServer& server);

// Bytes that are sent, and how far that has come.
class ReportedBytes final : public ByteSource {
 public:
  ReportedBytes(ByteSource& bytes, const Progress& progress) : bytes_(bytes), progress_(progress) {}
  [[nodiscard]] std::int64_t size() const override { return bytes_.size(); }
  std::size_t read(std::int64_t offset, std::span<std::uint8_t> room) override;

 private:
  ByteSource& bytes_;
  const Progress& progress_;
};

// As HttpConnection::error(), with what the server says of it (FastAPI: "detail").
Error refusal_of(const HttpConnection& connection, const HttpAnswer& answer);

}  // namespace tidemark::imaging
