// Rigid registration: a head that lies turned and shifted comes back.
#include "imaging/registration/registration.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "imaging/phantom/phantom.h"
#include "imaging/resample.h"
#include "tests/imaging/registration/turned.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::registration_test {

namespace {

// Voxels of 3 mm: small, so that registering takes little time.
Volume head() {
  const auto phantom = imaging::make_phantom("head");
  if (!phantom) return {};
  Geometry grid = phantom->volume.geometry;
  const glm::dvec3 length = glm::dvec3(grid.size) * grid.spacing_mm;
  grid.size = glm::max(Index3(length / 3.0), Index3(1));
  grid.spacing_mm = length / glm::dvec3(grid.size);
  return imaging::resample(phantom->volume, glm::dmat4(1.0), grid, "head")->volume;
}

Volume moved(const Volume& image, const glm::dmat4& transform) {
  return imaging::resample(image, transform, image.geometry, "head")->volume;
}

}  // namespace

class RegistrationTest : public QObject {
  Q_OBJECT

  Volume head_ = head();

 private slots:
  void a_turned_and_shifted_head_comes_back() {
    const glm::dmat4 transform = test::turned(head_.geometry, 8.0, 12.0);
    const auto found = imaging::register_rigidly(moved(head_, transform), head_);
    QCOMPARE(test::failure(found), QString());
    const imaging::Registration miss = test::miss(*found, transform, head_.geometry);
    QVERIFY2(miss.rotation_degrees < 0.5, qPrintable(QString::number(miss.rotation_degrees)));
    QVERIFY2(glm::length(miss.translation_mm) < 0.5,
             qPrintable(QString::number(glm::length(miss.translation_mm))));
    QVERIFY(std::abs(found->rotation_degrees - 8.0) < 0.5);
    QVERIFY(found->information_before);
    QVERIFY(found->information_after > *found->information_before);
  }

  // The information is in how values go together, not in the values.
  void a_head_with_other_contrast_comes_back() {
    const glm::dmat4 transform = test::turned(head_.geometry, 5.0, 8.0);
    Volume other = moved(head_, transform);
    const float high = other.range().second;
    auto& values = std::get<std::vector<float>>(other.voxels);
    for (float& value : values) value = std::sqrt(std::max(0.0F, high - value));
    const auto found = imaging::register_rigidly(other, head_);
    QCOMPARE(test::failure(found), QString());
    const imaging::Registration miss = test::miss(*found, transform, head_.geometry);
    QVERIFY2(miss.rotation_degrees < 0.5, qPrintable(QString::number(miss.rotation_degrees)));
    QVERIFY2(glm::length(miss.translation_mm) < 0.5,
             qPrintable(QString::number(glm::length(miss.translation_mm))));
  }

  void an_image_of_another_frame_is_centred_first() {
    Volume far = moved(head_, test::turned(head_.geometry, 4.0, 6.0));
    const glm::dvec3 away(2000.0, 0.0, -500.0);
    far.geometry.origin_mm += away;
    const auto found = imaging::register_rigidly(far, head_);
    QCOMPARE(test::failure(found), QString());
    const glm::dmat4 all = glm::translate(glm::dmat4(1.0), away) * test::turned(head_.geometry, 4.0, 6.0);
    const imaging::Registration miss = test::miss(*found, all, head_.geometry);
    QVERIFY(miss.rotation_degrees < 0.5);
    QVERIFY(glm::length(miss.translation_mm) < 0.5);
    QVERIFY(!found->information_before);  // the search did not begin there
  }

  void a_start_with_rounded_numbers_is_taken() {
    const glm::dmat4 transform = test::turned(head_.geometry, 8.0, 12.0);
    glm::dmat4 start = glm::inverse(transform);
    for (int column = 0; column < 3; ++column) start[column] = glm::round(start[column] * 1e3) / 1e3;
    const auto found = imaging::register_rigidly(moved(head_, transform), head_, start);
    QCOMPARE(test::failure(found), QString());
    const imaging::Registration miss = test::miss(*found, transform, head_.geometry);
    QVERIFY(miss.rotation_degrees < 0.5);
    QVERIFY(glm::length(miss.translation_mm) < 0.5);
    QVERIFY(found->information_before);
  }

  void the_same_images_give_the_same_bits() {
    const Volume turned = moved(head_, test::turned(head_.geometry, 3.0, 4.0));
    const auto once = imaging::register_rigidly(turned, head_);
    const auto again = imaging::register_rigidly(turned, head_);
    QVERIFY(once && again);
    QVERIFY(once->to_fixed == again->to_fixed);
  }

  void progress_rises_and_a_request_ends_the_search() {
    std::stop_source source;
    double last = 0.0;
    bool rises = true;
    const Progress progress{[&](double fraction, std::string_view) {
                              rises = rises && fraction >= last && fraction <= 1.0;
                              last = fraction;
                              if (fraction > 0.3) source.request_stop();
                            },
                            source.get_token()};
    const auto found = imaging::register_rigidly(moved(head_, test::turned(head_.geometry, 8.0, 12.0)), head_,
                                                 glm::dmat4(1.0), progress);
    QVERIFY(!found);
    QCOMPARE(found.error().kind, ErrorKind::cancelled);
    QVERIFY(rises);
    QVERIFY(last > 0.3 && last < 0.5);
  }

  void an_image_of_one_value_is_refused() {
    Volume even = head_;
    even.slope = 0.0;
    const auto found = imaging::register_rigidly(even, head_);
    QVERIFY(!found);
    QCOMPARE(found.error().kind, ErrorKind::usage);
    QVERIFY(found.error().message.find("single value") != std::string::npos);
  }

  void a_single_slice_is_refused() {
    Volume slice = head_;
    slice.geometry.size.z = 1;
    std::visit([&](auto& voxels) { voxels.resize(static_cast<std::size_t>(slice.geometry.voxel_count())); },
               slice.voxels);
    for (const bool is_moving : {true, false}) {
      const auto found =
          is_moving ? imaging::register_rigidly(slice, head_) : imaging::register_rigidly(head_, slice);
      QVERIFY(!found);
      QCOMPARE(found.error().kind, ErrorKind::usage);
      QVERIFY(found.error().message.find("single slice") != std::string::npos);
    }
  }
};

TIDEMARK_TEST(RegistrationTest)

}  // namespace tidemark::test::registration_test

#include "registration_test.moc"
