// The picture of a sweep: a matrix of slices with numbers on heat colours, and the agreement of all runs.
#include <glm/vec2.hpp>

#include "app/cli/sweep_files.h"
#include "document/sweep_picture.h"
#include "renderer/annotation.h"
#include "renderer/sheet.h"

namespace tidemark::cli {
namespace {

// In pixels.
constexpr int kSide = 144;  // of a run's picture
constexpr int kStrip = 20;  // of a number's height
constexpr int kGap = 6;
constexpr int kLeft = 108;  // for the values of the rows
constexpr int kTop = 56;    // for the name and the values of the columns
constexpr double kLetters = 10.0;
constexpr document::SweepColour kBackground{24, 26, 30};
constexpr document::SweepColour kNothing{70, 70, 74};  // behind a number that is not there

// A volume with three digits.
std::string short_text(double value) {
  return value < 10.0    ? fmt::format("{:.2f}", value)
         : value < 100.0 ? fmt::format("{:.1f}", value)
                         : fmt::format("{:.0f}", value);
}

class Sheet {
 public:
  Sheet(const document::Sweep& sweep, const Volume& source)
      : sweep_(sweep),
        source_(source),
        window_(renderer::window_of(source)),
        cut_(document::sweep_cut(sweep.agreement, source.geometry)),
        volumes_(document::volume_scale(sweep)),
        dices_(document::dice_scale(sweep)),
        has_dice_(std::any_of(sweep.runs.begin(), sweep.runs.end(),
                              [](const document::SweepRun& run) { return run.dice.has_value(); })) {}

  renderer::Picture draw();

 private:
  [[nodiscard]] int cell_height() const { return kSide + (has_dice_ ? 2 : 1) * kStrip + kGap; }
  void draw_axes();
  void draw_run(glm::ivec2 at, const document::SweepRun& run);
  void draw_below(int top);
  int draw_scale(glm::ivec2 at, const std::string& name, const std::string& low, const std::string& high);
  void fill(glm::ivec2 at, glm::ivec2 size, const document::SweepColour& colour);
  void put(glm::ivec2 at, const document::SweepPicture& picture);
  void write(glm::dvec2 at, const std::string& text) { renderer::write_text(sheet_, at, kLetters, text); }
  void write_in_middle(glm::ivec2 at, int width, const std::string& text);
  // On a strip below a run's picture.
  void write_number(glm::ivec2 at, const std::string& text, const document::SweepColour& colour);

