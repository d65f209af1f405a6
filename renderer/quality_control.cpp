#include "renderer/quality_control.h"

#include <algorithm>
#include <cstdlib>

namespace tidemark::renderer {

void QualityControl::moved() {
  still_pictures_ = -1;
}

std::optional<Pass> QualityControl::next(PictureSize full, int rounds, double seconds) const {
  if (still_pictures_ >= rounds) return std::nullopt;
  if (still_pictures_ >= 0) {
    Quality quality;
    quality.round = still_pictures_;
    return Pass{full, quality, false};
  }
  // The first picture of a study tells how long its pixels take; it is small to be safe.
  int divisor = 1;
  const auto size = [&] {
    return PictureSize{std::max<std::int64_t>(1, full.width / divisor),
                       std::max<std::int64_t>(1, full.height / divisor)};
  };
  const auto too_slow = [&] {
    const auto pixel_seconds = expected_pixel_seconds(divisor);
    const double budget = divisor == 2 ? kForHalf * seconds : seconds;
    return !pixel_seconds || *pixel_seconds * static_cast<double>(size().width * size().height) > budget;
  };
  while (divisor < kSmallest && too_slow()) ++divisor;
  return Pass{size(), kMovingQuality, true, divisor};
}

// By the next coarser pictures that are known. Where rays are nearer to one another they find more of what
// they read in caches, so that the next size is worth a try.
std::optional<double> QualityControl::expected_pixel_seconds(int divisor) const {
  constexpr double kNearer = 0.85;
  if (const auto known = pixel_seconds_[static_cast<std::size_t>(divisor)]) return known;
  for (int coarser = divisor + 1; coarser <= kSmallest; ++coarser) {
    const auto known = pixel_seconds_[static_cast<std::size_t>(coarser)];
    if (known) return coarser == divisor + 1 ? kNearer * *known : *known;
  }
  return std::nullopt;
}

void QualityControl::drawn(const Pass& pass, double seconds, double painted) {
  const double measured = seconds / (painted * static_cast<double>(pass.size.width * pass.size.height));
  auto& known = pixel_seconds_[static_cast<std::size_t>(pass.divisor)];
  // What was kept for the most part says of pixels no more than that they take no longer.
  if (pass.moving && (painted > 0.5 || (known && measured < *known))) {
    // Half of the change: one slow picture on a busy machine does not make the next ones coarse. A view that
    // became slower is so at all sizes.
    const double change = known && *known > 0.0 ? 0.5 * (1.0 + measured / *known) : 1.0;
    if (!known || *known <= 0.0) known = measured;
    for (auto& any : pixel_seconds_) {
      if (any) *any *= change;
    }
    // A pixel of a finer picture takes no longer than one of a coarser: what says so was disturbed.
    std::optional<double> least;
    for (auto any = pixel_seconds_.rbegin(); any != pixel_seconds_.rend(); ++any) {
      if (*any) least = *any = least ? std::min(**any, *least) : **any;
    }
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

std::vector<std::uint8_t> uneven_pixels(const Picture& picture, int levels) {
  const auto pixels = static_cast<std::size_t>(picture.width * picture.height);
  const auto width = static_cast<std::size_t>(picture.width);
  std::vector<std::uint8_t> uneven(pixels, 0);
  const auto compare = [&](std::size_t one, std::size_t other) {
    const std::uint8_t* const a = picture.pixels.data() + 4 * one;
    const std::uint8_t* const b = picture.pixels.data() + 4 * other;
    const int difference = std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
    if (difference > levels) uneven[one] = uneven[other] = 1;
  };
  for (std::size_t row = 0; row < pixels; row += width) {
    for (std::size_t x = 1; x < width; ++x) compare(row + x - 1, row + x);
    if (row == 0) continue;
    for (std::size_t x = 0; x < width; ++x) compare(row - width + x, row + x);
  }
  return uneven;
}

}  // namespace tidemark::renderer
