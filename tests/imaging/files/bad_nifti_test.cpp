// NIfTI files that are not what they say.
#include <functional>
#include <limits>

#include "bad_volumes.h"
#include "imaging/files/volume_file.h"
#include "tests/support/test_program.h"
#include "volumes.h"

namespace tidemark::test::bad_nifti_test {

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

std::string nifti(const std::function<void(NiftiHeader&)>& change, const std::string& voxels = "abcdefgh") {
  NiftiHeader header({2, 2, 2}, 2, 8);
  change(header);
  return header.bytes() + voxels;
}

template <class T>
std::string nifti_with(std::size_t offset, T value) {
  return nifti([=](NiftiHeader& header) { header.set<T>(offset, value); });
}

std::string extended_nifti(float vox_offset, std::int32_t extension) {
  NiftiHeader header({2, 2, 2}, 2, 8);
  header.set<float>(108, vox_offset).set<char>(348, 1);
  std::string sizes(8, '\0');
  std::memcpy(sizes.data(), &extension, 4);
  return header.bytes() + sizes + std::string(100, 'x');
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
      {"two dimensions", "v.nii", nifti([](NiftiHeader& h) { h.set<std::int16_t>(40, 2); }, "abcd"),
       "dimension"},
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
      {"vox_offset fractional", "v.nii", nifti_with<float>(108, 352.5F), "vox_offset"},
      {"vox_offset negative", "v.nii", nifti_with<float>(108, -352.0F), "vox_offset"},
      // An extension may fill the space up to there, and is read at its word.
      {"vox_offset far beyond a small gzip", "v.nii.gz", gzip(extended_nifti(9e8F, 899999600)), "truncated"},
      {"vox_offset within the header", "v.nii", nifti_with<float>(108, 10.0F), "vox_offset"},
      {"vox_offset beyond the file", "v.nii", nifti_with<float>(108, 4000.0F), "truncated"},
      {"slope infinite", "v.nii", nifti_with<float>(112, 1e30F * 1e30F), "scl_slope"},
      {"intercept infinite", "v.nii", nifti_with<float>(116, -1e30F * 1e30F), "scl_inter"},
      {"header size 347", "v.nii", nifti_with<std::int32_t>(0, 347), "sizeof_hdr"},
      {"header size swapped alone", "v.nii", nifti_with<std::int32_t>(0, 0x5c010000), "dim[0]"},
      {"sizes swapped alone", "v.nii", nifti_with<std::int16_t>(40, 0x0300), "dim[0]"},
      {"spacing 0", "v.nii", nifti_with<float>(80, 0.0F), "pixdim[1]"},
      {"spacing NaN", "v.nii", nifti_with<float>(84, kNan), "pixdim[2]"},
      {"quaternion NaN", "v.nii",
       nifti([](NiftiHeader& h) { h.set<std::int16_t>(252, 1).set<float>(256, kNan); }), "qform"},
      {"a byte too many", "v.nii", nifti(none, "abcdefghi"), "1 more"},
      {"another volume behind it", "v.nii", nifti(none) + nifti(none), "360 more"},
      {"a byte too many in a gzip", "v.nii.gz", gzip(nifti(none, "abcdefghi")), "more than"},
      {"a gzip of nothing", "v.nii.gz", gzip(""), "NIfTI"},
      {"a gzip of a gzip", "v.nii.gz", gzip(gzip(nifti(none))), "NIfTI"},
      {"spacing of 1e20 mm", "v.nii", nifti_with<float>(88, 1e20F), "pixdim[3]"},
      // ITK does not come back from these.
      {"sform of 1e19 mm", "v.nii",
       nifti([](NiftiHeader& h) { h.set<float>(280, 1.7613126e19F).set<float>(284, 6.742214e22F); }),
       "sform"},
      {"sform in a plane", "v.nii",
       nifti([](NiftiHeader& h) { h.set<float>(284, 1.0F).set<float>(300, 0.0F); }), "sform"},
      {"quaternion of 5", "v.nii",
       nifti([](NiftiHeader& h) { h.set<std::int16_t>(252, 1).set<float>(256, 5.0F); }), "qform"},
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

}  // namespace

class BadNiftiTest : public QObject {
  Q_OBJECT

 private slots:
  void a_bad_file_is_refused_by_name_data() { add_rows(bad_nifti_files()); }
  void a_bad_file_is_refused_by_name() { verify_volume_refused(); }

  void a_qform_that_contradicts_the_sform_is_told() {
    const TemporaryFolder folder;
    put(folder / "v.nii", nifti([](NiftiHeader& header) { header.set<std::int16_t>(252, 1); }));
    QVERIFY(imaging::scan_volume_file(folder / "v.nii")->warnings.empty());
    // The same first voxel, and turned by half a turn about the first axis.
    put(folder / "v.nii",
        nifti([](NiftiHeader& header) { header.set<std::int16_t>(252, 1).set<float>(256, 1.0F); }));
    const auto turned = imaging::scan_volume_file(folder / "v.nii");
    QCOMPARE(turned->warnings.size(), std::size_t{1});
    QVERIFY2(turned->warnings[0].find("qform and sform place voxels up to 2.0 mm apart") == 0,
             turned->warnings[0].c_str());
    // In micrometres that is next to nothing.
    put(folder / "v.nii", nifti([](NiftiHeader& header) {
          header.set<std::int16_t>(252, 1).set<float>(256, 1.0F).set<char>(123, 3);
        }));
    const auto tiny = imaging::scan_volume_file(folder / "v.nii");
    QVERIFY2(tiny->loadable, tiny->reason.c_str());
    QVERIFY(tiny->warnings.empty());
  }
};

TIDEMARK_TEST(BadNiftiTest)

}  // namespace tidemark::test::bad_nifti_test

#include "bad_nifti_test.moc"
