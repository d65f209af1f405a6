// The table of docs/dicom.md: what is found in each real study, against two other readers.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "imaging/guard/dicom/transfer_syntaxes.h"
#include "imaging/load_study.h"
#include "tests/imaging/dicom/nifti_peer.h"
#include "tests/imaging/dicom/study_truth.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_table_test {

namespace fs = std::filesystem;
using test::Agreement;
using test::Loaded;
using test::PeerVolume;

namespace {

// The expectation of a study: how many of its series make volumes, and the reasons of the others.
struct Study {
  const char* name;
  const char* what;
  std::size_t volumes;
  std::vector<const char*> refusals;  // each is part of some reason, and each reason has one of them
};

const std::vector<Study> kStudies{
    {"d01_mrhead_ge_3d", "MR head, GE, 100 coronal slices stored from back to front", 1, {}},
    {"d02_ct_body_j2k_siemens", "CT trunk, Siemens, JPEG 2000, and labels (NIfTI)", 2, {}},
    {"d03_mr_tumour_brainix",
     "MR head, Philips, slightly oblique, slices 6 mm apart, and labels (NIfTI)",
     2,
     {}},
    {"d04_ct_tilt_ge",
     "CT head, GE, gantry tilted by 18.5°, slice distance changes",
     0,
     {"uneven slice distances"}},
    {"d05_enhanced_mr_siemens_xa30", "enhanced MR, Siemens, 96 frames in a file", 1, {}},
    {"d06_enhanced_mr_philips", "enhanced MR, Philips, 8 frames in a file", 1, {}},
    {"d07_syntaxes_same_pixels", "one Siemens mosaic in 7 transfer syntaxes", 9, {}},
    {"d08_series_compressed", "one MR series in 4 transfer syntaxes, and as NIfTI", 5, {}},
    {"d09_gap_ct_ge", "CT, GE, a slice is missing", 0, {"1 slice is missing"}},
    {"d10_slicecount", "MR, 2 slices", 1, {}},
    {"d11_mixed_orientation", "MR, Philips, two orientations under one UID", 2, {}},
    {"d12_nonsquare_varying_rescale", "pixels of 4.0 x 6.4 mm, another rescale slope in each slice", 1, {}},
    {"d13_hitachi_oblique_signed12", "MR, Hitachi, oblique by 38.7°, 12 bits with sign", 1, {}},
    {"d14_4d_dti_ge", "MR diffusion, GE, 2 volumes under one UID", 2, {}},
    {"d16_12bit", "Siemens mosaics, 12 bits with and without sign, bits set above them", 3, {}},
    {"d17_rgb_not_a_volume", "colour images", 0, {"RGB"}},
    {"d18_charsets",
     "17 single images, names in as many character sets",
     10,
     {"ImageOrientationPatient (0020,0037) is missing", "PixelData (7FE0,0010) is missing"}},
    {"d19_singles_pydicom",
     "39 single files, many of them damaged on purpose",
     4,
     {"SamplesPerPixel (0028,0002) is 3", "JPEG 2000 stream of 3722445056 x 1024",
      "ImageOrientationPatient (0020,0037) is missing", "holds 8320 bytes",
      "NumberOfFrames (0028,0008) is '1A'", "PALETTE COLOR", "is a DICOM segmentation"}},
    {"d20_monochrome1", "one CR image, small values white", 1, {}},
    {"d21_sarcoma_mr_rtstruct", "MR leg, Philips, with a structure set and a mask (NIfTI)", 2, {}},
    {"v01_head_mr_brain_skull", "MR head and labels (NIfTI, NRRD)", 4, {}},
    {"v02_itksnap_mricrop", "MR head and labels (GIPL)", 2, {}},
    {"v03_tumour_brain1", "MR head and labels (NRRD)", 2, {}},
    {"v04_ct_body_3mm", "CT trunk and labels (NIfTI)", 2, {}},
    {"v05_aorta_mra_levelset", "MR angiography and level sets (MetaImage)", 3, {}},
    {"v06_itk_examples", "MR head (NIfTI, MetaImage)", 3, {}},
    {"v07_hippocampus", "MR hippocampus and labels (NIfTI)", 12, {}},
    {"v08_orientations", "one MR head in four orders of its axes (NIfTI)", 4, {}},
    {"x01_mrhead3_syntaxes", "one MR series in 9 transfer syntaxes", 9, {}},
};

// Every difference from another reader, and who is right.
struct Explanation {
  const char* reader;
  const char* study;
  const char* difference;
  const char* why;
};
constexpr const char* kPydicom = "pydicom";
constexpr const char* kDcm2niix = "dcm2niix";
const std::vector<Explanation> kExplanations{
    {kPydicom, "d05_enhanced_mr_siemens_xa30", "other pixels",
     "The checksum is of the frames in the file's order; here slices lie in the order of their places."},
    {kPydicom, "d06_enhanced_mr_philips", "other mean",
     "The rescale that each frame has in its functional groups was left out there."},
    {kPydicom, "d06_enhanced_mr_philips", "other range of values",
     "The rescale that each frame has in its functional groups was left out there."},
    {kPydicom, "d07_syntaxes_same_pixels", "143360 voxels",
     "A mosaic is one image of 384 x 384 pixels there; here it is the 35 slices that it shows."},
    {kPydicom, "d07_syntaxes_same_pixels", "other size of the slices",
     "A mosaic is one image of 384 x 384 pixels there; here it is the 35 slices that it shows."},
    {kPydicom, "d11_mixed_orientation", "2 volumes", "There all images with one UID are one series."},
    {kPydicom, "d14_4d_dti_ge", "2 volumes", "There all images with one UID are one series."},
    {kPydicom, "d16_12bit", "143360 voxels",
     "A mosaic is one image of 384 x 384 pixels there; here it is the 35 slices that it shows."},
    {kPydicom, "d16_12bit", "other size of the slices",
     "A mosaic is one image of 384 x 384 pixels there; here it is the 35 slices that it shows."},
    {kPydicom, "d16_12bit", "other range of values",
     "Bits above BitsStored count there; PS3.5 8.1.1 says that they are none of the value."},
    {kDcm2niix, "d04_ct_tilt_ge", "2 made of what is refused here",
     "It takes the distance of the first two slices for all, and in a second volume moves the slices level. "
     "Here the tilt is corrected, but uneven distances are interpolated only when the user says so."},
    {kDcm2niix, "d06_enhanced_mr_philips", "1 with other values",
     "It goes by Philips' own ScaleSlope (2005,100E); here the values are those of RescaleSlope."},
    {kDcm2niix, "d08_series_compressed", "1 not converted", "It does not read JPEG-LS."},
    {kDcm2niix, "d09_gap_ct_ge", "2 made of what is refused here",
     "It writes the four slices as if they were evenly spaced, and a second volume interpolated to even "
     "distances. Here a missing slice is interpolated only when the user says so."},
    {kDcm2niix, "d16_12bit", "1 with other values",
     "It takes 12 bits with sign for unsigned ones: 4095 instead of -1 (PixelRepresentation is 1)."},
    {kDcm2niix, "d17_rgb_not_a_volume", "1 made of what is refused here",
     "Colours are no values that a level set could follow."},
    {kDcm2niix, "d18_charsets", "1 made of what is refused here",
     "Two images without a place have one series' UID; which of them is meant is not known."},
    {kDcm2niix, "d18_charsets", "10 on another grid",
     "It states no axes for an image without a place; here they are supposed, and that is said."},
    {kDcm2niix, "d19_singles_pydicom", "8 made of what is refused here",
     "Colours, and files that are damaged or lie beside damaged ones of their series."},
    {kDcm2niix, "d19_singles_pydicom", "2 on another grid",
     "It takes SpacingBetweenSlices (20 mm) for the thickness of a slice (5 mm). The other file is deflated, "
     "which it does not read."},
    {kDcm2niix, "d20_monochrome1", "1 on another grid",
     "It states no axes for an image without a place; here they are supposed, and that is said."},
    {kDcm2niix, "x01_mrhead3_syntaxes", "2 not converted", "It reads neither JPEG-LS nor deflated files."},
};

// All that the table says of one study.
struct Findings {
  const Study* study = nullptr;
  imaging::Catalogue catalogue;
  std::vector<Loaded> loaded;
  std::vector<std::string> truth_differences;
  std::vector<std::string> peer_differences;
  bool has_truth = false;  // there is something to compare with
  bool has_peer = false;   // dcm2niix converted something
};

std::string joined(const std::vector<std::string>& parts, const char* between) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : between) + part;
  return text.empty() ? "–" : text;
}

