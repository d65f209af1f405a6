// Contours around what is inside a slice, and what they surround.
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "imaging/results/polygon_fill.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::contours_test {

class ContoursTest : public QObject {
  Q_OBJECT

  // A slice drawn by characters: '#' is inside.
  struct Picture {
    std::vector<std::string> rows;
    [[nodiscard]] std::int64_t width() const { return static_cast<std::int64_t>(rows.front().size()); }
    [[nodiscard]] std::int64_t height() const { return static_cast<std::int64_t>(rows.size()); }
    [[nodiscard]] bool inside(std::int64_t i, std::int64_t j) const {
      return rows[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] == '#';
    }
  };

  static std::vector<imaging::Contour> trace(const Picture& picture) {
    return imaging::trace_contours(picture.width(), picture.height(), [&](std::int64_t i, std::int64_t j) {
      return picture.inside(i, j) ? 1.0 : -1.0;
    });
  }

  static void verify_filled(const std::vector<imaging::Contour>& contours, const Picture& picture) {
    std::vector<std::uint8_t> slice(static_cast<std::size_t>(picture.width() * picture.height()));
    for (const imaging::Contour& contour : contours) {
      QVERIFY(!imaging::flip_inside(contour, picture.width(), picture.height(), slice));
    }
    for (std::int64_t j = 0; j < picture.height(); ++j) {
      for (std::int64_t i = 0; i < picture.width(); ++i) {
        QCOMPARE(slice[static_cast<std::size_t>(i + j * picture.width())] != 0, picture.inside(i, j));
      }
    }
  }

 private slots:
  void contours_surround_what_was_inside_data() {
    QTest::addColumn<QStringList>("rows");
    QTest::addColumn<int>("regions");
    QTest::newRow("one voxel") << QStringList{"...", ".#.", "..."} << 1;
    QTest::newRow("everything") << QStringList{"##", "##"} << 1;
    QTest::newRow("at the border") << QStringList{"#..", "##.", "..#"} << 2;
    QTest::newRow("two regions") << QStringList{"##...", "##...", "...##"} << 2;
    QTest::newRow("a hole") << QStringList{"#####", "#...#", "#.#.#", "#...#", "#####"} << 2;
    QTest::newRow("two holes") << QStringList{"#######", "#..#..#", "#..#..#", "#######"} << 1;
    QTest::newRow("holes one behind another") << QStringList{"#########", "#.#.#.#.#", "#########"} << 1;
    QTest::newRow("a hole in an island in a hole")
        << QStringList{"#########", "#.......#", "#.#####.#", "#.#...#.#",
                       "#.#####.#", "#.......#", "#########"}
        << 2;
    QTest::newRow("corners that touch") << QStringList{"#.#.", ".#.#", "#.#."} << 6;
    QTest::newRow("nothing") << QStringList{"...", "..."} << 0;
  }

  void contours_surround_what_was_inside() {
    QFETCH(QStringList, rows);
    QFETCH(int, regions);
    Picture picture;
    for (const QString& row : rows) picture.rows.push_back(row.toStdString());
    const auto contours = trace(picture);
    QCOMPARE(static_cast<int>(contours.size()), regions);
    for (const imaging::Contour& contour : contours) QVERIFY(imaging::signed_area(contour) > 0.0);
    verify_filled(contours, picture);
  }

  // Joined by "or", as readers do that know no exclusive or, regions without overlap are the same.
  void keyholes_are_holes_to_readers_that_join_by_or() {
    std::mt19937 random(7);
    for (int trial = 0; trial < 50; ++trial) {
      Picture picture;
      for (int j = 0; j < 23; ++j) {
        std::string row;
        for (int i = 0; i < 31; ++i) row += random() % 10 < 6 ? '#' : '.';
        picture.rows.push_back(row);
      }
      const auto contours = trace(picture);
      verify_filled(contours, picture);
      std::vector<std::uint8_t> together(31 * 23);
      for (const imaging::Contour& contour : contours) {
        std::vector<std::uint8_t> one(together.size());
        imaging::flip_inside(contour, 31, 23, one);
        for (std::size_t v = 0; v < one.size(); ++v) {
          QVERIFY(!(one[v] != 0 && together[v] != 0));
          together[v] |= one[v];
        }
      }
    }
  }

  // Each corner of a voxel that stands out is cut off by an eighth of a voxel, each one that goes in filled.
  void a_rectangle_loses_its_corners() {
    Picture picture{{"......", ".####.", ".####.", ".####.", "......"}};
    QCOMPARE(imaging::signed_area(trace(picture).front()), 12.0 - 0.5);
    picture.rows[2] = ".#..#.";
    QCOMPARE(imaging::signed_area(trace(picture).front()), 10.0 - 0.5 + 0.5);
  }

  void contours_of_a_field_are_between_voxels() {
    const auto ball = [](std::int64_t i, std::int64_t j) {
      return 11.3 - std::hypot(static_cast<double>(i) - 20.2, static_cast<double>(j) - 19.6);
    };
    const auto contours = imaging::trace_contours(41, 40, ball);
    QCOMPARE(contours.size(), std::size_t{1});
    for (const glm::dvec2 point : contours.front()) {
      QVERIFY(std::abs(glm::distance(point, glm::dvec2(20.2, 19.6)) - 11.3) < 0.02);
    }
    QVERIFY(std::abs(imaging::signed_area(contours.front()) / (M_PI * 11.3 * 11.3) - 1.0) < 0.005);
  }

  void a_voxel_that_is_hardly_inside_stays_inside() {
    const auto hardly = [](std::int64_t i, std::int64_t j) { return i == 2 && j == 2 ? 1e-30 : -1e3; };
    const auto contours = imaging::trace_contours(5, 5, hardly);
    QCOMPARE(contours.size(), std::size_t{1});
    for (const glm::dvec2 point : contours.front()) QVERIFY(glm::distance(point, {2.0, 2.0}) > 0.01);
  }

  void what_lies_beyond_the_slice_is_said_and_left_out() {
    std::vector<std::uint8_t> slice(4 * 3);
    const std::vector<glm::dvec2> large{{-1e12, -1e12}, {1e12, -1e12}, {1e12, 1e12}, {-1e12, 1e12}};
    QVERIFY(imaging::flip_inside(large, 4, 3, slice));
    QCOMPARE(std::count(slice.begin(), slice.end(), 1), 12);
    const std::vector<glm::dvec2> half{{1.5, -0.5}, {3.5, -0.5}, {3.5, 2.5}, {1.5, 2.5}};
    QVERIFY(!imaging::flip_inside(half, 4, 3, slice));
    QCOMPARE(std::count(slice.begin(), slice.end(), 1), 6);
  }
};

TIDEMARK_TEST(ContoursTest)

}  // namespace tidemark::test::contours_test

#include "contours_test.moc"
