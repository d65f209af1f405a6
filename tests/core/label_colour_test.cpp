// Labels are told apart from what else is coloured in a slice, also by people who see few colours.
#include "core/label_colour.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include "tests/support/test_program.h"

namespace tidemark::test::label_colour_test {

namespace {

// What dichromats see of linear RGB (Machado, Oliveira and Fernandes 2009, severity 1), by columns.
const glm::dmat3 kEyes[] = {
    glm::dmat3(1.0),
    {0.152286, 0.114503, -0.003882, 1.052583, 0.786281, -0.048116, -0.204868, 0.099216, 1.051998},
    {0.367322, 0.280085, -0.011820, 0.860646, 0.672501, 0.042940, -0.227968, 0.047413, 0.968881},
    {1.255528, -0.078411, 0.004733, -0.076749, 0.930809, 0.691367, -0.178779, 0.147602, 0.303900}};

double linear(double channel) {
  return channel <= 0.04045 ? channel / 12.92 : std::pow((channel + 0.055) / 1.055, 2.4);
}

glm::dvec3 cielab(glm::dvec3 rgb) {
  const glm::dmat3 xyz_from_rgb(0.4124, 0.2126, 0.0193, 0.3576, 0.7152, 0.1192, 0.1805, 0.0722, 0.9505);
  const glm::dvec3 xyz =
      xyz_from_rgb * glm::clamp(rgb, glm::dvec3(0.0), glm::dvec3(1.0)) / glm::dvec3(0.9505, 1.0, 1.089);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  return {116.0 * f(xyz.y) - 16.0, 500.0 * (f(xyz.x) - f(xyz.y)), 200.0 * (f(xyz.y) - f(xyz.z))};
}

// The smallest distance for any eye; 2.3 is just noticed.
double distance(glm::dvec3 a, glm::dvec3 b) {
  const auto to_linear = [](glm::dvec3 c) { return glm::dvec3(linear(c.r), linear(c.g), linear(c.b)); };
  double least = 1000.0;
  for (const glm::dmat3& eye : kEyes)
    least = std::min(least, glm::distance(cielab(eye * to_linear(a)), cielab(eye * to_linear(b))));
  return least;
}

}  // namespace

class LabelColourTest : public QObject {
  Q_OBJECT

 private slots:
  void the_first_label_is_apart_from_outline_speed_map_and_grey() {
    const auto [red, green, blue] = label_colour(1);
    const glm::dvec3 first = glm::dvec3(red, green, blue) / 255.0;
    // As in resources/shaders/render/colours.glsl.
    QVERIFY2(distance(first, {1.0, 0.85, 0.0}) > 30.0, "the surface's outline");
    QVERIFY2(distance(first, {0.80, 0.40, 0.05}) > 30.0, "where it grows");
    QVERIFY2(distance(first, {0.13, 0.36, 0.67}) > 30.0, "where it shrinks");
    QVERIFY2(distance(first, glm::dvec3(0.6)) > 30.0, "tissue");
  }

  void no_two_labels_have_the_same() {
    for (int a = 1; a < 256; ++a) {
      for (int b = a + 1; b < 256; ++b)
        QVERIFY(label_colour(static_cast<std::uint8_t>(a)) != label_colour(static_cast<std::uint8_t>(b)));
    }
  }
};

TIDEMARK_TEST(LabelColourTest)

}  // namespace tidemark::test::label_colour_test

#include "label_colour_test.moc"