// Each once, in the order of their first occurrence.
template <class Text>
std::vector<std::string> each_once(const std::vector<Loaded>& loaded, const Text& text) {
  std::vector<std::string> all;
  for (const Loaded& one : loaded) {
    const std::string line = text(one.volume.geometry);
    if (std::find(all.begin(), all.end(), line) == all.end()) all.push_back(line);
  }
  return all;
}

std::vector<std::string> syntaxes_of(const imaging::Catalogue& catalogue) {
  std::set<std::string> names;
  for (const imaging::Series& series : catalogue.series) {
    for (const std::string& uid : series.transfer_syntaxes) {
      const imaging::TransferSyntax* known = imaging::find_transfer_syntax(uid);
      names.insert(known != nullptr ? std::string(known->name) : uid);
    }
  }
  return {names.begin(), names.end()};
}

// dcm2niix is given one folder after the other, so that it does not mix copies of a series.
void compare_with_peer(Findings& findings) {
  std::map<fs::path, std::vector<PeerVolume>> folders;
  for (const imaging::Series& series : findings.catalogue.series) {
    if (series.transfer_syntaxes.empty()) continue;  // a volume file
    for (const fs::path& file : series.files) folders[file.parent_path()];
  }
  std::size_t not_converted = 0;
  std::size_t other_grid = 0;
  std::size_t other_values = 0;
  std::size_t converted = 0;
  std::size_t agreed = 0;
  for (auto& [folder, volumes] : folders) {
    volumes = test::convert_folder(folder);
    converted += volumes.size();
    for (const Loaded& one : findings.loaded) {
      if (one.series->files.front().parent_path() != folder) continue;
      const auto best = [&, &volumes = volumes](Agreement wanted) {  // clang before 16 captures no parts
        return std::any_of(volumes.begin(), volumes.end(),
                           [&](const PeerVolume& peer) { return test::compare(one.volume, peer) == wanted; });
      };
      if (best(Agreement::same))
        ++agreed;
      else if (best(Agreement::other_values))
        ++other_values;
      else if (volumes.empty())
        ++not_converted;
      else
        ++other_grid;
    }
  }
  findings.has_peer = converted > 0;
  const auto tell = [&](std::size_t count, const char* what) {
    if (count > 0) findings.peer_differences.push_back(fmt::format("{} {}", count, what));
  };
  tell(not_converted, "not converted");
  tell(other_grid, "on another grid");
  tell(other_values, "with other values");
  const std::size_t known = agreed + other_grid + other_values;
  if (converted > known) tell(converted - known, "made of what is refused here");
}

