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
  int divisor = 1;
  const auto size = [&] {
    return PictureSize{std::max<std::int64_t>(1, full.width / divisor),
                       std::max<std::int64_t>(1, full.height / divisor)};
  };
  const auto too_slow = [&] {
    const auto pixel_seconds = expected_pixel_seconds(divisor);
    const double budget = divisor == 2 ? kForHalf * kInteractive : kInteractive;
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

void QualityControl::drawn(const Pass& pass, double seconds) {
  if (pass.moving) {
    const double measured = seconds / static_cast<double>(pass.size.width * pass.size.height);
    auto& known = pixel_seconds_[static_cast<std::size_t>(pass.divisor)];
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

// Takes the least and the greatest of each column of three pixels, then of three such columns.
std::vector<std::uint8_t> uneven_pixels(const Picture& picture, int levels) {
  const std::int64_t row = 4 * picture.width;
  std::vector<std::uint8_t> least(static_cast<std::size_t>(row));
  std::vector<std::uint8_t> greatest(least.size());
  std::vector<std::uint8_t> uneven;
  uneven.reserve(picture.pixels.size() / 4);
  for (std::int64_t y = 0; y < picture.height; ++y) {
    const std::uint8_t* const here = picture.pixels.data() + row * y;
    const std::uint8_t* const above = y > 0 ? here - row : here;
    const std::uint8_t* const below = y + 1 < picture.height ? here + row : here;
    for (std::int64_t i = 0; i < row; ++i) {
      const auto at = static_cast<std::size_t>(i);
      least[at] = std::min({above[i], here[i], below[i]});
      greatest[at] = std::max({above[i], here[i], below[i]});
    }
    for (std::int64_t x = 0; x < picture.width; ++x) {
      const auto left = static_cast<std::size_t>(4 * std::max<std::int64_t>(x - 1, 0));
      const auto middle = static_cast<std::size_t>(4 * x);
      const auto right = static_cast<std::size_t>(4 * std::min(x + 1, picture.width - 1));
      int contrast = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        const int low = std::min({least[left + c], least[middle + c], least[right + c]});
        const int high = std::max({greatest[left + c], greatest[middle + c], greatest[right + c]});
        contrast = std::max(contrast, high - low);
      }
      uneven.push_back(contrast > levels ? 1 : 0);
    }
  }
  return uneven;
}

}  // namespace tidemark::renderer
