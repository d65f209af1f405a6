#include "renderer/quality_control.h"

#include <algorithm>

namespace tidemark::renderer {

void QualityControl::moved() {
  still_pictures_ = -1;
}

std::optional<Pass> QualityControl::next(PictureSize full, int rounds) const {
  if (still_pictures_ >= rounds) return std::nullopt;
  if (still_pictures_ >= 0) {
    Quality quality;
    quality.round = still_pictures_;
    return Pass{full, quality, false};
  }
  // The first picture of a study tells how long its pixels take; it is small to be safe.
  std::int64_t divisor = kSmallest;
  if (pixel_seconds_) {
    divisor = 1;
    const auto seconds = [&](std::int64_t d) {
      const std::int64_t pixels = (full.width / d) * (full.height / d);
      return *pixel_seconds_ * static_cast<double>(pixels);
    };
    while (divisor < kSmallest && seconds(divisor) > budget_seconds_) ++divisor;
  }
  return Pass{
      {std::max<std::int64_t>(1, full.width / divisor), std::max<std::int64_t>(1, full.height / divisor)},
      kMovingQuality,
      true};
}

void QualityControl::drawn(const Pass& pass, double seconds) {
  if (pass.moving) {
    const double measured = seconds / static_cast<double>(pass.size.width * pass.size.height);
    // Half of what it was before: one slow picture on a busy machine does not make the next ones coarse.
    pixel_seconds_ = pixel_seconds_ ? 0.5 * (*pixel_seconds_ + measured) : measured;
  }
  if (pass.moving == (still_pictures_ < 0)) ++still_pictures_;
}

void PictureMean::add(const Picture& picture) {
  if (size_ != PictureSize{picture.width, picture.height} || count_ == 0) {
    size_ = {picture.width, picture.height};
    count_ = 0;
    sums_.assign(picture.pixels.size(), 0);
  }
  for (std::size_t i = 0; i < sums_.size(); ++i) sums_[i] += picture.pixels[i];
  ++count_;
}

Picture PictureMean::mean() const {
  // Divided once for each sum that there may be, and not for each byte.
  const auto count = static_cast<std::uint32_t>(std::max(count_, 1));
  std::vector<std::uint8_t> mean_of(255 * std::size_t{count} + 1);
  for (std::uint32_t sum = 0; sum < mean_of.size(); ++sum) {
    mean_of[sum] = static_cast<std::uint8_t>((sum + count / 2) / count);
  }
  Picture picture{size_.width, size_.height, std::vector<std::uint8_t>(sums_.size())};
  for (std::size_t i = 0; i < sums_.size(); ++i) picture.pixels[i] = mean_of[sums_[i]];
  return picture;
}

}  // namespace tidemark::renderer