Result<Findings> find(const Study& study, const nlohmann::json& truth, bool with_peer) {
  const fs::path folder = test::studies_folder() / study.name;
  auto catalogue = imaging::find_series(folder);
  if (!catalogue) return pass_on(catalogue);
  Findings findings;
  findings.study = &study;
  findings.catalogue = std::move(*catalogue);
  for (const imaging::Series& series : findings.catalogue.series) {
    if (!series.loadable) continue;
    auto volume = imaging::load_series(series);
    if (!volume) return pass_on(volume);
    findings.loaded.push_back({&series, std::move(*volume)});
  }
  const nlohmann::json& known = truth.at(study.name);
  findings.has_truth =
      !findings.loaded.empty() && !(known.at("series").empty() && known.at("volumes").empty());
  findings.truth_differences = test::differences(known, folder, findings.loaded);
  if (with_peer) compare_with_peer(findings);
  return findings;
}

std::string verdict(const Findings& findings) {
  const auto& series = findings.catalogue.series;
  const std::size_t refused = series.size() - findings.loaded.size();
  if (refused == 0) return "read";
  const auto first =
      std::find_if(series.begin(), series.end(), [](const imaging::Series& one) { return !one.loadable; });
  std::string reason = first->reason;
  if (refused > 1) reason += fmt::format(" (and {} more)", refused - 1);
  return fmt::format("{}refused: {}", findings.loaded.empty() ? "" : "the others ", reason);
}

