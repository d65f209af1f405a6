// Volume files that are not what they say: each is refused with one line that names the file and the field.
#include <zlib.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "imaging/files/volume_file.h"
#include "tests/support/support.h"
#include "volumes.h"

using namespace tidemark;
using namespace tidemark::test;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

struct BadFile {
  const char* what;
  const char* name;
  std::string bytes;
  const char* field;  // must be in the message
};

std::string gzip(const std::string& bytes) {
  const TemporaryFolder folder;
  const gzFile file = gzopen((folder / "x").c_str(), "wb");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return contents(folder / "x");
}

std::string nifti(const std::function<void(NiftiHeader&)>& change, const std::string& voxels = "abcdefgh") {
  NiftiHeader header({2, 2, 2}, 2, 8);
  change(header);
  return header.bytes() + voxels;
}

template <class T>
std::string nifti_with(std::size_t offset, T value) {
  return nifti([=](NiftiHeader& header) { header.set<T>(offset, value); });
}

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

std::string float_voxels(float bad) {
  std::string voxels(32, '\0');
  std::memcpy(voxels.data() + 20, &bad, 4);
  return voxels;
}

std::vector<BadFile> bad_nifti_files() {
  const auto none = [](NiftiHeader&) {};
  return {
      {"empty", "v.nii", "", "NIfTI"},
      {"text", "v.nii", "Dear colleague, the scan is on the other disk.\n", "NIfTI"},
      {"long text", "v.nii", std::string(5000, 'x'), "NIfTI"},
      {"header only", "v.nii", nifti(none, ""), "truncated"},
      {"truncated", "v.nii", nifti(none, "abcdefg"), "truncated"},
      {"truncated header", "v.nii", nifti(none).substr(0, 200), "header"},
      {"not gzip though named so", "v.nii.gz", nifti(none, "abc"), "truncated"},
      {"truncated gzip", "v.nii.gz", gzip(nifti(none)).substr(0, 60), "v.nii.gz"},
      {"gzip without its checksum", "v.nii.gz",
       [&] {
         const auto bytes = gzip(nifti(none));
         return bytes.substr(0, bytes.size() - 8);
       }(),
       "truncated"},
      {"gzip with a wrong checksum", "v.nii.gz",
       [&] {
         auto bytes = gzip(nifti(none));
         bytes[bytes.size() - 6] ^= 1;
         return bytes;
       }(),
       "damaged"},
      {"short gzip", "v.nii.gz", gzip(nifti(none, "abcdef")), "360"},
      {"gzip bomb", "v.nii.gz", gzip(nifti(none, std::string(10000000, 'x'))), "more than"},
      {"huge size in a small gzip", "v.nii.gz", gzip(nifti([](NiftiHeader& h) {
         for (std::size_t i = 0; i < 3; ++i) h.set<std::int16_t>(42 + 2 * i, 32767);
       })),
       "truncated"},
      {"dim[0] 0", "v.nii", nifti_with<std::int16_t>(40, 0), "dim[0]"},
      {"dim[0] 8", "v.nii", nifti_with<std::int16_t>(40, 8), "dim[0]"},
      {"dim[0] -1", "v.nii", nifti_with<std::int16_t>(40, -1), "dim[0]"},
      {"two dimensions", "v.nii", nifti_with<std::int16_t>(40, 2), "dimension"},
      {"size 0", "v.nii", nifti_with<std::int16_t>(44, 0), "dim[2]"},
      {"negative size", "v.nii", nifti_with<std::int16_t>(46, -2), "dim[3]"},
      {"overflow of sizes", "v.nii", nifti([](NiftiHeader& h) {
         h.set<std::int16_t>(40, 7);
         for (std::size_t i = 0; i < 7; ++i) h.set<std::int16_t>(42 + 2 * i, 32767);
       }),
       "dim"},
      {"more than one volume", "v.nii", nifti([](NiftiHeader& h) {
         h.set<std::int16_t>(40, 4).set<std::int16_t>(42, 1).set<std::int16_t>(48, 2);
       }),
       "dimension 4"},
      {"unknown type", "v.nii", nifti_with<std::int16_t>(70, 777), "datatype"},
      {"colour", "v.nii", nifti_with<std::int16_t>(70, 128), "datatype"},
      {"complex", "v.nii", nifti_with<std::int16_t>(70, 32), "datatype"},
      {"bitpix", "v.nii", nifti_with<std::int16_t>(72, 16), "bitpix"},
      {"vox_offset NaN", "v.nii", nifti_with<float>(108, kNan), "vox_offset"},
      {"vox_offset infinite", "v.nii", nifti_with<float>(108, 1e30F * 1e30F), "vox_offset"},
      {"vox_offset within the header", "v.nii", nifti_with<float>(108, 10.0F), "vox_offset"},
      {"vox_offset beyond the file", "v.nii", nifti_with<float>(108, 4000.0F), "truncated"},
      {"slope infinite", "v.nii", nifti_with<float>(112, 1e30F * 1e30F), "scl_slope"},
      {"NIfTI-2", "v.nii", nifti_with<std::int32_t>(0, 540), "NIfTI-2"},
      {"two-file magic", "v.nii", nifti_with<char>(345, 'i'), "magic"},
      {"origin NaN", "v.nii", nifti_with<float>(280 + 12, kNan), "origin"},
      {"sheared sform", "v.nii", nifti_with<float>(284, 0.5F), "v.nii"},
      {"sform of zeros", "v.nii", nifti_with<float>(280, 0.0F), "v.nii"},
      {"NaN voxel", "v.nii",
       nifti([](NiftiHeader& h) { h.set<std::int16_t>(70, 16).set<std::int16_t>(72, 32); },
             float_voxels(kNan)),
       "voxel (1, 0, 1) is NaN"},
      {"infinite voxel", "v.nii",
       nifti([](NiftiHeader& h) { h.set<std::int16_t>(70, 16).set<std::int16_t>(72, 32); },
             float_voxels(std::numeric_limits<float>::infinity())),
       "voxel (1, 0, 1) is infinite"},
  };
}

