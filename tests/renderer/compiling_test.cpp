// A driver that plays the GPU compiles for a picture at most once.
#include <QTest>
#include <fstream>
#include <sstream>
#include <string>

#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::compiling_test {

namespace {

// Compiled code lies in memory that belongs to no file and can be executed.
std::int64_t bytes_of_compiled_code() {
  std::ifstream maps("/proc/self/maps");
  std::int64_t bytes = 0;
  for (std::string line; std::getline(maps, line);) {
    std::istringstream fields(line);
    std::string range, rights, offset, device, inode, path;
    fields >> range >> rights >> offset >> device >> inode >> path;
    if (rights.find('x') == std::string::npos || !path.empty()) continue;
    const std::size_t dash = range.find('-');
    bytes += std::stoll(range.substr(dash + 1), nullptr, 16) - std::stoll(range.substr(0, dash), nullptr, 16);
  }
  return bytes;
}

std::vector<renderer::VolumeView> views() {
  renderer::VolumeView surface;
  renderer::VolumeView source;
  source.source = transfer_function(
      R"({"source": [{"value": {"ramp": [100, 1000]}, "colour": [1, 1, 1], "opacity": 0.2}]})");
  renderer::VolumeView inside = source;
  inside.surface = false;
  inside.region = renderer::Region::inside;
  renderer::VolumeView coloured_by_speed = surface;
  coloured_by_speed.colouring = renderer::SurfaceColouring::total_speed;
  renderer::VolumeView clipped = surface;
  clipped.clip = renderer::ClipPlane{};
  std::vector<renderer::VolumeView> all{surface, source, inside, coloured_by_speed, clipped};
  for (std::size_t i = 0, rays = all.size(); i < rays; ++i) {
    all.push_back(all[i]);
    all.back().mode = renderer::Mode::slices;
  }
  return all;
}

}  // namespace

class CompilingTest : public QObject {
  Q_OBJECT

 private slots:
  void views_in_another_order_compile_nothing_more() {
    Painter draw(ball_scene(grid({48, 48, 48}), 15.0));
    if (!draw.device().capabilities().software) QSKIP("a GPU's driver compiles elsewhere");
    const std::vector<renderer::VolumeView> all = views();
    for (const renderer::VolumeView& view : all) draw(view, 96, 72);
    draw(renderer::SliceView(), 96, 72);
    const std::int64_t before = bytes_of_compiled_code();
    QVERIFY(before > 0);
    for (auto view = all.rbegin(); view != all.rend(); ++view) {
      draw(*view, 96, 72);
      draw(renderer::SliceView(), 96, 72);
    }
    // Of the same kind: llvmpipe tells textures apart whose sides are powers of two.
    for (std::size_t i = 0; i < all.size(); ++i) draw(all[3 * i % all.size()], 80, 48);
    QCOMPARE(bytes_of_compiled_code(), before);
  }

  void what_is_compiled_is_no_piece_of_the_picture() {
    Painter draw(ball_scene(grid({48, 48, 48}), 15.0));
    if (!draw.device().capabilities().software) QSKIP("a GPU's driver compiles elsewhere");
    draw(renderer::VolumeView(), 96, 72);
    const renderer::DrawReport report = draw.gl().last_draw();
    QVERIFY(report.prepare_seconds > 0.0);
    QVERIFY(report.seconds >= report.prepare_seconds + report.longest_piece_seconds);
  }
};

TIDEMARK_TEST(CompilingTest)

}  // namespace tidemark::test::compiling_test

#include "compiling_test.moc"
