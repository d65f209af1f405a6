// NRRD, MetaImage and GIPL files that are not what they say; NIfTI: bad_nifti_test.
#include <QElapsedTimer>
#include <algorithm>
#include <array>
#include <limits>

#include "bad_volumes.h"
#include "imaging/files/volume_file.h"
#include "tests/support/test_program.h"
#include "volumes.h"

namespace tidemark::test::bad_volume_file_test {

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::string nrrd(const std::string& field, const std::string& value) {
  const std::vector<std::pair<std::string, std::string>> fields = {
      {"type", "uchar"},
      {"dimension", "3"},
      {"sizes", "2 2 2"},
      {"space", "left-posterior-superior"},
      {"space directions", "(1,0,0) (0,1,0) (0,0,1)"},
      {"space origin", "(0,0,0)"},
      {"endian", "little"},
      {"encoding", "raw"}};
  std::string text = "NRRD0004\n";
  bool used = false;
  for (const auto& [name, standard] : fields) {
    used = used || name == field;
    text += name + ": " + (name == field ? value : standard) + "\n";
  }
  if (!used) text += field + ": " + value + "\n";
  return text + "\nabcdefgh";
}

std::string meta(const std::string& field, const std::string& value) {
  const std::vector<std::pair<std::string, std::string>> fields = {{"ObjectType", "Image"},
                                                                   {"NDims", "3"},
                                                                   {"BinaryData", "True"},
                                                                   {"CompressedData", "False"},
                                                                   {"TransformMatrix", "1 0 0 0 1 0 0 0 1"},
                                                                   {"Offset", "0 0 0"},
                                                                   {"ElementSpacing", "1 1 1"},
                                                                   {"DimSize", "2 2 2"},
                                                                   {"ElementNumberOfChannels", "1"},
                                                                   {"HeaderSize", "0"},
                                                                   {"ElementType", "MET_UCHAR"},
                                                                   {"ElementDataFile", "LOCAL"}};
  std::string text;
  for (const auto& [name, standard] : fields)
    text += name + " = " + (name == field ? value : standard) + "\n";
  return text + "abcdefgh";
}

std::string with_voxels(std::string file, const std::string& voxels) {
  return file.substr(0, file.size() - 8) + voxels;
}

std::string compressed_meta(const std::string& size, const std::string& data) {
  const std::string header = "CompressedDataSize = " + size + "\n" + meta("CompressedData", "True");
  return header.substr(0, header.size() - 8) + data;
}

// Big endian, like everything in it.
std::string gipl(const std::array<std::uint16_t, 4>& size, std::uint16_t type, float spacing = 1.0F) {
  std::string header(256, '\0');
  const auto put_big = [&](std::size_t at, auto value) {
    std::memcpy(header.data() + at, &value, sizeof(value));
    std::reverse(header.begin() + static_cast<std::ptrdiff_t>(at),
                 header.begin() + static_cast<std::ptrdiff_t>(at + sizeof(value)));
  };
  for (std::size_t axis = 0; axis < 4; ++axis) {
    put_big(2 * axis, size[axis]);
    put_big(10 + 4 * axis, spacing);
  }
  put_big(8, type);
  put_big(252, 0xEFFFE9B0U);
  return header + "abcdefgh";
}

std::vector<BadFile> bad_text_header_files() {
  return {
      {"text", "v.nrrd", "hello\n", "NRRD"},
      {"no end of header", "v.nrrd", "NRRD0004\ntype: uchar\n", "header"},
      {"endless header", "v.nrrd", "NRRD0004\n" + std::string(3000000, '#') + "\n\n", "header"},
      {"no sizes", "v.nrrd", nrrd("sizes", ""), "sizes"},
      {"negative size", "v.nrrd", nrrd("sizes", "2 -2 2"), "sizes"},
      {"overflow of sizes", "v.nrrd", nrrd("sizes", "3000000000 3000000000 3000000000"), "sizes"},
      {"too large for the file", "v.nrrd", nrrd("sizes", "4000 4000 4000"), "truncated"},
      {"dimension and sizes differ", "v.nrrd", nrrd("dimension", "2"), "v.nrrd"},
      {"dimension 17", "v.nrrd", nrrd("dimension", "17"), "v.nrrd"},
      {"block type", "v.nrrd", nrrd("type", "block"), "type"},
      {"unknown encoding", "v.nrrd", nrrd("encoding", "zip"), "encoding"},
      {"byte skip -1", "v.nrrd", nrrd("byte skip", "-1"), "byte skip"},
      {"data outside the folder", "v.nrrd", nrrd("data file", "../secret.raw"), "data file"},
      {"data by absolute path", "v.nrrd", nrrd("data file", "/etc/passwd"), "data file"},
      {"data in a list", "v.nrrd", nrrd("data file", "LIST"), "data file"},
      {"data that are not there", "v.nrrd", nrrd("data file", "gone.raw"), "gone.raw"},
      {"singular directions", "v.nrrd", nrrd("space directions", "(1,0,0) (1,0,0) (0,0,1)"), "v.nrrd"},
      {"sheared directions", "v.nrrd", nrrd("space directions", "(1,0,0) (0.3,1,0) (0,0,1)"), "direction"},
      {"spacing 0", "v.nrrd", nrrd("space directions", "(0,0,0) (0,1,0) (0,0,1)"), "v.nrrd"},
      {"origin NaN", "v.nrrd", nrrd("space origin", "(nan,0,0)"), "v.nrrd"},
      {"damaged gzip", "v.nrrd", nrrd("encoding", "gzip"), "damaged"},
      {"text", "v.mha", "hello\n", "MetaImage"},
      {"empty", "v.mha", "", "MetaImage"},
      {"a name of 300 bytes", "v.mha", std::string(300, 'x') + " = 1\n" + meta("NDims", "3"),
       "has a name of 301 bytes"},
      {"NDims 0", "v.mha", meta("NDims", "0"), "NDims"},
      {"NDims 2", "v.mha", meta("NDims", "2"), "DimSize"},
      {"NDims 17", "v.mha", meta("NDims", "17"), "NDims"},
      {"size 0", "v.mha", meta("DimSize", "2 0 2"), "DimSize"},
      {"sizes in words", "v.mha", meta("DimSize", "two two two"), "DimSize"},
      {"overflow of sizes", "v.mha", meta("DimSize", "9999999999 9999999999 9999999999"), "DimSize"},
      {"truncated", "v.mha", meta("DimSize", "2 2 3"), "truncated"},
      {"two channels", "v.mha", meta("ElementNumberOfChannels", "2"), "ElementNumberOfChannels"},
      {"unknown type", "v.mha", meta("ElementType", "MET_STRING"), "ElementType"},
      {"spacing 0", "v.mha", meta("ElementSpacing", "1 0 1"), "spacing"},
      {"negative spacing", "v.mha", meta("ElementSpacing", "1 -1 1"), "spacing"},
      {"spacing NaN", "v.mha", meta("ElementSpacing", "1 nan 1"), "Spacing"},
      {"sheared axes", "v.mha", meta("TransformMatrix", "1 0 0 0.2 1 0 0 0 1"), "direction"},
      {"header size", "v.mha", meta("HeaderSize", "-7"), "HeaderSize"},
      {"data outside the folder", "v.mha", meta("ElementDataFile", "../../x.raw"), "data file"},
      {"NaN voxel", "v.nrrd", with_voxels(nrrd("type", "float"), float_voxels(kNan)),
       "voxel (1, 0, 1) is NaN"},
      {"NaN voxel", "v.mha", with_voxels(meta("ElementType", "MET_FLOAT"), float_voxels(kNan)),
       "voxel (1, 0, 1) is NaN"},
      {"damaged compressed data", "v.mha", meta("CompressedData", "True"), "damaged"},
      {"dimension 0", "v.nrrd", nrrd("dimension", "0"), "dimension"},
      {"dimension in words", "v.nrrd", nrrd("dimension", "three"), "dimension"},
      {"17 sizes", "v.nrrd", nrrd("sizes", "1 1 1 1 1 1 1 1 1 1 1 1 1 1 2 2 2"), "sizes"},
      {"size 0", "v.nrrd", nrrd("sizes", "2 0 2"), "sizes"},
      {"a field twice", "v.nrrd", nrrd("type ", "double"), "'type' twice"},
      {"line skip", "v.nrrd", nrrd("line skip", "1"), "line skip"},
      {"data by a pattern", "v.nrrd", nrrd("data file", "slice%03d.raw 1 3 1"), "data file"},
      {"data in a folder above a folder", "v.nrrd", nrrd("data file", "a/../../x.raw"), "data file"},
      {"data in the header itself", "v.nrrd", nrrd("data file", "v.nrrd"), "more"},
      {"data in a folder's place", "v.nrrd", nrrd("data file", "."), "data file"},
      {"infinite spacing", "v.nrrd", nrrd("space directions", "(inf,0,0) (0,1,0) (0,0,1)"),
       "space directions"},
      {"truncated", "v.nrrd", nrrd("sizes", "2 2 3"), "truncated"},
      {"trailing bytes", "v.nrrd", nrrd("sizes", "2 2 1"), "4 more"},
      {"gzip bomb", "v.nrrd", with_voxels(nrrd("encoding", "gzip"), gzip(std::string(50000000, 'x'))),
       "more than"},
      {"short gzip", "v.nrrd", with_voxels(nrrd("encoding", "gzip"), gzip("abcd")), "hold 4"},
      {"too few numbers", "v.nrrd", with_voxels(nrrd("encoding", "text"), "1 2 3 4 5 6 7\n"),
       "the text has 7"},
      {"too many numbers", "v.nrrd", with_voxels(nrrd("encoding", "text"), "1 2 3 4 5 6 7 8 9\n"),
       "the text has 9"},
      {"words for numbers", "v.nrrd", with_voxels(nrrd("encoding", "text"), "1 2 three 4 5 6 7 8"),
       "voxel 2"},
      {"a number beyond its type", "v.nrrd", with_voxels(nrrd("encoding", "text"), "1 2 300 4 5 6 7 8"),
       "voxel 2 is 300, which is no uint8"},
      {"an unknown byte order", "v.nrrd",
       [] {
         std::string file = nrrd("endian", "middle");
         file.replace(file.find("uchar"), 5, "short").replace(file.find("2 2 2"), 5, "2 2 1");
         return file;
       }(),
       "endian: 'middle'"},
      {"two signs", "v.nrrd", with_voxels(nrrd("encoding", "text"), "1 2 +-0 4 5 6 7 8"), "voxel 2"},
      {"two signs in the header", "v.mha", meta("Offset", "0 +-1 0"), "Offset"},
      {"a number cut", "v.nrrd", with_voxels(nrrd("encoding", "text"), "1 2 0x 4 5 6 7 8"), "voxel 2"},
      {"NDims in words", "v.mha", meta("NDims", "three"), "NDims"},
      {"negative size", "v.mha", meta("DimSize", "2 -2 2"), "DimSize"},
      {"a field twice", "v.mha", "DimSize = 9 9 9\n" + meta("NDims", "3"), "'DimSize' twice"},
      {"endless header", "v.mha", "Comment = " + std::string(3000000, 'x') + meta("NDims", "3"),
       "ElementDataFile"},
      {"a long line", "v.mha", "Comment = " + std::string(600, 'x') + "\n" + meta("NDims", "3"),
       "a line of 610 bytes"},
      {"a long comment", "v.mha", "Comment = " + std::string(254, 'x') + "\n" + meta("NDims", "3"),
       "'Comment' of 255 bytes"},
      {"a long date", "v.mha", "AcquisitionDate =" + std::string(400, '1') + "\n" + meta("NDims", "3"),
       "'AcquisitionDate' of 400 bytes"},
      {"singular axes", "v.mha", meta("TransformMatrix", "1 0 0 1 0 0 0 0 1"), "direction"},
      {"axes of zeros", "v.mha", meta("TransformMatrix", "0 0 0 0 0 0 0 0 0"), "direction"},
      {"origin NaN", "v.mha", meta("Offset", "0 nan 0"), "Offset"},
      {"spacing of two numbers", "v.mha", meta("ElementSpacing", "1 1e999 1"), "Spacing"},
      {"header size beyond the file", "v.mha", meta("HeaderSize", "1000000000000000000"), "truncated"},
      {"header size in words", "v.mha", meta("HeaderSize", "some"), "HeaderSize"},
      {"trailing bytes", "v.mha", meta("DimSize", "2 2 1"), "4 more"},
      {"data by absolute path", "v.mha", meta("ElementDataFile", "/etc/passwd"), "data file"},
      {"data in a list", "v.mha", meta("ElementDataFile", "LIST"), "data file"},
      {"data by a pattern", "v.mha", meta("ElementDataFile", "x%02d.raw 1 2 1"), "data file"},
      {"data that are not there", "v.mha", meta("ElementDataFile", "gone.raw"), "gone.raw"},
      {"2 GB of compressed data", "v.mha", compressed_meta("2000000000", gzip("abcdefgh")),
       "CompressedDataSize"},
      {"compressed data of negative size", "v.mha", compressed_meta("-1", gzip("abcdefgh")),
       "CompressedDataSize"},
      // What follows says 2 GB to MetaIO alone, but for the check of its header's lines.
      {"size after a colon", "v.mha",
       "CompressedDataSize: 2000000000 = 1\n" + compressed_meta("8", "abcdefgh"), "':' instead of '='"},
      {"size after a carriage return", "v.mha",
       "Comment = x\rCompressedDataSize = 2000000000\n" + meta("CompressedData", "True"),
       "control character"},
      {"size before a zero byte", "v.mha",
       std::string("CompressedDataSize\0x = 2000000000\n", 34) + meta("CompressedData", "True"),
       "control character"},
      {"header that ends in small letters", "v.mha",
       "elementdatafile = LOCAL\nCompressedDataSize = 2000000000\n" + meta("CompressedData", "True"),
       "CompressedDataSize"},
      {"an empty value", "v.mha", "Comment =\n" + meta("NDims", "3"), "no value of 'Comment'"},
      {"compression behind two separators", "v.mha",
       "CompressedDataSize = 2000000000\n" + meta("CompressedData", "= True"),
       "no value of 'CompressedData'"},
      {"bomb", "v.mha", compressed_meta("60", gzip(std::string(50000000, 'x'))), "more than"},
      {"too few numbers", "v.mha", with_voxels(meta("BinaryData", "False"), "1 2 3 4 5 6 77 "),
       "the text has 7"},
      {"numbers with commas", "v.mha", with_voxels(meta("BinaryData", "False"), "1,2,3,4,5,6,7,8"),
       "voxel 0"},
  };
}

std::vector<BadFile> bad_gipl_files() {
  return {
      {"text", "v.gipl", std::string(400, 'x'), "magic"},
      {"short", "v.gipl", "x", "GIPL"},
      {"empty", "v.gipl", "", "GIPL"},
      {"size 0", "v.gipl", gipl({2, 0, 2, 1}, 8), "dim[1]"},
      {"more than one volume", "v.gipl", gipl({2, 2, 2, 2}, 8), "dim[3]"},
      {"unknown type", "v.gipl", gipl({2, 2, 2, 1}, 99), "image type 99"},
      {"complex", "v.gipl", gipl({2, 2, 2, 1}, 160), "image type 160"},
      {"sizes too large for the file", "v.gipl", gipl({65535, 65535, 65535, 1}, 8), "truncated"},
      {"truncated", "v.gipl", gipl({2, 2, 3, 1}, 8), "truncated"},
      {"trailing bytes", "v.gipl", gipl({2, 2, 1, 1}, 8), "4 more"},
      {"spacing 0", "v.gipl", gipl({2, 2, 2, 1}, 8, 0.0F), "spacing"},
      {"spacing NaN", "v.gipl", gipl({2, 2, 2, 1}, 8, kNan), "spacing"},
      {"gzip bomb", "v.gipl.gz", gzip(gipl({2, 2, 2, 1}, 8) + std::string(50000000, 'x')), "more than"},
      {"short gzip", "v.gipl.gz", gzip(gipl({2, 2, 3, 1}, 8)), "hold 264"},
  };
}

}  // namespace

