// Maps that are placed on the grid of a study.
#include "document/speed_map.h"

#include <cmath>

#include "imaging/files/volume_file.h"
#include "imaging/results/results.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/grid.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::speed_map_test {

namespace {

// All voxels of the grid are inside, but for a slice.
void write_block(const Geometry& grid, const std::filesystem::path& file, std::int64_t left_out = -1) {
  imaging::Segment segment;
  for (std::int64_t k = 0; k < grid.size.z; ++k)
    segment.slices[k] = std::vector<std::uint8_t>(static_cast<std::size_t>(grid.size.x * grid.size.y), 1);
  segment.slices.erase(left_out);
  QCOMPARE(failure(imaging::write_segmentation({grid, {segment}, {}}, {}, file)), QString());
}

}  // namespace

class SpeedMapTest : public QObject {
  Q_OBJECT

  Geometry study_ = grid_of({20, 18, 16}, glm::dvec3(1.0), {-5.0, 3.0, 8.0});
  TemporaryFolder folder_;

  // D of a voxel, with what the map holds by its values.
  double speed_at(const std::shared_ptr<const document::SpeedMap>& map, Index3 voxel) const {
    auto source = std::make_shared<Volume>();
    source->geometry = study_;
    source->voxels = std::vector<std::int16_t>(static_cast<std::size_t>(study_.voxel_count()));
    document::Drive drive;
    drive.setting.terms = {{"image", {}}};
    drive.map = map;
    const auto speed = document::make_speed(drive, source, {});
    if (!speed) qFatal("%s", speed.error().message.c_str());
    double d = 0.0;
    (*speed)->evaluate({voxel, Index3(1)}, &d);
    return d;
  }

 private slots:
  void frames_of_a_part_of_the_study_lie_where_they_belong() {
    // Voxels of the study, from (4, 5, 6) on.
    write_block(grid_of({6, 5, 4}, glm::dvec3(1.0), study_.to_patient({4.0, 5.0, 6.0})),
                folder_ / "part.dcm");
    const auto map = document::load_speed_map(folder_ / "part.dcm", study_);
    QCOMPARE(failure(map), QString());
    QCOMPARE((*map)->name, std::string("part.dcm"));
    QCOMPARE((*map)->checksum.size(), std::size_t{64});
    const Volume& volume = *(*map)->volume;
    QVERIFY(volume.geometry == study_);
    for (std::int64_t n = 0; n < study_.voxel_count(); ++n) {
      const Index3 voxel(n % 20, n / 20 % 18, n / 360);
      const bool inside =
          voxel.x >= 4 && voxel.x < 10 && voxel.y >= 5 && voxel.y < 10 && voxel.z >= 6 && voxel.z < 10;
      QCOMPARE(volume.value(n), inside ? 1.0F : 0.0F);
    }
  }

  // 16 bits from 0 to 1: the least is rounded to -7.6e-6.
  void a_probability_that_is_rounded_below_0_stays_one() {
    write_block(grid_of({6, 5, 4}, glm::dvec3(1.0), study_.to_patient({4.0, 5.0, 6.0})),
                folder_ / "rounded.dcm");
    std::vector<std::int16_t> stored(120, -16384);  // 0.25
    stored.front() = -32768;
    make_parametric_map(folder_ / "rounded.dcm", stored, 1.0 / 65535.0, 0.5);
    const auto map = document::load_speed_map(folder_ / "rounded.dcm", study_);
    QCOMPARE(failure(map), QString());
    QVERIFY(std::abs(speed_at(*map, {6, 7, 8}) + 0.5) < 1e-3);
    QVERIFY(std::abs(speed_at(*map, {4, 5, 6}) + 1.0) < 1e-3);
    QCOMPARE(speed_at(*map, {0, 0, 0}), -1.0);  // no frame is there
  }

  void a_speed_shrinks_the_surface_where_no_frame_is() {
    write_block(grid_of({6, 5, 4}, glm::dvec3(1.0), study_.to_patient({4.0, 5.0, 6.0})), folder_ / "gap.dcm",
                1);
    make_parametric_map(folder_ / "gap.dcm", std::vector<std::int16_t>(90, -1), 0.25, 0.0);
    const auto map = document::load_speed_map(folder_ / "gap.dcm", study_);
    QCOMPARE(failure(map), QString());
    QVERIFY(std::abs(speed_at(*map, {6, 7, 8}) + 0.25) < 1e-3);
    QVERIFY(std::abs(speed_at(*map, {6, 7, 7}) + 1.0) < 1e-3);  // between the frames
    QCOMPARE(speed_at(*map, {0, 0, 0}), -1.0);
  }

  void frames_on_coarser_voxels_are_resampled() {
    write_block(grid_of({4, 4, 4}, glm::dvec3(2.0), study_.to_patient({5.5, 5.5, 5.5})),
                folder_ / "coarse.dcm");
    const auto map = document::load_speed_map(folder_ / "coarse.dcm", study_);
    QCOMPARE(failure(map), QString());
    const Volume& volume = *(*map)->volume;
    QCOMPARE(volume.value(Index3(8, 8, 8)), 1.0F);
    QCOMPARE(volume.value(Index3(2, 8, 8)), 0.0F);
    QCOMPARE(volume.value(Index3(15, 8, 8)), 0.0F);
  }

  void what_lies_elsewhere_is_refused() {
    write_block(grid_of({4, 4, 4}, glm::dvec3(1.0), {500.0, 0.0, 0.0}), folder_ / "far.dcm");
    const auto far = document::load_speed_map(folder_ / "far.dcm", study_);
    QVERIFY(!far && far.error().kind == ErrorKind::input);
    QVERIFY2(failure(far).contains("far.dcm"), qPrintable(failure(far)));
    // A volume file has the study's voxels, as for all that is made for them.
    Volume volume;
    volume.geometry = grid_of({6, 5, 4}, glm::dvec3(1.0), study_.to_patient({4.0, 5.0, 6.0}));
    volume.voxels = std::vector<float>(120, 0.5F);
    QCOMPARE(failure(imaging::write_volume_file(volume, folder_ / "part.nrrd")), QString());
    QVERIFY(!document::load_speed_map(folder_ / "part.nrrd", study_));
  }
};

TIDEMARK_TEST(SpeedMapTest)

}  // namespace tidemark::test::speed_map_test

#include "speed_map_test.moc"
