// The level set as OpenVDB sees it.
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetMeasure.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <glm/geometric.hpp>

#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::level_set_file_test {

class LevelSetFileTest : public QObject {
  Q_OBJECT

  static constexpr double kBand = 3.0;

  static openvdb::FloatGrid::Ptr read(const std::filesystem::path& file) {
    openvdb::io::File in(file.string());
    in.open(false);
    return openvdb::gridPtrCast<openvdb::FloatGrid>(in.readGrid("phi"));
  }

 private slots:
  void initTestCase() { openvdb::initialize(); }

  void every_voxel_is_read_back_in_mm_negative_inside() {
    for (const test::Orientation& orientation : test::orientations()) {
      const test::TemporaryFolder folder;
      const Geometry geometry = test::sample_grid({31, 27, 12}, orientation.direction);
      const imaging::Segment ball = test::ball_segment(geometry, 9.0);
      QCOMPARE(test::failure(imaging::write_level_set(*ball.phi, kBand, folder / "phi.vdb")), QString());
      const auto grid = read(folder / "phi.vdb");
      QCOMPARE(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
      QCOMPARE(grid->background(), static_cast<float>(kBand * 0.7));
      QCOMPARE(grid->metaValue<std::string>("units"), std::string("mm"));
      auto accessor = grid->getConstAccessor();
      for (std::int64_t k = 0; k < 12; ++k) {
        for (std::int64_t j = 0; j < 27; ++j) {
          for (std::int64_t i = 0; i < 31; ++i) {
            const openvdb::Coord at(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
            const float phi = ball.phi->value(Index3{i, j, k});
            QCOMPARE(accessor.getValue(at), static_cast<float>(-phi * 0.7));
            QCOMPARE(accessor.isValueOn(at), std::abs(phi) < kBand);
            const openvdb::Vec3d place = grid->indexToWorld(at);
            const glm::dvec3 wanted = geometry.to_patient(glm::dvec3(i, j, k));
            QVERIFY(glm::distance(glm::dvec3(place.x(), place.y(), place.z()), wanted) < 1e-9);
          }
        }
      }
    }
  }

  // OpenVDB measures in index space times the voxel size, so voxels must be cubes here.
  void openvdb_measures_the_volume_of_a_ball() {
    const test::TemporaryFolder folder;
    Geometry geometry = test::sample_grid({48, 48, 48}, test::orientations().back().direction);
    geometry.spacing_mm = glm::dvec3(0.8);
    const imaging::Segment ball = test::ball_segment(geometry, 15.0);
    QCOMPARE(test::failure(imaging::write_level_set(*ball.phi, kBand, folder / "phi.vdb")), QString());
    const auto grid = read(folder / "phi.vdb");
    const double voxel = 0.8 * 0.8 * 0.8;
    grid->setTransform(openvdb::math::Transform::createLinearTransform(1.0));
    for (auto value = grid->beginValueAll(); value; ++value) value.setValue(*value / 0.8F);
    const double volume = openvdb::tools::levelSetVolume(*grid) * voxel;
    QVERIFY2(std::abs(volume / (4.0 / 3.0 * M_PI * std::pow(15.0, 3)) - 1.0) < 0.01,
             qPrintable(QString::number(volume)));
  }

  void memory_follows_the_surface() {
    const test::TemporaryFolder folder;
    Geometry geometry = test::sample_grid({96, 96, 96}, glm::dmat3(1.0));
    geometry.spacing_mm = glm::dvec3(1.0);
    const imaging::Segment ball = test::ball_segment(geometry, 40.0);
    QCOMPARE(test::failure(imaging::write_level_set(*ball.phi, kBand, folder / "phi.vdb")), QString());
    const auto grid = read(folder / "phi.vdb");
    const double shell = 4.0 * M_PI * 40.0 * 40.0 * 2.0 * kBand;
    QVERIFY(static_cast<double>(grid->activeVoxelCount()) < 1.1 * shell);
    QVERIFY(grid->tree().activeTileCount() == 0);
    QCOMPARE(grid->tree().getValue(openvdb::Coord(48)), -3.0F);  // deep inside
    QVERIFY(grid->memUsage() < 96 * 96 * 96 * sizeof(float));
  }

  void a_surface_that_meets_the_border_is_closed_beyond_it() {
    const test::TemporaryFolder folder;
    Geometry geometry = test::sample_grid({12, 12, 12}, glm::dmat3(1.0));
    geometry.spacing_mm = glm::dvec3(1.0);
    const imaging::Segment ball = test::ball_segment(geometry, 100.0);  // everything is inside
    QCOMPARE(test::failure(imaging::write_level_set(*ball.phi, kBand, folder / "phi.vdb")), QString());
    const auto grid = read(folder / "phi.vdb");
    auto accessor = grid->getConstAccessor();
    QCOMPARE(accessor.getValue({0, 5, 5}), -3.0F);
    QCOMPARE(accessor.getValue({-1, 5, 5}), 3.0F);
    QVERIFY(accessor.isValueOn({-1, 5, 5}));
    QCOMPARE(accessor.getValue({12, 5, 5}), 3.0F);
  }

  void voxels_that_are_not_numbers_are_refused() {
    const test::TemporaryFolder folder;
    Volume phi = *test::ball_segment(test::sample_grid({6, 6, 6}, glm::dmat3(1.0)), 2.0).phi;
    std::get<std::vector<float>>(phi.voxels)[7] = NAN;
    const Status refused = imaging::write_level_set(phi, kBand, folder / "phi.vdb");
    QVERIFY(!refused);
    QVERIFY(!std::filesystem::exists(folder / "phi.vdb"));
  }

  // As on a full disk: files may grow to some size and no further.
  void a_full_disk_keeps_the_older_file() {
    const test::TemporaryFolder folder;
    const imaging::Segment ball = test::ball_segment(test::sample_grid({40, 40, 20}, glm::dmat3(1.0)), 9.0);
    const auto file = folder / "phi.vdb";
    QCOMPARE(test::failure(imaging::write_level_set(*ball.phi, kBand, file)), QString());
    const auto whole = std::filesystem::file_size(file);
    const imaging::Segment other = test::ball_segment(test::sample_grid({40, 40, 20}, glm::dmat3(1.0)), 10.0);
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    for (const double part : {0.0, 0.01, 0.5, 0.9, 0.999}) {
      const rlimit limit{static_cast<rlim_t>(part * static_cast<double>(whole)), before.rlim_max};
      setrlimit(RLIMIT_FSIZE, &limit);
      const Status written = imaging::write_level_set(*other.phi, kBand, file);
      setrlimit(RLIMIT_FSIZE, &before);
      QVERIFY(!written);
      QCOMPARE(written.error().kind, ErrorKind::write);
      QVERIFY2(written.error().message.find("phi.vdb") != std::string::npos, written.error().message.c_str());
      QCOMPARE(std::filesystem::file_size(file), whole);
      QCOMPARE(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
    }
  }
};

TIDEMARK_TEST(LevelSetFileTest)

}  // namespace tidemark::test::level_set_file_test

#include "level_set_file_test.moc"
