#include "imaging/dicom/dcmtk_stream.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcistrma.h>
#include <dcmtk/dcmdata/dctk.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace tidemark::imaging {
namespace {

// Reads from `at` on, through a window: most headers fit into it. A file that has become shorter than it said
// ends there.
class Producer : public DcmProducer {
 public:
  Producer(ByteSource& source, std::int64_t at) : source_(source), at_(at), end_(source.size()) {}

  [[nodiscard]] OFBool good() const override { return status_.good(); }
  [[nodiscard]] OFCondition status() const override { return status_; }
  OFBool eos() override { return at_ >= end_; }
  offile_off_t avail() override { return end_ - at_; }
  offile_off_t read(void* room, offile_off_t wanted) override {
    const auto count = static_cast<std::size_t>(std::min<offile_off_t>(wanted, avail()));
    const std::span bytes(static_cast<std::uint8_t*>(room), count);
    const std::size_t got = count > window_.size() ? source_.read(at_, bytes) : read_window(bytes);
    at_ += static_cast<std::int64_t>(got);
    if (got < count) {
      // DCMTK takes the value for whole all the same.
      std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(got), bytes.end(), std::uint8_t{0});
      end_ = at_;
      status_ = EC_InvalidStream;
    }
    return static_cast<offile_off_t>(got);
  }
  offile_off_t skip(offile_off_t wanted) override {
    const auto step = std::min<offile_off_t>(wanted, avail());
    at_ += step;
    return step;
  }
  void putback(offile_off_t count) override { at_ -= std::min<offile_off_t>(count, at_); }

 private:
  std::size_t read_window(std::span<std::uint8_t> bytes) {
    const auto wanted = static_cast<std::int64_t>(bytes.size());
    if (at_ < begin_ || at_ + wanted > begin_ + held_) {
      begin_ = at_;
      held_ = static_cast<std::int64_t>(source_.read(at_, window_));
    }
    const std::int64_t got = std::min(wanted, begin_ + held_ - at_);
    std::memcpy(bytes.data(), window_.data() + (at_ - begin_), static_cast<std::size_t>(got));
    return static_cast<std::size_t>(got);
  }

  ByteSource& source_;
  std::int64_t at_;
  std::int64_t end_;
  OFCondition status_ = EC_Normal;
  std::int64_t begin_ = 0;  // of the window
  std::int64_t held_ = 0;
  std::array<std::uint8_t, 8192> window_;
};

class SourceStream : public DcmInputStream {
 public:
  SourceStream(ByteSource& source, std::int64_t at)
      : DcmInputStream(&producer_), source_(source), producer_(source, at), begin_(at) {}
  // For a value that is read later. An inflated stream cannot be read again from its middle.
  [[nodiscard]] DcmInputStreamFactory* newFactory() const override;

 private:
  ByteSource& source_;
  Producer producer_;
  std::int64_t begin_;
};

class StreamFactory : public DcmInputStreamFactory {
 public:
  StreamFactory(ByteSource& source, std::int64_t at) : source_(source), at_(at) {}
  [[nodiscard]] DcmInputStream* create() const override { return new SourceStream(source_, at_); }
  [[nodiscard]] DcmInputStreamFactory* clone() const override { return new StreamFactory(*this); }
  // There is no name for others; this one means that nothing has to be removed at the end.
  [[nodiscard]] DcmInputStreamFactoryType ident() const override { return DFT_DcmInputFileStreamFactory; }

 private:
  ByteSource& source_;
  std::int64_t at_;
};

DcmInputStreamFactory* SourceStream::newFactory() const {
  return currentProducer() == &producer_ ? new StreamFactory(source_, begin_ + tell()) : nullptr;
}

}  // namespace

std::string parse_dicom(ByteSource& bytes, const TransferSyntax& syntax, DcmFileFormat& loaded,
                        std::optional<DicomTag> stop_at) {
  SourceStream stream(bytes, 0);
  loaded.transferInit();
  const OFCondition read = loaded.readUntilTag(
      stream, DcmXfer(std::string(syntax.uid).c_str()).getXfer(), EGL_noChange, DCM_MaxReadLength,
      stop_at ? DcmTagKey(stop_at->group, stop_at->element) : DCM_UndefinedTagKey);
  loaded.transferEnd();
  return read.good() ? std::string() : std::string(read.text());
}

}  // namespace tidemark::imaging