  const document::Sweep& sweep_;
  const Volume& source_;
  WindowLevel window_;
  document::SweepCut cut_;
  document::SweepScale volumes_;
  document::SweepScale dices_;
  bool has_dice_;
  renderer::Picture sheet_;
};

renderer::Picture Sheet::draw() {
  const int columns = std::max(sweep_.columns(), 3);  // as wide as what lies below
  const int below = kTop + sweep_.rows() * cell_height() + kGap;
  sheet_.width = kLeft + columns * (kSide + kGap) + kGap;
  sheet_.height = below + kSide + 2 * kGap;
  sheet_.pixels.assign(static_cast<std::size_t>(4 * sheet_.width * sheet_.height), 255);
  fill({0, 0}, {sheet_.width, sheet_.height}, kBackground);
  draw_axes();
  for (int row = 0; row < sweep_.rows(); ++row) {
    for (int column = 0; column < sweep_.columns(); ++column) {
      draw_run({kLeft + column * (kSide + kGap), kTop + row * cell_height()}, sweep_.at(column, row));
    }
  }
  draw_below(below);
  return std::move(sheet_);
}

void Sheet::draw_axes() {
  const document::SweepAxis& across = sweep_.axes.front();
  write({kLeft, 12.0}, across.parameter);
  for (int column = 0; column < sweep_.columns(); ++column) {
    write_in_middle({kLeft + column * (kSide + kGap), kTop - 20}, kSide,
                    fmt::format("{:.4g}", across.value(column)));
  }
  if (sweep_.axes.size() < 2) return;
  const document::SweepAxis& down = sweep_.axes.back();
  write({12.0, kTop - 20.0}, down.parameter);
  for (int row = 0; row < sweep_.rows(); ++row) {
    write({12.0, kTop + row * cell_height() + 0.5 * (kSide - kLetters)},
          fmt::format("{:.4g}", down.value(row)));
  }
}

void Sheet::draw_run(glm::ivec2 at, const document::SweepRun& run) {
  put(at, document::picture_of(run.inside, source_, window_, cut_, kSide));
  const bool there = run.volume_ml > 0.0;
  std::string volume = short_text(run.volume_ml) + " ml";
  if (!there) volume = run.problem.empty() ? "vanished" : "no memory";
  glm::ivec2 strip = at + glm::ivec2(0, kSide);
  write_number(strip, volume, there ? document::heat_colour(volumes_.share(run.volume_ml)) : kNothing);
  if (!has_dice_) return;
  strip.y += kStrip;
  write_number(strip, run.dice ? fmt::format("dice {:.3f}", *run.dice) : std::string(),
               there && run.dice ? document::heat_colour(dices_.share(*run.dice)) : kNothing);
}

// The agreement and what the colours mean.
void Sheet::draw_below(int top) {
  put({kLeft, top}, document::picture_of(sweep_.agreement, source_, window_, cut_, kSide));
  write({12.0, top + 0.5 * (kSide - kLetters)}, "agreement");
  glm::ivec2 at(kLeft + kSide + 3 * kGap, top + kGap);
  const std::string all = fmt::format("{}", sweep_.agreement.surfaces());
  at.y = draw_scale(at, "inside in", "1 of " + all, all + " of " + all);
  at.y = draw_scale(at, "volume", short_text(volumes_.low), short_text(volumes_.high) + " ml");
  if (has_dice_) {
    draw_scale(at, "dice", fmt::format("{:.3f}", dices_.low), fmt::format("{:.3f}", dices_.high));
  }
}

// Returns where the next one begins.
int Sheet::draw_scale(glm::ivec2 at, const std::string& name, const std::string& low,
                      const std::string& high) {
  constexpr int kLength = kSide + kSide / 2;
  write(at, name);
  for (int x = 0; x < kLength; ++x) {
    fill({at.x + x, at.y + 14}, {1, 10}, document::heat_colour(static_cast<double>(x) / (kLength - 1)));
  }
  write({at.x, at.y + 28}, low);
  write({at.x + kLength - renderer::text_width(kLetters, high), at.y + 28}, high);
  return at.y + 46;
}

void Sheet::fill(glm::ivec2 at, glm::ivec2 size, const document::SweepColour& colour) {
  for (int y = at.y; y < at.y + size.y; ++y) {
    std::uint8_t* pixel = sheet_.pixels.data() + 4 * (y * sheet_.width + at.x);
    for (int x = 0; x < size.x; ++x, pixel += 4) std::copy(colour.begin(), colour.end(), pixel);
  }
}

void Sheet::put(glm::ivec2 at, const document::SweepPicture& picture) {
  for (int y = 0; y < picture.side; ++y) {
    const auto row = picture.pixels.begin() + static_cast<std::ptrdiff_t>(4 * y) * picture.side;
    std::copy_n(row, 4 * picture.side, sheet_.pixels.begin() + 4 * ((at.y + y) * sheet_.width + at.x));
  }
}

void Sheet::write_in_middle(glm::ivec2 at, int width, const std::string& text) {
  write({at.x + 0.5 * (width - renderer::text_width(kLetters, text)), at.y}, text);
}

void Sheet::write_number(glm::ivec2 at, const std::string& text, const document::SweepColour& colour) {
  fill(at, {kSide, kStrip}, colour);
  write_in_middle(at + glm::ivec2(0, kStrip / 4), kSide, text);
}

}  // namespace

renderer::Picture sweep_sheet(const document::Sweep& sweep, const Volume& source) {
  return Sheet(sweep, source).draw();
}

}  // namespace tidemark::cli