// "same", or the numbers of the notes that explain what differs.
std::string agreement(const char* reader, const std::vector<std::string>& differences, const char* study,
                      bool compared) {
  if (!compared) return "–";
  std::string text;
  for (std::size_t i = 0; i < kExplanations.size(); ++i) {
    const Explanation& one = kExplanations[i];
    const bool is_this =
        study == std::string_view(one.study) && reader == std::string_view(one.reader) &&
        std::find(differences.begin(), differences.end(), one.difference) != differences.end();
    if (is_this) text += fmt::format("{}note {}", text.empty() ? "" : ", ", i + 1);
  }
  return text.empty() ? "same" : text;
}

std::string row_of(const Findings& findings) {
  const auto& loaded = findings.loaded;
  const char* name = findings.study->name;
  const auto sizes = each_once(
      loaded, [](const Geometry& g) { return fmt::format("{}×{}×{}", g.size.x, g.size.y, g.size.z); });
  const auto spacings = each_once(loaded, [](const Geometry& g) {
    return fmt::format("{:.4g}×{:.4g}×{:.4g}", g.spacing_mm.x, g.spacing_mm.y, g.spacing_mm.z);
  });
  const auto axes = each_once(loaded, [](const Geometry& g) { return test::axis_letters(g); });
  return fmt::format(
      "| {} | {} | {} of {} | {} | {} | {} | {} | {} | {} | {} |\n", name, findings.study->what,
      loaded.size(), findings.catalogue.series.size(), joined(syntaxes_of(findings.catalogue), "; "),
      joined(sizes, ", "), joined(spacings, ", "), joined(axes, ", "),
      agreement(kPydicom, findings.truth_differences, name, findings.has_truth),
      agreement(kDcm2niix, findings.peer_differences, name, findings.has_peer), verdict(findings));
}

std::string notes() {
  std::string text = "\nNotes, where another reader finds something else:\n\n";
  for (std::size_t i = 0; i < kExplanations.size(); ++i) {
    const Explanation& one = kExplanations[i];
    text += fmt::format("{}. {}, {}: {}. {}\n", i + 1, one.study, one.reader, one.difference, one.why);
  }
  return text;
}

constexpr const char* kHead =
    "| study | what it is | read | transfer syntax | voxels | spacing, mm | axes | pydicom | dcm2niix | "
    "verdict |\n"
    "|---|---|---|---|---|---|---|---|---|---|\n";
constexpr const char* kOtherPeer = "the table is of another dcm2niix than the one that is installed";
constexpr std::string_view kMark = "<!-- From here on written by dicom_table_test. -->\n";

