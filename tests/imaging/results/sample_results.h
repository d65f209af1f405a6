// Series, segments and readers for the tests of this folder.
#pragma once

#include <QJsonObject>
#include <QString>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "imaging/results/results.h"

namespace tidemark::test {

// Eight ways to lie in the patient, each with a name: axial, sagittal, coronal, mirrored, oblique.
struct Orientation {
  const char* name;
  glm::dmat3 direction;
};
const std::vector<Orientation>& orientations();

Geometry sample_grid(Index3 size, const glm::dmat3& direction);

// A series written there as CT, and the grid that it is read back with.
struct SampleSeries {
  std::filesystem::path folder;
  std::vector<std::filesystem::path> files;  // in slice order
  Geometry geometry;
};
SampleSeries write_sample_series(const Geometry& geometry, const std::filesystem::path& folder);
// Of that size, in one of orientations(). The rows of a test of all of them: column "index".
SampleSeries write_oriented_series(int index, Index3 size, const std::filesystem::path& folder);
void add_orientation_rows();

// Three segments of speckles that differ in every direction: the first two overlap, and both leave out
// slices.
imaging::Segments speckled_segments(const Geometry& geometry);
// Those, written there as a segmentation. Fails the test that runs where they cannot be.
void write_speckled_segmentation(const std::filesystem::path& file, const Geometry& geometry,
                                 imaging::SourceFiles source = {});

// Makes a written segmentation a parametric map: its frames hold these words, signed, in their order. Fails
// the test that runs where it cannot be.
void make_parametric_map(const std::filesystem::path& file, const std::vector<std::int16_t>& stored,
                         double slope, double intercept);

// Fails the test that runs where voxels, colours or meanings differ.
void verify_same(const imaging::Segments& read, const imaging::Segments& written);

// Gives the segments of a written segmentation these numbers, in the order of their items, and each frame the
// number of its segment. Fails the test that runs where there are others than the writer's.
void renumber_segments(const std::filesystem::path& file, const std::vector<std::uint16_t>& numbers);

// Names of persons as they stand in files, and in UTF-8. The rows of a test: columns "character_set", "bytes"
// and "name", of byte arrays.
void add_script_rows();

// A ball around the middle of the grid as mask and as phi, radius in mm; with `hollow_mm`, without its core.
imaging::Segment ball_segment(const Geometry& geometry, double radius_mm, double hollow_mm = 0.0);

// The output of dciodvfy about a file.
QString validate(const std::filesystem::path& file);

// What pydicom finds in a file (read_results.py). Ends the test program when it cannot read it.
QJsonObject read_with_pydicom(const std::filesystem::path& file, const std::filesystem::path& source_folder);

}  // namespace tidemark::test
