// Volume files that are as they should be: what is written is read again, and means the same.
#include <sys/resource.h>
#include <zlib.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <csignal>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "imaging/files/volume_file.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"
#include "volumes.h"

namespace tidemark::test::volume_file_test {

namespace {

const std::vector<std::string> kWritten = {"v.nii", "v.nii.gz", "v.nrrd", "v.mha"};

Volume read(const std::filesystem::path& file) {
  auto volume = imaging::read_volume_file(file);
  if (!volume) qFatal("%s", volume.error().message.c_str());
  return std::move(*volume);
}

std::vector<float> expected_counting(std::size_t count, float first) {
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) values[i] = first + static_cast<float>(i);
  return values;
}

}  // namespace

class VolumeFileTest : public QObject {
  Q_OBJECT

 private slots:
  void suffixes_say_what_can_be_read_and_written() {
    for (const char* name :
         {"a.nii", "a.NII.GZ", "a.nrrd", "a.nhdr", "a.mha", "a.mhd", "a.gipl", "a.Gipl.gz"}) {
      QVERIFY(imaging::is_readable_volume_file(name));
    }
    for (const char* name : {"a.gz", "a.dcm", "nii", "a.nii.bz2", ""})
      QVERIFY(!imaging::is_readable_volume_file(name));
    for (const char* name : {"a.nhdr", "a.mhd", "a.gipl", "a.stl"})
      QVERIFY(!imaging::is_writable_volume_file(name));
  }

  void geometry_and_values_survive_every_format() {
    const TemporaryFolder folder;
    const Geometry geometry = awkward_grid();
    for (const auto& name : kWritten) {
      QVERIFY(imaging::is_writable_volume_file(name));
      const std::vector<Volume> volumes = {counting_volume<std::int16_t>(geometry, -50),
                                           counting_volume<std::uint16_t>(geometry, 65000),
                                           counting_volume<float>(geometry, 0.25F)};
      for (const Volume& volume : volumes) {
        QCOMPARE(failure(imaging::write_volume_file(volume, folder / name)), QString());
        const Volume back = read(folder / name);
        QCOMPARE(back.scalar_name(), volume.scalar_name());
        QVERIFY(back.voxels == volume.voxels);
        QVERIFY(same_grid(back.geometry, geometry, 1e-4));
        QVERIFY(glm::determinant(back.geometry.direction) < 0.0);
        QCOMPARE(back.description, name);
        QVERIFY(back.changes.empty());
      }
    }
  }

  // Between the check of its header and the reading of its voxels.
  void a_file_that_is_replaced_while_it_is_read_is_refused() {
    const TemporaryFolder folder;
    const auto small = counting_volume<std::int16_t>(awkward_grid({4, 4, 4}), 3);
    for (const auto& name : kWritten) {
      for (const auto& other : {counting_volume<float>(awkward_grid({64, 64, 64}), 0.5F),
                                counting_volume<float>(awkward_grid({2, 2, 2}), 0.5F)}) {
        QCOMPARE(failure(imaging::write_volume_file(small, folder / name)), QString());
        Progress progress;
        bool replaced = false;
        progress.report = [&](double fraction, std::string_view) {
          if (fraction == 0.0 || std::exchange(replaced, true)) return;
          QCOMPARE(failure(imaging::write_volume_file(other, folder / name)), QString());
        };
        const auto read = imaging::read_volume_file(folder / name, progress);
        QVERIFY(replaced);
        QVERIFY2(!read, name.c_str());
        QVERIFY2(failure(read).contains(QString::fromStdString((folder / name).string())),
                 qPrintable(failure(read)));
      }
      // With a volume of the same kind, whose voxels would pass for those of the first.
      auto alike = small;
      alike.geometry.origin_mm.x += 30.0;
      QCOMPARE(failure(imaging::write_volume_file(small, folder / name)), QString());
      Progress progress;
      progress.report = [&](double fraction, std::string_view) {
        if (fraction > 0.0 && fraction < 1.0)
          QCOMPARE(failure(imaging::write_volume_file(alike, folder / name)), QString());
      };
      const auto read = imaging::read_volume_file(folder / name, progress);
      QVERIFY2(!read, name.c_str());
      // Where headers have one length, there is nothing else to notice it by.
      if (name.find(".nii") != std::string::npos)
        QVERIFY2(failure(read).contains("has changed while it was read"), qPrintable(failure(read)));
    }
  }

