// Real volume files: geometry, type, range and label counts as other tools find them (truth.json).
#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "imaging/files/volume_file.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::volume_studies_test {

using nlohmann::json;

namespace {

Volume read(const std::string& name) {
  auto volume = imaging::read_volume_file(studies_folder() / name);
  if (!volume) qFatal("%s", volume.error().message.c_str());
  return std::move(*volume);
}

std::map<int, std::int64_t> label_counts(const Volume& volume) {
  std::map<int, std::int64_t> counts;
  for (const float value : volume.values()) ++counts[static_cast<int>(value)];
  return counts;
}

bool near(glm::dvec3 a, glm::dvec3 b, double tolerance) {
  return glm::length(a - b) <= tolerance;
}

// Each axis' nearest anatomical direction, by the side it runs to: "RAS", "LPS", "AIL", ...
std::string axis_letters(const Geometry& geometry) {
  const char* kTo[3] = {"LR", "PA", "SI"};  // positive and negative patient axis
  std::string letters;
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3 d = geometry.direction[axis];
    int main = 0;
    for (int i = 1; i < 3; ++i) {
      if (std::abs(d[i]) > std::abs(d[main])) main = i;
    }
    letters += kTo[main][d[main] > 0.0 ? 0 : 1];
  }
  return letters;
}

// What nibabel calls float64 or int32 becomes float here, 8-bit types int16; scaled ones become float.
std::string expected_scalar(const std::string& dtype, bool scaled) {
  if (scaled || dtype == "int32" || dtype == "float32" || dtype == "float64") return "float";
  return dtype == "uint16" ? "uint16" : "int16";
}

}  // namespace

class VolumeStudiesTest : public QObject {
  Q_OBJECT

 private slots:
  void every_nifti_file_is_as_the_truth_says() {
    std::ifstream stream(studies_folder() / "truth.json");
    const json truth = json::parse(stream);
    int files = 0;
    int labelled = 0;
    for (const auto& [study, content] : truth.items()) {
      if (study[0] != 'v') continue;
      for (const auto& [file, expected] : content["volumes"].items()) {
        const std::string name = study + "/" + file;
        const Volume volume = read(name);
        const Index3 size = volume.geometry.size;
        const auto& shape = expected["shape"];
        QVERIFY2(size == Index3(shape[0], shape[1], shape[2]), name.c_str());
        const auto& zooms = expected["zooms"];
        QVERIFY2(near(volume.geometry.spacing_mm, {zooms[0], zooms[1], zooms[2]}, 1e-3), name.c_str());
        QCOMPARE(axis_letters(volume.geometry), expected["axes"].get<std::string>());
        const auto [low, high] = volume.range();
        QVERIFY2(std::abs(low - expected["min"].get<double>()) < 1e-3, name.c_str());
        QVERIFY2(std::abs(high - expected["max"].get<double>()) < 1e-3, name.c_str());
        const bool scaled = high != std::floor(high) || study == "v01_head_mr_brain_skull";
        QCOMPARE(std::string(volume.scalar_name()), expected_scalar(expected["dtype"], scaled));
        const auto series = imaging::scan_volume_file(studies_folder() / name);
        QVERIFY2(series && series->loadable && series->scalar == volume.scalar_name(), name.c_str());
        ++files;
        if (!expected.contains("label_voxels")) continue;
        ++labelled;
        const auto counts = label_counts(volume);
        if (expected["label_voxels"].is_number()) {  // how many different values
          QCOMPARE(static_cast<int>(counts.size()), expected["label_voxels"].get<int>());
          continue;
        }
        for (const auto& [label, count] : expected["label_voxels"].items()) {
          QCOMPARE(counts.at(static_cast<int>(std::stod(label))), count.get<std::int64_t>());
        }
        QCOMPARE(counts.size(), expected["label_voxels"].size());
      }
    }
    QCOMPARE(files, 21);
    QCOMPARE(labelled, 9);
  }

