#include "renderer/annotation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace tidemark::renderer {
namespace {

struct Stroke {
  glm::dvec2 from, to;
};

// Strokes of a glyph on a grid of 4 x 6, y downward: polylines of points "xy", parted by spaces. Small
// letters begin at y = 2, and some go down to y = 8.
std::string_view small_letter(char letter) {
  constexpr std::string_view kLetters[] = {
      "4332120305163645 4246",      // a
      "0006 0312324345361605",      // b
      "421203051646",               // c
      "4332120305163645 4046",      // d
      "044443321203051646",         // e
      "40302126 0242",              // f
      "4332120305163645 42473818",  // g
      "0006 0312324346",            // h
      "2226 2021",                  // i
      "32371808 3031",              // j
      "0006 4204 2346",             // k
      "2026",                       // l
      "0206 03122326 23324346",     // m
      "0206 0312324346",            // n
      "123243453616050312",         // o
      "0208 0312324345361605",      // p
      "4332120305163645 4248",      // q
      "0206 03123242",              // r
      "4212031434453606",           // s
      "20253646 0242",              // t
      "0205163645 4246",            // u
      "022642",                     // v
      "0216233642",                 // w
      "0246 4206",                  // x
      "0226 4218",                  // y
      "02420646",                   // z
  };
  return kLetters[letter - 'a'];
}

std::string_view glyph(char letter) {
  switch (letter) {
    case 'A':
      return "062046 1434";
    case 'F':
      return "400006 0333";
    case 'H':
      return "0006 4046 0343";
    case 'L':
      return "000646";
    case 'P':
      return "06003041423303";
    case 'R':
      return "06003041423303 1346";
    case '0':
      return "103041453616050110";
    case '1':
      return "112026";
    case '2':
      return "01103041420646";
    case '3':
      return "0110304142334445361605 2333";
    case '4':
      return "36300444";
    case '5':
      return "400003334445361605";
    case '6':
      return "30100305163645443303";
    case '7':
      return "004016";
    case '8':
      return "103041423313020110 1304051636454433";
    case '9':
      return "431302011030414536";
    case '.':
      return "2526";
    case '-':
      return "1434";
    case '=':
      return "0343 0545";
    case '?':
      return "01103041422324 2626";
    default:
      return letter >= 'a' && letter <= 'z' ? small_letter(letter) : "";
  }
}

std::vector<Stroke> strokes_of(char letter, glm::dvec2 at, double unit) {
  std::vector<Stroke> strokes;
  const std::string_view points = glyph(letter);
  std::optional<glm::dvec2> last;
  for (std::size_t i = 0; i + 1 < points.size();) {
    if (points[i] == ' ') {
      last.reset();
      ++i;
      continue;
    }
    const glm::dvec2 point = at + unit * glm::dvec2(points[i] - '0', points[i + 1] - '0');
    if (last) strokes.push_back({*last, point});
    last = point;
    i += 2;
  }
  return strokes;
}

double distance_to(const Stroke& stroke, glm::dvec2 p) {
  const glm::dvec2 along = stroke.to - stroke.from;
  const double share =
      glm::clamp(glm::dot(p - stroke.from, along) / std::max(glm::dot(along, along), 1e-9), 0.0, 1.0);
  return glm::length(p - stroke.from - share * along);
}

// White lines of that width with a dark rim.
void draw_strokes(Picture& picture, const std::vector<Stroke>& strokes, double width) {
  if (strokes.empty()) return;
  glm::dvec2 low(1e9);
  glm::dvec2 high(-1e9);
  for (const Stroke& stroke : strokes) {
    low = glm::min(low, glm::min(stroke.from, stroke.to));
    high = glm::max(high, glm::max(stroke.from, stroke.to));
  }
  const double reach = 0.5 * width + 2.0;
  const auto first = glm::max(glm::i64vec2(glm::floor(low - reach)), glm::i64vec2(0));
  const auto last =
      glm::min(glm::i64vec2(glm::ceil(high + reach)), glm::i64vec2(picture.width - 1, picture.height - 1));
  for (std::int64_t y = first.y; y <= last.y; ++y) {
    for (std::int64_t x = first.x; x <= last.x; ++x) {
      double distance = 1e9;
      for (const Stroke& stroke : strokes)
        distance = std::min(distance, distance_to(stroke, glm::dvec2(x, y) + 0.5));
      const double ink = glm::clamp(0.5 + 0.5 * width - distance, 0.0, 1.0);
      const double rim = 0.7 * glm::clamp(reach - distance, 0.0, 1.0);
      std::uint8_t* pixel = picture.pixels.data() + 4 * (x + y * picture.width);
      for (int c = 0; c < 3; ++c) {
        pixel[c] = static_cast<std::uint8_t>(std::lround(glm::mix(pixel[c] * (1.0 - rim), 255.0, ink)));
      }
    }
  }
}

// A glyph and the gap after it, in units of a sixth of the height.
constexpr double kAdvance = 6.0;

}  // namespace

double text_width(double height, std::string_view text) {
  return text.empty() ? 0.0 : (kAdvance * static_cast<double>(text.size()) - 2.0) * height / 6.0;
}

void write_text(Picture& picture, glm::dvec2 at, double height, std::string_view text) {
  const double unit = height / 6.0;
  std::vector<Stroke> strokes;
  for (const char letter : text) {
    const std::vector<Stroke> more = strokes_of(letter, at, unit);
    strokes.insert(strokes.end(), more.begin(), more.end());
    at.x += kAdvance * unit;
  }
  draw_strokes(picture, strokes, std::max(1.0, height / 8.0));
}

double scale_bar_mm(double longest_mm) {
  const double power = std::pow(10.0, std::floor(std::log10(longest_mm)));
  for (const double factor : {5.0, 2.0}) {
    if (factor * power <= longest_mm) return factor * power;
  }
  return power;
}

void annotate(Picture& picture, glm::dvec3 right, glm::dvec3 up, bool sides_are_known, double mm_per_pixel) {
  const double width = static_cast<double>(picture.width);
  const double height = static_cast<double>(picture.height);
  const double letter = std::clamp(0.03 * std::min(width, height), 9.0, 40.0);
  const double margin = 0.8 * letter;
  const auto put = [&](glm::dvec3 direction, glm::dvec2 place) {
    const std::string letters = sides_are_known ? orientation_letters(direction) : "?";
    const glm::dvec2 box(text_width(letter, letters), letter);
    const glm::dvec2 room = glm::dvec2(width, height) - 2.0 * margin - box;
    write_text(picture, margin + place * room, letter, letters);
  };
  put(-right, {0.0, 0.5});
  put(right, {1.0, 0.5});
  put(up, {0.5, 0.0});
  put(-up, {0.5, 1.0});

  const double length_mm = scale_bar_mm(0.25 * width * mm_per_pixel);
  const double length = length_mm / mm_per_pixel;
  const glm::dvec2 end(width - margin, height - margin);
  const double tick = 0.35 * letter;
  draw_strokes(picture,
               {{end - glm::dvec2(length, 0.0), end},
                {end - glm::dvec2(length, tick), end - glm::dvec2(length, 0.0)},
                {end - glm::dvec2(0.0, tick), end}},
               std::max(1.0, letter / 8.0));
  const std::string text =
      length_mm >= 10.0 ? fmt::format("{} cm", length_mm / 10.0) : fmt::format("{} mm", length_mm);
  write_text(picture, end - glm::dvec2(0.5 * (length + text_width(0.8 * letter, text)), tick + 1.3 * letter),
             0.8 * letter, text);
}

}  // namespace tidemark::renderer