  void a_mask_is_written_as_zeros_and_ones() {
    const TemporaryFolder folder;
    Mask mask{awkward_grid(), {}};
    mask.voxels.resize(static_cast<std::size_t>(mask.geometry.voxel_count()));
    mask.voxels[17] = mask.voxels[40] = 1;
    for (const auto& name : kWritten) {
      QCOMPARE(failure(imaging::write_mask_file(mask, folder / name)), QString());
      const Volume back = read(folder / name);
      QCOMPARE(std::string(back.scalar_name()), std::string("int16"));
      QVERIFY(back.values() == std::vector<float>(mask.voxels.begin(), mask.voxels.end()));
      QVERIFY(same_grid(back.geometry, mask.geometry, 1e-4));
    }
  }

  void rescaled_values_are_written_in_the_smallest_type_that_holds_them() {
    const TemporaryFolder folder;
    const auto round_trip = [&](Volume volume, double slope, double intercept, const char* type) {
      volume.slope = slope;
      volume.intercept = intercept;
      QCOMPARE(failure(imaging::write_volume_file(volume, folder / "v.nrrd")), QString());
      const Volume back = read(folder / "v.nrrd");
      QCOMPARE(std::string(back.scalar_name()), std::string(type));
      QVERIFY(back.values() == volume.values());
    };
    const auto unsigned_counts = counting_volume<std::uint16_t>(awkward_grid(), 0);
    round_trip(unsigned_counts, 1, -1024, "int16");
    round_trip(unsigned_counts, 300, 2000, "uint16");
    round_trip(unsigned_counts, 3000, 0, "float");
    round_trip(unsigned_counts, 0.5, 0, "float");
    round_trip(counting_volume<float>(awkward_grid(), 0.5F), 2, 1, "float");
  }

  void volumes_of_one_voxel_along_an_axis_work() {
    const TemporaryFolder folder;
    for (const Index3 size : {Index3(1, 1, 1), Index3(1, 7, 61), Index3(175, 1, 2), Index3(9, 7, 1)}) {
      for (const auto& name : kWritten) {
        const Volume volume = counting_volume<std::int16_t>(awkward_grid(size), 3);
        QCOMPARE(failure(imaging::write_volume_file(volume, folder / name)), QString());
        const Volume back = read(folder / name);
        QVERIFY(back.voxels == volume.voxels);
        QVERIFY(same_grid(back.geometry, volume.geometry, 1e-4));
      }
    }
  }

  void a_scan_says_what_a_read_will_give() {
    const TemporaryFolder folder;
    QVERIFY(imaging::write_volume_file(counting_volume<std::uint16_t>(awkward_grid(), 1), folder / "v.mha"));
    const auto series = imaging::scan_volume_file(folder / "v.mha");
    QCOMPARE(failure(series), QString());
    QVERIFY(series->loadable);
    QCOMPARE(series->uid, std::string("v.mha"));
    QCOMPARE(series->scalar, std::string("uint16"));
    QVERIFY(same_grid(series->geometry, awkward_grid(), 1e-4));
    QVERIFY(series->files == std::vector<std::filesystem::path>{folder / "v.mha"});
  }

  void a_compressed_file_beside_its_uncompressed_namesake_is_read_as_itself() {
    const TemporaryFolder folder;
    const Volume plain = counting_volume<std::int16_t>(awkward_grid(), 0);
    const Volume packed = counting_volume<std::int16_t>(awkward_grid(), 500);
    QVERIFY(imaging::write_volume_file(plain, folder / "v.nii"));
    QVERIFY(imaging::write_volume_file(packed, folder / "v.nii.gz"));
    QVERIFY(read(folder / "v.nii").voxels == plain.voxels);
    QVERIFY(read(folder / "v.nii.gz").voxels == packed.voxels);
  }