class BadVolumeFileTest : public QObject {
  Q_OBJECT

 private slots:
  void a_bad_file_is_refused_by_name_data() { add_rows(bad_text_header_files()); }
  void a_bad_file_is_refused_by_name() { verify_volume_refused(); }
  void a_bad_gipl_file_is_refused_by_name_data() { add_rows(bad_gipl_files()); }
  void a_bad_gipl_file_is_refused_by_name() { verify_volume_refused(); }

  void a_file_that_is_not_there_is_an_error_of_both() {
    const auto volume = imaging::read_volume_file("/nonexistent/v.nii");
    QVERIFY(!volume);
    QCOMPARE(volume.error().kind, ErrorKind::input);
    QCOMPARE(QString::fromStdString(volume.error().message), QString("/nonexistent/v.nii: no such file"));
    QVERIFY(!imaging::scan_volume_file("/nonexistent/v.nii"));
  }

  void a_folder_is_not_a_volume_file() {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "v.nii");
    const auto volume = imaging::read_volume_file(folder / "v.nii");
    QVERIFY(!volume);
    QCOMPARE(volume.error().kind, ErrorKind::input);
  }

  void a_header_line_of_100_megabytes_is_not_read() {
    const TemporaryFolder folder;
    put(folder / "v.nrrd", "NRRD0004\ncontent: ");
    std::filesystem::resize_file(folder / "v.nrrd", 100000000);
    QElapsedTimer timer;
    timer.start();
    const auto volume = imaging::read_volume_file(folder / "v.nrrd");
    QVERIFY(timer.elapsed() < 1000);
    QVERIFY(!volume);
    QVERIFY2(volume.error().message.find("no end") != std::string::npos, volume.error().message.c_str());
  }

  void a_file_cut_anywhere_is_refused() {
    const TemporaryFolder folder;
    const Volume volume = counting_volume<std::int16_t>(awkward_grid(), -300);
    for (const std::string name : {"v.nii", "v.nii.gz", "v.nrrd", "v.mha"}) {
      QVERIFY(imaging::write_volume_file(volume, folder / name));
      const std::string whole = contents(folder / name);
      for (std::size_t length = 0; length < whole.size(); length += 7) {
        put(folder / name, whole.substr(0, length));
        QVERIFY2(!imaging::read_volume_file(folder / name), qPrintable(QString("%1 bytes").arg(length)));
      }
    }
  }
};

TIDEMARK_TEST(BadVolumeFileTest)

}  // namespace tidemark::test::bad_volume_file_test

#include "bad_volume_file_test.moc"