std::string with_voxels(std::string file, const std::string& voxels) {
  return file.substr(0, file.size() - 8) + voxels;
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
      {"spacing NaN", "v.mha", meta("ElementSpacing", "1 nan 1"), "spacing"},
      {"sheared axes", "v.mha", meta("TransformMatrix", "1 0 0 0.2 1 0 0 0 1"), "direction"},
      {"header size", "v.mha", meta("HeaderSize", "-7"), "HeaderSize"},
      {"data outside the folder", "v.mha", meta("ElementDataFile", "../../x.raw"), "data file"},
      {"NaN voxel", "v.nrrd", with_voxels(nrrd("type", "float"), float_voxels(kNan)),
       "voxel (1, 0, 1) is NaN"},
      {"NaN voxel", "v.mha", with_voxels(meta("ElementType", "MET_FLOAT"), float_voxels(kNan)),
       "voxel (1, 0, 1) is NaN"},
      {"damaged compressed data", "v.mha", meta("CompressedData", "True"), "damaged"},
      {"text", "v.gipl", std::string(400, 'x'), "magic"},
      {"short", "v.gipl", "x", "GIPL"},
  };
}

}  // namespace

class BadVolumeFileTest : public QObject {
  Q_OBJECT

 private slots:
  void a_bad_file_is_refused_by_name_data() {
    QTest::addColumn<QString>("name");
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<QString>("field");
    for (const auto& files : {bad_nifti_files(), bad_text_header_files()}) {
      for (const auto& file : files) {
        QTest::addRow("%s: %s", file.name, file.what)
            << QString(file.name) << QByteArray::fromStdString(file.bytes) << QString(file.field);
      }
    }
  }

  void a_bad_file_is_refused_by_name() {
    QFETCH(QString, name);
    QFETCH(QByteArray, bytes);
    QFETCH(QString, field);
    const TemporaryFolder folder;
    const auto path = folder / name.toStdString();
    put(path, bytes.toStdString());
    const auto volume = read_volume_file(path);
    QVERIFY(!volume);
    const QString message = QString::fromStdString(volume.error().message);
    qInfo("%s", qPrintable(message.mid(static_cast<int>(folder.path().string().size()) + 1)));
    QCOMPARE(volume.error().kind, ErrorKind::input);
    QVERIFY(message.startsWith(QString::fromStdString(folder.path().string())));
    QVERIFY2(message.contains(field), qPrintable(message));
    QVERIFY(!message.contains('\n'));
    // A scan gives no error, but never calls loadable what has a bad header.
    const auto series = scan_volume_file(path);
    QVERIFY(series);
    QCOMPARE(series->loadable, series->reason.empty());
  }

  void a_file_that_is_not_there_is_an_error_of_both() {
    const auto volume = read_volume_file("/nonexistent/v.nii");
    QVERIFY(!volume);
    QCOMPARE(volume.error().kind, ErrorKind::input);
    QCOMPARE(QString::fromStdString(volume.error().message), QString("/nonexistent/v.nii: no such file"));
    QVERIFY(!scan_volume_file("/nonexistent/v.nii"));
  }

  void a_folder_is_not_a_volume_file() {
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "v.nii");
    const auto volume = read_volume_file(folder / "v.nii");
    QVERIFY(!volume);
    QCOMPARE(volume.error().kind, ErrorKind::input);
  }

  void a_file_cut_anywhere_is_refused() {
    const TemporaryFolder folder;
    const Volume volume = counting_volume<std::int16_t>(awkward_grid(), -300);
    for (const std::string name : {"v.nii", "v.nii.gz", "v.nrrd", "v.mha"}) {
      QVERIFY(write_volume_file(volume, folder / name));
      const std::string whole = contents(folder / name);
      for (std::size_t length = 0; length < whole.size(); length += 7) {
        put(folder / name, whole.substr(0, length));
        QVERIFY2(!read_volume_file(folder / name), qPrintable(QString("%1 bytes").arg(length)));
      }
    }
  }
};

QTEST_APPLESS_MAIN(BadVolumeFileTest)
#include "bad_volume_file_test.moc"