  void the_case_of_a_suffix_does_not_matter() {
    const TemporaryFolder folder;
    const Volume volume = counting_volume<std::int16_t>(awkward_grid(), 0);
    for (const auto& [name, other] : std::vector<std::pair<std::string, std::string>>{
             {"a.nii", "A.Nii"}, {"b.nii.gz", "B.nii.GZ"}, {"c.nrrd", "C.NRRD"}, {"d.mha", "D.MHA"}}) {
      QVERIFY(imaging::write_volume_file(volume, folder / name));
      std::filesystem::rename(folder / name, folder / other);
      QVERIFY(read(folder / other).voxels == volume.voxels);
      QCOMPARE(failure(imaging::write_volume_file(volume, folder / other)), QString());
      QVERIFY(read(folder / other).voxels == volume.voxels);
    }
  }

  // ITK reads it under another name, which lies there.
  void a_suffix_in_another_case_needs_a_temporary_folder() {
    const TemporaryFolder folder;
    const Volume volume = counting_volume<std::int16_t>(awkward_grid(), 0);
    QCOMPARE(failure(imaging::write_volume_file(volume, folder / "A.Nii")), QString());
    const Variable nowhere("TMPDIR", QByteArray::fromStdString((folder / "absent").string()));
    const auto read = imaging::read_volume_file(folder / "A.Nii");
    QVERIFY(!read);
    QCOMPARE(read.error().kind, ErrorKind::write);
    QVERIFY2(failure(read).contains("A.Nii: its suffix needs a temporary folder"), qPrintable(failure(read)));
  }

  void nifti_is_turned_from_ras_to_lps() {
    const TemporaryFolder folder;
    NiftiHeader header({4, 4, 4}, 4, 16);
    header.set<float>(280 + 12, 10.0F).set<float>(296 + 12, 20.0F).set<float>(312 + 12, 30.0F);
    put(folder / "v.nii", header.bytes() + std::string(128, '\1'));
    const Volume volume = read(folder / "v.nii");
    QVERIFY(volume.geometry.origin_mm == glm::dvec3(-10, -20, 30));
    QVERIFY(glm::distance(volume.geometry.to_patient({1, 2, 3}), glm::dvec3(-11, -22, 33)) < 1e-5);
    // 0 has no sign, neither in a listing nor in JSON.
    header.set<float>(280 + 12, 0.0F);
    put(folder / "v.nii", header.bytes() + std::string(128, '\1'));
    QVERIFY(!std::signbit(read(folder / "v.nii").geometry.origin_mm.x));
  }