  void four_axis_orders_of_one_head_agree_in_the_patient() {
    const Volume reference = read("v08_orientations/RAS.nii.gz");
    for (const std::string order : {"LPS", "AIL", "PSR"}) {
      const Volume other = read("v08_orientations/" + order + ".nii.gz");
      QCOMPARE(axis_letters(other.geometry), order);
      std::int64_t differing = 0;
      double farthest = 0.0;
      for (std::int64_t i = 0; i < reference.geometry.voxel_count(); ++i) {
        const Index3 voxel = reference.geometry.voxel_at(i);
        const glm::dvec3 there = other.geometry.to_voxel(reference.geometry.to_patient(glm::dvec3(voxel)));
        const glm::dvec3 nearest = glm::round(there);
        farthest = std::max(farthest, glm::length(there - nearest));
        QVERIFY(other.geometry.contains(Index3(nearest)));
        differing += std::abs(other.value(Index3(nearest)) - reference.value(i)) > 1e-3F;
      }
      qInfo("%s: voxel centres at most %.5f voxels apart", order.c_str(), farthest);
      QVERIFY(farthest < 0.01);
      QCOMPARE(differing, std::int64_t{0});
    }
  }

  void nrrd_files_have_the_geometry_of_their_headers() {
    const Volume image = read("v03_tumour_brain1/brain1_image.nrrd");
    QVERIFY(image.geometry.size == Index3(256, 256, 25));
    QVERIFY(near(image.geometry.spacing_mm, {0.78125, 0.78125, 6.5}, 1e-9));
    QVERIFY(near(image.geometry.origin_mm, {-99.609375, 99.609375, -78.0}, 1e-9));
    QVERIFY(image.geometry.direction == glm::dmat3(1, 0, 0, 0, -1, 0, 0, 0, 1));
    const auto labels = label_counts(read("v03_tumour_brain1/brain1_label.nrrd"));
    QCOMPARE(labels.at(1), std::int64_t{4137});

    const Volume brain = read("v01_head_mr_brain_skull/Brain.nrrd");
    QVERIFY(brain.geometry.size == Index3(160, 232, 160));
    QVERIFY(near(brain.geometry.spacing_mm, {1.0, 0.898437, 0.898437}, 1e-9));
    QVERIFY(near(brain.geometry.origin_mm, {229.26, -126.419, 405.421}, 1e-9));
    QCOMPARE(brain.geometry.voxel_count() - label_counts(brain).at(0), std::int64_t{1822964});
  }

  void metaimage_files_have_the_geometry_of_their_headers() {
    for (const std::string name : {"aorta", "aorta-final-levelset", "aorta-fastmarching-initial-levelset"}) {
      const Volume volume = read("v05_aorta_mra_levelset/" + name + ".mha");
      QVERIFY(volume.geometry.size == Index3(157, 393, 34));
      QVERIFY(near(volume.geometry.spacing_mm, {0.878906, 0.878906, 1.50009}, 1e-9));
      QVERIFY(near(volume.geometry.origin_mm, {-156.445, -24.6094, 0.0}, 1e-9));
      QVERIFY(volume.geometry.direction == glm::dmat3(-1, 0, 0, 0, -1, 0, 0, 0, 1));
    }
    std::int64_t inside = 0;
    for (const float value : read("v05_aorta_mra_levelset/aorta-final-levelset.mha").values())
      inside += value < 0;
    QCOMPARE(inside, std::int64_t{11590});
    const Volume slices = read("v06_itk_examples/BrainProtonDensity3Slices.mha");
    QVERIFY(slices.geometry.size == Index3(181, 217, 3));
    QVERIFY(slices.range().second > 100.0F);
  }

  void gipl_files_are_read() {
    const Volume image = read("v02_itksnap_mricrop/MRIcrop-orig.gipl.gz");
    QVERIFY(image.geometry.size == Index3(78, 110, 64));
    QVERIFY(near(image.geometry.spacing_mm, glm::dvec3(1.0), 1e-6));
    const Volume labels = read("v02_itksnap_mricrop/MRIcrop-seg.gipl.gz");
    QVERIFY(same_grid(labels.geometry, image.geometry, 1e-3));
    const auto counts = label_counts(labels);
    QCOMPARE(counts.at(1), std::int64_t{18138});
    QCOMPARE(counts.at(2), std::int64_t{2633});
    QCOMPARE(counts.at(8), std::int64_t{16841});
  }
};

TIDEMARK_STUDY_TEST(VolumeStudiesTest)

}  // namespace tidemark::test::volume_studies_test

#include "volume_studies_test.moc"
