// Real studies, segmented by a few seeds: Dice against the reference segmentations that come with them.
#include "core/volume.h"
#include "imaging/filters/filters.h"
#include "imaging/load_study.h"
#include "solver/executor.h"
#include "tests/support/support.h"

#include <cmath>
#include <glm/common.hpp>

#include "tests/support/test_program.h"

namespace tidemark::test::segmentation_test {

namespace {

struct Seed {
  double i, j, k;  // voxels
  double radius_mm;
};

struct Study {
  const char* name;
  const char* image;
  const char* labels;
  int label;        // 0: any label
  double sigma_mm;  // smoothing of the source; 0: none
  double target, range, alpha;
  std::int64_t steps;  // at most
  std::vector<Seed> seeds;
  double dice;  // at least
};

// The reference of `label` on the image's grid, found through patient coordinates: the files differ in the
// order and direction of their axes.
Mask reference_on(const Geometry& grid, const Volume& labels, int label) {
  Mask mask{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxel_count()))};
  for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
    const Index3 voxel = grid.voxel_at(i);
    const Index3 there(glm::round(labels.geometry.to_voxel(grid.to_patient(voxel))));
    if (!labels.geometry.contains(there)) continue;
    const double value = std::round(labels.value(there));
    mask.voxels[static_cast<std::size_t>(i)] = label == 0 ? value > 0.0 : value == label;
  }
  return mask;
}

}  // namespace

class SegmentationTest : public QObject {
  Q_OBJECT

 private slots:
  void a_few_seeds_reach_the_reference_data() {
    QTest::addColumn<int>("index");
    for (std::size_t i = 0; i < studies().size(); ++i) {
      QTest::newRow(studies()[i].name) << static_cast<int>(i);
    }
  }

  void a_few_seeds_reach_the_reference() {
    QFETCH(int, index);
    const Study& study = studies()[static_cast<std::size_t>(index)];
    auto image = imaging::load_volume(studies_folder() / study.image);
    QCOMPARE(failure(image), QString());
    const auto labels = imaging::load_volume(studies_folder() / study.labels);
    QCOMPARE(failure(labels), QString());
    const Mask reference = reference_on(image->geometry, *labels, study.label);
    QVERIFY(reference.count() > 1000);
    if (study.sigma_mm > 0.0) {
      auto smoothed = imaging::smooth(*image, study.sigma_mm);
      QCOMPARE(failure(smoothed), QString());
      image = std::move(smoothed);
    }

    solver::Parameters parameters;
    parameters.target = study.target;
    parameters.range = study.range;
    parameters.alpha = study.alpha;
    const auto source = std::make_shared<const Volume>(std::move(*image));
    auto level_set = solver::make_executor(solver::ExecutorKind::host, source, parameters);
    QCOMPARE(failure(level_set), QString());
    for (const Seed& seed : study.seeds) {
      const solver::Sphere sphere =
          solver::sphere_at_voxel(source->geometry, {seed.i, seed.j, seed.k}, seed.radius_mm);
      QCOMPARE(failure((*level_set)->paint(sphere, solver::Brush::add)), QString());
    }
    solver::Advance run;
    run.steps = study.steps;
    run.until_converged = true;
    const auto report = (*level_set)->advance(run);
    QCOMPARE(failure(report), QString());
    QCOMPARE(failure((*level_set)->validate()), QString());
    const double overlap = dice((*level_set)->snapshot().value().mask(), reference);
    qInfo("%s: Dice %.4f after %lld steps in %.2f s (%s)", study.name, overlap,
          static_cast<long long>(report->steps), report->seconds,
          report->converged ? "converged" : "still moving");
    QVERIFY(overlap >= study.dice);
  }

 private:
  static const std::vector<Study>& studies() {
    static const std::vector<Study> kStudies = {
        {"CT liver",
         "d02_ct_body_j2k_siemens/example_ct_dicom",
         "d02_ct_body_j2k_siemens/example_seg_dicom.nii.gz",
         5,
         0.98,
         95,
         40,
         0.7,
         2500,
         {{212, 208, 9, 16}, {150, 220, 9, 12}},
         0.94},
        {"FLAIR tumour",
         "d03_mr_tumour_brainix/FLAIR",
         "d03_mr_tumour_brainix/ROI.nii.gz",
         0,
         1.2,
         440,
         140,
         0.97,
         1000,
         {{188, 149, 13, 8}},
         0.86},
        {"MR ventricles",
         "v02_itksnap_mricrop/MRIcrop-orig.gipl.gz",
         "v02_itksnap_mricrop/MRIcrop-seg.gipl.gz",
         1,
         0.7,
         28,
         12,
         0.8,
         1500,
         {{35, 37, 48, 3}, {43, 37, 48, 3}},
         0.90},
        {"MR brain",
         "v01_head_mr_brain_skull/MR.nii.gz",
         "v01_head_mr_brain_skull/Brain.nrrd",
         0,
         1.0,
         230,
         110,
         0.45,
         1500,
         {{75, 99, 77, 30}, {50, 100, 90, 25}, {110, 100, 90, 25}, {80, 150, 70, 25}, {80, 60, 80, 25}},
         0.85},
        {"CT liver at 3 mm",
         "v04_ct_body_3mm/example_ct.nii.gz",
         "v04_ct_body_3mm/example_seg_fast_force_split.nii.gz",
         5,
         2.0,
         50,
         25,
         0.6,
         800,
         {{100, 51, 92, 24}},
         0.75},
    };
    return kStudies;
  }
};

TIDEMARK_STUDY_TEST(SegmentationTest)

}  // namespace tidemark::test::segmentation_test

#include "segmentation_test.moc"