  // The unit is in xyzt_units, beside that of time, and counts for the spacing and for either origin.
  void nifti_in_another_unit_is_read_in_mm_data() {
    QTest::addColumn<int>("units");
    QTest::addColumn<double>("mm");
    QTest::newRow("metres") << 1 << 1000.0;
    QTest::newRow("metres, and seconds") << (1 | 8) << 1000.0;
    QTest::newRow("micrometres") << 3 << 0.001;
    QTest::newRow("millimetres") << 2 << 1.0;
    QTest::newRow("unknown") << 0 << 1.0;
  }
  void nifti_in_another_unit_is_read_in_mm() {
    QFETCH(int, units);
    QFETCH(double, mm);
    const TemporaryFolder folder;
    const glm::dvec3 origin(10.0, 20.0, 30.0);
    for (const bool by_qform : {true, false}) {
      if (!by_qform && mm == 1000.0) continue;  // ITK refuses axes as short as some thousandths
      NiftiHeader header({4, 4, 4}, 4, 16);
      header.set<char>(123, static_cast<char>(units));
      header.set<std::int16_t>(252, by_qform ? 1 : 0).set<std::int16_t>(254, by_qform ? 0 : 1);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto spacing = static_cast<float>(2.0 / mm);
        const auto offset = static_cast<float>(origin[static_cast<int>(axis)] / mm);
        header.set<float>(80 + 4 * axis, spacing).set<float>(280 + 20 * axis, spacing);
        header.set<float>(by_qform ? 268 + 4 * axis : 292 + 16 * axis, offset);
      }
      put(folder / "v.nii", header.bytes() + std::string(128, '\1'));
      const Geometry read_grid = read(folder / "v.nii").geometry;
      QVERIFY(glm::distance(read_grid.spacing_mm, glm::dvec3(2.0)) < 1e-5);
      QVERIFY(glm::distance(read_grid.to_patient({0, 0, 0}), glm::dvec3(-10, -20, 30)) < 1e-4);
      QVERIFY(glm::distance(read_grid.to_patient({1, 2, 3}), glm::dvec3(-12, -24, 36)) < 1e-4);
    }
  }

  void nrrd_in_another_unit_is_read_in_mm() {
    const TemporaryFolder folder;
    const auto header = [](double mm, const std::string& units) {
      const double x = 1.0 / mm;
      return fmt::format(
          "NRRD0005\ntype: uchar\ndimension: 3\nspace: left-posterior-superior\nsizes: 2 2 2\n"
          "space directions: ({},0,0) (0,{},0) (0,0,{})\nencoding: raw\nspace units: {}\n"
          "space origin: ({},{},{})\n\nabcdefgh",
          2 * x, 2 * x, 3 * x, units, -10 * x, 20 * x, 30 * x);
    };
    const auto all = [](const char* word) { return fmt::format("\"{0}\" \"{0}\" \"{0}\"", word); };
    for (const auto& [word, mm] : {std::pair("mm", 1.0), std::pair("um", 0.001), std::pair("\u00b5m", 0.001),
                                   std::pair("microns", 0.001), std::pair("cm", 10.0), std::pair("m", 1000.0),
                                   std::pair("", 1.0), std::pair("furlong", 1.0)}) {
      put(folder / "v.nrrd", header(mm, all(word)));
      const Volume volume = read(folder / "v.nrrd");
      QVERIFY2(glm::distance(volume.geometry.spacing_mm, glm::dvec3(2, 2, 3)) < 1e-9, word);
      QVERIFY2(glm::distance(volume.geometry.origin_mm, glm::dvec3(-10, 20, 30)) < 1e-9, word);
      const auto series = imaging::scan_volume_file(folder / "v.nrrd");
      QCOMPARE(failure(series), QString());
      const bool is_known = std::string(word) != "furlong";
      QCOMPARE(series->warnings.empty(), is_known);
      if (!is_known)
        QCOMPARE(series->warnings[0],
                 std::string("space units 'furlong' are not known; lengths are read as mm"));
    }
    // Without a space each axis of the file has its unit, one of time among them.
    const std::string by_axis = "NRRD0004\ntype: uchar\ndimension: {}\nsizes: 2 2 2{}\nencoding: raw\n";
    put(folder / "v.nrrd", fmt::format(fmt::runtime(by_axis), 3, "") +
                               "spacings: 200 200 300\nunits: \"um\" \"um\" \"um\"\n\nabcdefgh");
    QVERIFY(glm::distance(read(folder / "v.nrrd").geometry.spacing_mm, glm::dvec3(0.2, 0.2, 0.3)) < 1e-9);
    put(folder / "v.nrrd", fmt::format(fmt::runtime(by_axis), 4, " 1") +
                               "spacings: 2 2 3 5\nunits: \"cm\" \"cm\" \"cm\" \"s\"\n\nabcdefgh");
    QVERIFY(glm::distance(read(folder / "v.nrrd").geometry.spacing_mm, glm::dvec3(20, 20, 30)) < 1e-9);
    put(folder / "v.nrrd", fmt::format(fmt::runtime(by_axis), 3, "") +
                               "spacings: 2 2 3\nunits: \"ell\" \"ell\" \"ell\"\n\nabcdefgh");
    const auto by_unknown = imaging::scan_volume_file(folder / "v.nrrd");
    QCOMPARE(failure(by_unknown), QString());
    QCOMPARE(std::ranges::count(by_unknown->warnings, "units 'ell' are not known; lengths are read as mm"),
             1);
    put(folder / "v.nrrd", header(1.0, "\"mm\" \"mm\" \"um\""));
    const auto refused = imaging::read_volume_file(folder / "v.nrrd");
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::input);
    QVERIFY2(failure(refused).contains("v.nrrd: space units: "), qPrintable(failure(refused)));
  }

  void an_nrrd_lies_as_its_space_says_or_is_refused_data() {
    QTest::addColumn<QString>("space");
    QTest::addColumn<bool>("refused");
    QTest::addColumn<bool>("oriented");
    QTest::addColumn<double>("sign");  // of x and y
    const auto row = [](const char* space, bool refused, bool oriented, double sign) {
      QTest::newRow(space) << QString(space) << refused << oriented << sign;
    };
    for (const char* space : {"left-posterior-superior", "LPS", "LPST"}) row(space, false, true, 1.0);
    for (const char* space : {"right-anterior-superior", "Right Anterior Superior", "RAS"})
      row(space, false, true, -1.0);
    for (const char* space : {"left-anterior-superior", "leftanteriorsuperior", "LAS"})
      row(space, true, true, 1.0);
    for (const char* space : {"right-anterior-superior-time", "RAST", "LAST"}) row(space, true, true, 1.0);
    for (const char* space : {"scanner-xyz", "3D-right-handed"}) row(space, false, false, 1.0);
  }
  void an_nrrd_lies_as_its_space_says_or_is_refused() {
    QFETCH(QString, space);
    QFETCH(bool, refused);
    QFETCH(bool, oriented);
    QFETCH(double, sign);
    const bool has_time = space.endsWith("time") || space.endsWith("ST");
    const TemporaryFolder folder;
    put(folder / "v.nrrd",
        fmt::format("NRRD0005\ntype: uchar\ndimension: {}\nspace: {}\nsizes: 2 2 2{}\n"
                    "space directions: {}\nencoding: raw\nspace origin: {}\n\nabcdefgh",
                    has_time ? 4 : 3, space.toStdString(), has_time ? " 1" : "",
                    has_time ? "(2,0,0,0) (0,2,0,0) (0,0,3,0) (0,0,0,1)" : "(2,0,0) (0,2,0) (0,0,3)",
                    has_time ? "(-10,20,30,0)" : "(-10,20,30)"));
    const auto series = imaging::scan_volume_file(folder / "v.nrrd");
    QCOMPARE(failure(series), QString());
    QCOMPARE(series->loadable, !refused);
    if (refused) {
      QVERIFY2(series->reason.find("v.nrrd: space: '" + space.toStdString() + "'") != std::string::npos,
               series->reason.c_str());
      return;
    }
    QCOMPARE(series->geometry.oriented, oriented);
    QCOMPARE(series->warnings.empty(), oriented);
    const Geometry grid = read(folder / "v.nrrd").geometry;
    QVERIFY(glm::distance(grid.to_patient({0, 0, 0}), glm::dvec3(-10 * sign, 20 * sign, 30)) < 1e-9);
    QVERIFY(glm::distance(grid.to_patient({1, 1, 1}), glm::dvec3(-8 * sign, 22 * sign, 33)) < 1e-9);
  }

  void nifti_slope_and_intercept_are_applied_once() {
    const TemporaryFolder folder;
    const std::string voxels("\1\2\3\4\5\6\7\10", 8);
    NiftiHeader header({2, 2, 2}, 2, 8);
    header.set<float>(112, 2.5F).set<float>(116, -10.0F);
    put(folder / "v.nii", header.bytes() + voxels);
    const Volume volume = read(folder / "v.nii");
    QCOMPARE(std::string(volume.scalar_name()), std::string("float"));
    QVERIFY(volume.values() == (std::vector<float>{-7.5F, -5, -2.5F, 0, 2.5F, 5, 7.5F, 10}));
    // 0 and NaN mean that there is no scaling.
    for (const float none : {0.0F, std::numeric_limits<float>::quiet_NaN()}) {
      put(folder / "v.nii", header.set<float>(112, none).bytes() + voxels);
      QVERIFY(read(folder / "v.nii").values() == expected_counting(8, 1.0F));
    }
  }

  void nifti_of_the_other_byte_order_is_read() {
    const TemporaryFolder folder;
    std::string voxels;
    for (char i = 0; i < 8; ++i) voxels += std::string(1, '\0') + i;
    put(folder / "v.nii", NiftiHeader({2, 2, 2}, 4, 16).swapped() + voxels);
    QVERIFY(read(folder / "v.nii").values() == expected_counting(8, 0.0F));
  }

  void a_fourth_dimension_of_one_is_ignored() {
    const TemporaryFolder folder;
    NiftiHeader header({2, 2, 2}, 2, 8);
    header.set<std::int16_t>(40, 4);
    put(folder / "v.nii", header.bytes() + "abcdefgh");
    QCOMPARE(read(folder / "v.nii").geometry.voxel_count(), std::int64_t{8});
  }

  void types_that_become_float_are_said() {
    const TemporaryFolder folder;
    std::string voxels;
    for (std::int32_t i = 0; i < 8; ++i) {
      const std::int32_t value = 100000 * i;
      voxels.append(reinterpret_cast<const char*>(&value), 4);
    }
    put(folder / "v.nii", NiftiHeader({2, 2, 2}, 8, 32).bytes() + voxels);
    const Volume volume = read(folder / "v.nii");
    QCOMPARE(std::string(volume.scalar_name()), std::string("float"));
    QCOMPARE(volume.value(Index3(1, 1, 1)), 700000.0F);
    QCOMPARE(volume.changes.size(), std::size_t{1});
    QVERIFY(volume.changes[0].find("float") != std::string::npos);
  }

  void a_file_without_orientation_says_so() {
    const TemporaryFolder folder;
    put(folder / "v.mha",
        "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nabcdefgh");
    const auto series = imaging::scan_volume_file(folder / "v.mha");
    QVERIFY(series && series->loadable);
    QCOMPARE(series->warnings.size(), std::size_t{1});
    QVERIFY(read(folder / "v.mha").values() == expected_counting(8, 'a'));
  }

  // Sides of a patient that came out of nowhere would be believed.
  void a_volume_whose_sides_nobody_knows_is_written_without_sides() {
    const TemporaryFolder folder;
    Volume volume = counting_volume<std::int16_t>(awkward_grid({5, 4, 3}), 3);
    volume.geometry.oriented = false;
    const auto is_written = [&](const std::string& name, bool has_sides) {
      QCOMPARE(failure(imaging::write_volume_file(volume, folder / name)), QString());
      const auto series = imaging::scan_volume_file(folder / name);
      QVERIFY2(series && series->loadable, series ? series->reason.c_str() : "");
      QCOMPARE(series->geometry.oriented, has_sides);
      QCOMPARE(series->warnings.empty(), has_sides);
      QCOMPARE(imaging::can_leave_sides_open(name, volume.geometry), !has_sides);
      const Volume back = read(folder / name);
      QVERIFY(back.voxels == volume.voxels);
      QVERIFY(same_grid(back.geometry, volume.geometry, 1e-4));
    };
    is_written("v.nrrd", false);
    // A place in space is worth more: what fits on the study must go on to do so.
    for (const char* name : {"v.nii", "v.nii.gz", "v.mha"}) is_written(name, true);
    volume.geometry.direction = glm::dmat3(1.0);
    volume.geometry.origin_mm = glm::dvec3(0.0);
    for (const char* name : {"v.nrrd", "v.nii", "v.nii.gz", "V.NII.GZ"}) is_written(name, false);
    is_written("v.mha", true);
    const Mask mask{volume.geometry,
                    std::vector<std::uint8_t>(static_cast<std::size_t>(volume.geometry.voxel_count()), 1)};
    QCOMPARE(failure(imaging::write_mask_file(mask, folder / "mask.nii.gz")), QString());
    QVERIFY(!read(folder / "mask.nii.gz").geometry.oriented);
    // A program that sends back a file with the same place is given one.
    QCOMPARE(failure(imaging::write_volume_file(volume, folder / "v.nii", imaging::UnknownSides::stated)),
             QString());
    QVERIFY(read(folder / "v.nii").geometry.oriented);
  }

  void detached_headers_are_read() {
    const TemporaryFolder folder;
    put(folder / "voxels.raw", "abcdefgh");
    put(folder / "v.mhd",
        "ObjectType = Image\nNDims = 3\nBinaryData = True\nDimSize = 2 2 2\n"
        "ElementType = MET_UCHAR\nElementDataFile = voxels.raw\n");
    put(folder / "v.nhdr",
        "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n"
        "space: left-posterior-superior\nspace directions: (1,0,0) (0,1,0) (0,0,2)\n"
        "space origin: (0,0,0)\ndata file: voxels.raw\n");
    for (const char* name : {"v.mhd", "v.nhdr"})
      QVERIFY(read(folder / name).values() == expected_counting(8, 'a'));
  }

  void text_encodings_are_read() {
    const TemporaryFolder folder;
    put(folder / "v.nrrd",
        "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n\n1 2 3 4 5 6 7 8\n");
    QVERIFY(read(folder / "v.nrrd").values() == expected_counting(8, 1.0F));
    put(folder / "v.mha",
        "ObjectType = Image\nNDims = 3\nBinaryData = False\nDimSize = 2 2 2\n"
        "ElementType = MET_SHORT\nElementDataFile = LOCAL\n1 2 3 4 5 6 7 8\n");
    QVERIFY(read(folder / "v.mha").values() == expected_counting(8, 1.0F));
  }

  void numbers_come_in_either_byte_order() {
    const TemporaryFolder folder;
    const std::string nrrd = "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nendian: ";
    const std::string meta =
        "ObjectType = Image\nNDims = 3\nBinaryData = True\n%DimSize = 2 2 2\nElementType = MET_SHORT\n"
        "ElementDataFile = LOCAL\n";
    const auto with = [&](const char* line) { return std::string(meta).replace(meta.find('%'), 1, line); };
    std::string big;
    std::string little;
    for (char i = 0; i < 8; ++i) {
      big += std::string(1, '\0') + i;
      little += i + std::string(1, '\0');
    }
    const std::pair<const char*, std::string> files[] = {
        {"big.nrrd", nrrd + "big\n\n" + big},
        {"little.nrrd", nrrd + "little\n\n" + little},
        {"big.mha", with("BinaryDataByteOrderMSB = True\n") + big},
        {"little.mha", with("BinaryDataByteOrderMSB = False\n") + little},
        {"big-elements.mha", with("ElementByteOrderMSB = True\n") + big},
        {"little-elements.mha",
         with("BinaryDataByteOrderMSB = True\nElementByteOrderMSB = False\n") + little},
        {"none.mha", with("") + little}};
    for (const auto& [name, bytes] : files) {
      put(folder / name, bytes);
      QVERIFY2(read(folder / name).values() == expected_counting(8, 0.0F), name);
    }
  }

  void gipl_is_read_plain_and_compressed() {
    const TemporaryFolder folder;
    std::string bytes(256, '\0');
    bytes[1] = bytes[3] = bytes[5] = 2;
    bytes[7] = 1;
    bytes[9] = 15;  // short
    for (std::size_t axis = 0; axis < 3; ++axis) std::memcpy(bytes.data() + 10 + 4 * axis, "\x3f\x80\0\0", 4);
    std::memcpy(bytes.data() + 252, "\xef\xff\xe9\xb0", 4);
    for (char i = 0; i < 8; ++i) bytes += std::string(1, '\0') + i;
    put(folder / "v.gipl", bytes);
    const gzFile packed = gzopen((folder / "v.gipl.gz").c_str(), "wb");
    gzwrite(packed, bytes.data(), static_cast<unsigned>(bytes.size()));
    gzclose(packed);
    for (const char* name : {"v.gipl", "v.gipl.gz"}) {
      const Volume volume = read(folder / name);
      QVERIFY(volume.values() == expected_counting(8, 0.0F));
      QVERIFY(volume.geometry.spacing_mm == glm::dvec3(1.0));
    }
  }

  void a_german_locale_changes_nothing() {
    const TemporaryFolder folder;
    const Volume volume = counting_volume<std::int16_t>(awkward_grid(), 0);
    for (const char* locale : {"C", "de_DE.UTF-8"}) {
      // Where the locale is not installed this is the C locale once more.
      std::setlocale(LC_NUMERIC, locale);
      for (const auto& name : kWritten) {
        const auto status = imaging::write_volume_file(volume, folder / name);
        const auto back = imaging::read_volume_file(folder / name);
        if (!status || !back || !same_grid(back->geometry, volume.geometry, 1e-4)) {
          std::setlocale(LC_NUMERIC, "C");
          QFAIL(name.c_str());
        }
      }
      std::setlocale(LC_NUMERIC, "C");
      const std::string nrrd = contents(folder / "v.nrrd");
      QVERIFY(nrrd.find("space origin: (-123.4567") != std::string::npos);
      const std::string meta = contents(folder / "v.mha");
      QVERIFY(meta.find("ElementSpacing = 0.731") != std::string::npos);
    }
  }

  void a_disk_that_is_full_is_a_write_error_and_leaves_the_target_alone() {
    const TemporaryFolder folder;
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    QCOMPARE(getrlimit(RLIMIT_FSIZE, &before), 0);
    // Noise does not compress: every format needs about 50,000 bytes. Limits within and at the end of the
    // data, and one that stops in the header.
    Volume noise = counting_volume<std::int16_t>(awkward_grid({29, 29, 29}), 0);
    unsigned state = 1;
    for (auto& voxel : std::get<std::vector<std::int16_t>>(noise.voxels)) {
      state = state * 1664525U + 1013904223U;
      voxel = static_cast<std::int16_t>(state >> 16);
    }
    for (const auto& name : kWritten) {
      QVERIFY(imaging::write_volume_file(noise, folder / name));
      const std::string kept = contents(folder / name);
      for (const rlim_t limit : {rlim_t{100}, rlim_t{20000}, rlim_t{kept.size() - 1}}) {
        rlimit small = before;
        small.rlim_cur = limit;
        setrlimit(RLIMIT_FSIZE, &small);
        const auto status = imaging::write_volume_file(noise, folder / name);
        setrlimit(RLIMIT_FSIZE, &before);
        QVERIFY2(!status, name.c_str());
        QCOMPARE(status.error().kind, ErrorKind::write);
        QVERIFY(status.error().message.find(folder / name) == 0);
        QVERIFY(contents(folder / name) == kept);
      }
    }
    QCOMPARE(std::distance(std::filesystem::directory_iterator(folder.path()), {}), std::ptrdiff_t{4});
  }

  void a_path_that_cannot_be_written_is_a_write_error() {
    const Volume volume = counting_volume<std::int16_t>(awkward_grid(), 0);
    const auto status = imaging::write_volume_file(volume, "/nonexistent/v.nrrd");
    QVERIFY(!status);
    QCOMPARE(status.error().kind, ErrorKind::write);
    const auto kind = imaging::write_volume_file(volume, "/tmp/v.mhd");
    QVERIFY(!kind);
    QCOMPARE(kind.error().kind, ErrorKind::usage);
  }

  void an_interrupted_read_says_so() {
    const TemporaryFolder folder;
    QVERIFY(imaging::write_volume_file(counting_volume<std::int16_t>(awkward_grid(), 0), folder / "v.nii"));
    std::stop_source source;
    double last = -1.0;
    Progress progress{[&](double fraction, std::string_view) { last = fraction; }, source.get_token()};
    QVERIFY(imaging::read_volume_file(folder / "v.nii", progress));
    QCOMPARE(last, 1.0);
    source.request_stop();
    const auto stopped = imaging::read_volume_file(folder / "v.nii", progress);
    QVERIFY(!stopped);
    QCOMPARE(stopped.error().kind, ErrorKind::cancelled);
  }
};

TIDEMARK_TEST(VolumeFileTest)

}  // namespace tidemark::test::volume_file_test

#include "volume_file_test.moc"