std::string page() {
  std::ifstream stream(TIDEMARK_DICOM_PAGE);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

class DicomTableTest : public QObject {
  Q_OBJECT

  std::vector<Findings> findings_;
  bool has_peer_ = false;

  // Each difference has its explanation, and each explanation its difference.
  void expect_explained(const char* reader, std::vector<std::string> Findings::*differences) const {
    std::vector<std::string> found;
    std::vector<std::string> explained;
    for (const Findings& one : findings_) {
      for (const std::string& what : one.*differences)
        found.push_back(fmt::format("{}: {}", one.study->name, what));
    }
    for (const Explanation& one : kExplanations) {
      if (std::string_view(one.reader) == reader) {
        explained.push_back(fmt::format("{}: {}", one.study, one.difference));
      }
    }
    std::sort(found.begin(), found.end());
    std::sort(explained.begin(), explained.end());
    std::vector<std::string> wrong;
    std::set_symmetric_difference(found.begin(), found.end(), explained.begin(), explained.end(),
                                  std::back_inserter(wrong));
    QVERIFY2(wrong.empty(), ("without explanation, or explained in vain: " + joined(wrong, "; ")).c_str());
  }

 private slots:
  void initTestCase() {
    std::ifstream stream(test::studies_folder() / "truth.json");
    const auto truth = nlohmann::json::parse(stream, nullptr, false);
    QVERIFY(truth.is_object());
    QCOMPARE(truth.size(), kStudies.size());
    const std::string version = test::peer_version();
    QVERIFY2(!version.empty(), "dcm2niix is not there (docs/5-dependencies.md)");
    has_peer_ = version == test::kPeerVersion;
    if (!has_peer_) {
      qWarning("*** dcm2niix is %s, not %s: it is NOT compared with, nor is the table. ***", version.c_str(),
               test::kPeerVersion);
    }
    for (const Study& study : kStudies) {
      auto found = find(study, truth, has_peer_);
      QCOMPARE(test::failure(found), QString());
      findings_.push_back(std::move(*found));
    }
  }

  void each_study_is_read_or_refused_as_it_should_be_data() {
    QTest::addColumn<int>("number");
    for (int i = 0; i < static_cast<int>(kStudies.size()); ++i) {
      QTest::addRow("%s", kStudies[static_cast<std::size_t>(i)].name) << i;
    }
  }

  void each_study_is_read_or_refused_as_it_should_be() {
    QFETCH(int, number);
    const Findings& findings = findings_.at(static_cast<std::size_t>(number));
    const Study& expected = *findings.study;
    QCOMPARE(findings.loaded.size(), expected.volumes);
    std::set<std::string_view> used;
    for (const imaging::Series& series : findings.catalogue.series) {
      if (series.loadable) continue;
      const auto known =
          std::find_if(expected.refusals.begin(), expected.refusals.end(),
                       [&](const char* part) { return series.reason.find(part) != std::string::npos; });
      QVERIFY2(known != expected.refusals.end(), series.reason.c_str());
      used.insert(*known);
    }
    QCOMPARE(used.size(), expected.refusals.size());
  }

  void every_difference_from_pydicom_is_explained() {
    expect_explained(kPydicom, &Findings::truth_differences);
  }

  void every_difference_from_dcm2niix_is_explained() {
    if (!has_peer_) QSKIP(kOtherPeer);
    expect_explained(kDcm2niix, &Findings::peer_differences);
  }

  void the_page_has_this_table() {
    if (!has_peer_) QSKIP(kOtherPeer);
    std::string table = kHead;
    for (const Findings& one : findings_) table += row_of(one);
    table += notes();
    const std::string committed = page();
    const std::size_t mark = committed.find(kMark);
    QVERIFY2(mark != std::string::npos, "docs/dicom.md has lost the line above the table");
    const std::size_t begin = mark + kMark.size();
    if (const char* target = std::getenv("TIDEMARK_WRITE_TABLE")) {
      std::ofstream(target) << committed.substr(0, begin) << table;
    }
    QVERIFY2(
        committed.substr(begin) == table || std::getenv("TIDEMARK_WRITE_TABLE") != nullptr,
        "the table of docs/dicom.md is not what is found; after a look at the difference write it anew:\n"
        "  TIDEMARK_WRITE_TABLE=docs/dicom.md build/release/tests/dicom_studies_tests dicom_table_test");
  }
};

TIDEMARK_STUDY_TEST(DicomTableTest)

}  // namespace tidemark::test::dicom_table_test

#include "dicom_table_test.moc"
