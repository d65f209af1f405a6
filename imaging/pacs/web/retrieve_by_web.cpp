#include <fstream>

#include "imaging/pacs/web/web_services.h"
#include "imaging/web/http_connection.h"
#include "imaging/web/multipart.h"

namespace tidemark::imaging {
namespace {

namespace fs = std::filesystem;

// Whatever encoding the server has: what cannot be read is told when it is opened.
constexpr const char* kObjects = "multipart/related;type=\"application/dicom\";transfer-syntax=*";
constexpr int kPartialContent = 206;

// Fills the folder with objects as they come.
class ObjectWriter {
 public:
  ObjectWriter(RetrievalFolder& folder, const PacsLimits& limits) : folder_(folder), limits_(limits) {}

  Status begin() {
    auto object = folder_.next_object();
    if (!object) return pass_on(object);
    object_ = std::move(*object);
    bytes_ = 0;
    stream_ = std::ofstream(object_, std::ios::binary);
    return check_disk();
  }
  Status take(std::string_view bytes) {
    bytes_ += static_cast<std::int64_t>(bytes.size());
    if (bytes_ > limits_.object_bytes) {
      return fail(ErrorKind::input, "the server sends an object of more than the {} MiB that are allowed",
                  limits_.object_bytes >> 20);
    }
    TIDEMARK_TRY(folder_.grown(static_cast<std::int64_t>(bytes.size())));
    stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return check_disk();
  }
  Status end() {
    stream_.close();
    TIDEMARK_TRY(check_disk());
    folder_.take(object_);
    return {};
  }

 private:
  [[nodiscard]] Status check_disk() const {
    if (stream_.good()) return {};
    return fail(ErrorKind::write, "{}: cannot be written", folder_.folder().string());
  }

  RetrievalFolder& folder_;
  const PacsLimits limits_;
  fs::path object_;
  std::ofstream stream_;
  std::int64_t bytes_ = 0;
};

std::string resource_of(const RetrieveRequest& request) {
  const std::string study = "studies/" + request.study_uid;
  return request.series_uid.empty() ? study : study + "/series/" + request.series_uid;
}

}  // namespace

Result<std::int64_t> retrieve_by_web(const PacsServer& server, const RetrieveRequest& request,
                                     const PacsLimits& limits, RetrievalFolder& retrieval_folder,
                                     const std::stop_token& stop) {
  const auto connection = open_web(server, stop);
  if (!connection) return pass_on(connection);
  ObjectWriter writer(retrieval_folder, limits);
  std::optional<MultipartReader> reader;
  const auto read = [&](const HttpAnswer& head, std::string_view bytes) -> Status {
    if (!reader) {
      auto made = MultipartReader::create(
          head.content_type,
          {[&] { return writer.begin(); }, [&](std::string_view part) { return writer.take(part); },
           [&] { return writer.end(); }});
      if (!made) return pass_on(made);
      reader = std::move(*made);
    }
    return reader->read(bytes);
  };
  // A body that is cut into parts is longer than they are.
  const std::int64_t longest = limits.retrieval_bytes + limits.objects * (std::int64_t{16} << 10);
  const auto answer =
      (*connection)
          ->ask({resource_of(request), kObjects, longest},
                [&](const HttpAnswer& head, std::string_view bytes) -> Status {
                  Status done = read(head, bytes);
                  if (!done && done.error().kind == ErrorKind::input) {
                    return fail(ErrorKind::input, "{}: {}", (*connection)->peer(), done.error().message);
                  }
                  return done;
                });
  if (!answer) return pass_on(answer);
  if (answer->status == 404) return 0;  // keep() says that there is nothing
  if (!answer->is_good()) return tl::unexpected<Error>((*connection)->error(*answer));
  if (reader && !reader->is_complete()) {
    return fail(ErrorKind::input, "{}: breaks off in the midst of an object", (*connection)->peer());
  }
  // How many it does not say.
  return answer->status == kPartialContent ? 1 : 0;
}

}  // namespace tidemark::imaging
