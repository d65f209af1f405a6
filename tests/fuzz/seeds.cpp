// Writes the seed corpus: a few small good files of every kind, and some that are damaged where it matters.
//   fuzz_seeds FOLDER
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <zlib.h>

#include <array>
#include <cstdio>
#include <fstream>
#include <span>

#include "document/lesson.h"
#include "document/session_file.h"
#include "document/zip_archive.h"
#include "imaging/files/volume_file.h"
#include "imaging/guard/dicom/preflight.h"
#include "imaging/results/results.h"
#include "renderer/transfer_function.h"
#include "tests/document/cases.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/imaging/dicom/directory_bytes.h"
#include "tests/imaging/dicom/frame_bytes.h"
#include "tests/imaging/dicom/ht_streams.h"
#include "tests/imaging/dicom/recode.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/files/pictures.h"
#include "tests/imaging/files/volumes.h"

using namespace tidemark;
namespace fs = std::filesystem;

namespace {

fs::path corpus;

void write(const std::string& target, const std::string& name, const std::string& bytes) {
  fs::create_directories(corpus / target);
  test::put(corpus / target / name, bytes);
}

void write_dicom(const std::string& name, const std::string& bytes) {
  write("dicom_preflight", name, bytes);
  write("dicom_load", name, bytes);
}

std::string gzip(const std::string& bytes) {
  const test::TemporaryFolder folder;
  const gzFile file = gzopen((folder / "x").c_str(), "wb9");
  gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size()));
  gzclose(file);
  return test::contents(folder / "x");
}

void write_plain_dicom() {
  using namespace tidemark::test;
  write_dicom("explicit", file(Dataset::slice(kExplicit)));
  write_dicom("implicit", file(Dataset::slice(kImplicit)));
  write_dicom("big-endian", file(Dataset::slice(kBigEndian)));
  write_dicom("no-meta", Dataset::slice().bytes());
  write_dicom("deflated", file("1.2.840.10008.1.2.1.99", deflated(Dataset::slice().bytes())));
  write_dicom("short-pixels", file(Dataset::slice().put(kPixels, element(kPixels, "OW", "abcd"))));
  constexpr std::uint32_t kSequence = 0x00081140;
  for (const bool has_lengths : {false, true}) {
    const std::string name = has_lengths ? "-lengths" : "";
    write_dicom("nested" + name,
                file(Dataset::slice().put(kSequence, nested(5, "SQ", kExplicit, has_lengths))));
    write_dicom("nested-un" + name,
                file(Dataset::slice().put(kSequence, nested(5, "UN", kExplicit, has_lengths))));
    write_dicom("nested-implicit" + name,
                file(Dataset::slice(kImplicit).put(kSequence, nested(70, "SQ", kImplicit, has_lengths))));
  }
}

void write_dicom_of_several_slices() {
  using namespace tidemark::test;
  write_dicom("enhanced", file(enhanced(3)));
  write_dicom("mosaic", file(mosaic(csa_of_mosaic())));
  const std::string frame = std::string(64, '\0');
  const std::string pixels = element(kPixels, "OB", item("") + item(frame) + item(frame) + sequence_end(),
                                     kExplicit, kUndefinedLength);
  write_dicom("enhanced-fragments", file("1.2.840.10008.1.2.5", enhanced(2).put(kPixels, pixels).bytes()));
}

// The first fragment of a file's pixels.
std::string frame_of(const std::string& bytes) {
  imaging::MemoryBytes source({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  imaging::TagWalk walk(source, std::int64_t{1} << 20);
  std::string frame;
  const auto ignore = [](const imaging::ElementHeader&, imaging::ByteReader&, const imaging::Fragments*) {};
  const auto dataset = walk.walk_meta(132, ignore);
  if (!dataset) qFatal("%s", dataset.error().what.c_str());
  const auto walked = walk.walk_dataset(
      *dataset, {}, true,
      [&](const imaging::ElementHeader&, imaging::ByteReader&, const imaging::Fragments* fragments) {
        if (fragments == nullptr) return;
        frame = bytes.substr(static_cast<std::size_t>(fragments->first), fragments->first_bytes);
      });
  if (!walked) qFatal("%s", walked.error().what.c_str());
  return frame;
}

void write_compressed_dicom() {
  // In the order of dicom_frame's table.
  constexpr E_TransferSyntax kSyntaxes[] = {EXS_RLELossless,   EXS_JPEGProcess1,        EXS_JPEGProcess2_4,
                                            EXS_JPEGProcess14, EXS_JPEGProcess14SV1,    EXS_JPEGLSLossless,
                                            EXS_JPEGLSLossy,   EXS_JPEG2000LosslessOnly};
  test::register_encoders();
  const Index3 size{17, 13, 1};
  for (std::size_t k = 0; k < std::size(kSyntaxes); ++k) {
    const E_TransferSyntax syntax = kSyntaxes[k];
    const int bits = syntax == EXS_JPEGProcess1 ? 8 : 12;
    Volume volume = test::sample_volume_uint16(size);
    for (auto& value : std::get<std::vector<std::uint16_t>>(volume.voxels)) {
      value = static_cast<std::uint16_t>(value % (1 << bits));
    }
    const test::TemporaryFolder folder;
    const fs::path file = test::write_series(volume, folder / "series").front();
    test::edit(file, [&](DcmDataset& dataset) {
      dataset.putAndInsertUint16(DCM_BitsStored, static_cast<Uint16>(bits));
      dataset.putAndInsertUint16(DCM_HighBit, static_cast<Uint16>(bits - 1));
    });
    if (!test::recode(file, syntax, false)) qFatal("cannot encode %s", DcmXfer(syntax).getXferName());
    const std::string bytes = test::contents(file);
    const std::string name = DcmXfer(syntax).getXferID();
    write_dicom(name, bytes);
    const std::string start{static_cast<char>(k), static_cast<char>(size.x), static_cast<char>(size.y)};
    write("dicom_frame", name, start + frame_of(bytes));
  }
  // As JPEG 2000, the last of them.
  const auto stream = QByteArray::fromHex({test::kHt12Bits.data(), qsizetype{test::kHt12Bits.size()}});
  const std::string start{static_cast<char>(std::size(kSyntaxes) - 1), test::kHtColumns, test::kHtRows};
  write("dicom_frame", "high-throughput", start + stream.toStdString());
  // DCMTK's search for the frame stayed at the marker TEM for ever.
  const std::string rest("\xff\x01\xff\xc0\0\x0b\x08\0\x0d\0\x11\x01\x01\x11\0\0\0", 17);
  write("dicom_frame", "found-jpeg-tem", "\x01\x11\x0d\xff\xd8" + rest);
}

void write_multiparts() {
  const std::string part = "--x\r\nContent-Type: application/dicom\r\n\r\n";
  write("multipart", "two", part + "first\r\n" + part + "second\r\n--x--\r\n");
  write("multipart", "preamble", "before\r\n" + part + "\r\n--x and \r\n-- in it\r\n--x--after");
  write("multipart", "cut-off", part + "first\r\n--x \t\r\n\r\nsec");
}

void write_csa_headers() {
  const std::vector<std::pair<std::string, std::vector<std::string>>> values{
      {"EchoLinePosition", {"32", "", "33"}},
      {"NumberOfImagesInMosaic", {"4", ""}},
      {"SliceNormalVector", {"0.0", "-1.5e-12", "1.00000000 "}},
      {"SpacingBetweenSlices", {"2.5"}}};
  write("csa_header", "second-form", test::csa_bytes(values));
  write("csa_header", "first-form", test::csa_in_first_form(test::csa_bytes(values), 3));
  write("csa_header", "cut-off", test::csa_bytes(values).substr(0, 330));
}

void write_media_directories() {
  using namespace tidemark::test;
  write("media_directory", "one-image", directory_bytes("1.2.3", {"IMAGES\\IM1"}));
  write("media_directory", "again-and-missing",
        directory_bytes("1.2.3", {"IMAGES\\IM1", "images\\im1.;1", " IMAGES\\IM2 ", "DICOMDIR"}));
  write("media_directory", "leads-out", directory_bytes("1.2.3", {"..\\IMAGES\\IM1", "/etc/hostname", "."}));
  write("media_directory", "no-records", file(Dataset().put_text(0x00041130, "CS", "DISC")));
  const std::string lower = element(0x00041420, "SQ", item(directory_record("IMAGE", "")));
  write("media_directory", "records-in-records",
        file(Dataset().put(0x00041220, element(0x00041220, "SQ", directory_record("PATIENT", lower)))));
}

void write_archives() {
  const std::string text(3000, 'x');
  const auto bytes = std::as_bytes(std::span(text));
  const std::array<document::ZipEntry, 5> entries{{{"document/1/slice.dcm", bytes.first(300)},
                                                   {"document/1/", bytes.first(0)},
                                                   {"..\\..\\a:b\n.dcm", bytes},
                                                   {"/etc/passwd", bytes.first(1)},
                                                   {"more.ZIP", bytes.first(20)}}};
  const test::TemporaryFolder folder;
  if (const auto written = document::write_zip(folder / "a.zip", entries); !written) {
    qFatal("%s", written.error().message.c_str());
  }
  const std::string whole = test::contents(folder / "a.zip");
  write("study_archive", "whole", whole);
  write("study_archive", "cut-off", whole.substr(0, whole.size() - 10));
  // In the first entry's record of the directory: a flag, and its size.
  const std::size_t record = whole.find("PK\x01\x02");
  write("study_archive", "encrypted", std::string(whole).replace(record + 8, 1, "\1"));
  write("study_archive", "two-gigabytes", std::string(whole).replace(record + 24, 4, "\xff\xff\xff\x7f"));
  write("study_archive", "longer-than-it-says", std::string(whole).replace(record + 24, 1, "\5"));
}

void write_volumes() {
  const std::string voxels = "abcdefgh";
  const std::string plain = test::NiftiHeader({2, 2, 2}, 2, 8).bytes();
  write("nifti", "uint8", plain + voxels);
  write("nifti", "gzip", gzip(plain + voxels));
  write("nifti", "int16", test::NiftiHeader({2, 2, 1}, 4, 16).bytes() + voxels);
  write("nifti", "float", test::NiftiHeader({2, 1, 1}, 16, 32).bytes() + std::string(8, '\0'));
  write("nifti", "swapped", test::NiftiHeader({2, 2, 1}, 4, 16).swapped() + voxels);
  test::NiftiHeader both({2, 2, 2}, 2, 8);
  both.set<std::int16_t>(252, 1).set<float>(256, 0.5F).set<float>(112, 2.0F);
  write("nifti", "both-forms-scaled", both.bytes() + voxels);
  // ITK's decomposition of the sform did not end.
  test::NiftiHeader endless({2, 2, 2}, 2, 8);
  endless.set<float>(280, 1.7613126e19F).set<float>(284, 6.742214e22F);
  write("nifti", "found-sform-overflow", endless.bytes() + voxels);
  test::NiftiHeader extended({2, 2, 2}, 2, 8);
  extended.set<float>(108, 384.0F).set<char>(348, 1);
  const std::string extension("\x20\0\0\0\6\0\0\0comment", 15);
  write("nifti", "extension", extended.bytes() + extension + std::string(17, '\0') + voxels);

  const Volume volume = test::counting_volume<std::int16_t>(test::awkward_grid({3, 2, 2}), -3);
  for (const std::string suffix : {"nrrd", "mha"}) {
    const test::TemporaryFolder folder;
    if (const auto written = imaging::write_volume_file(volume, folder / ("v." + suffix)); !written) {
      qFatal("%s", written.error().message.c_str());
    }
    write("volume_files", suffix, test::contents(folder / ("v." + suffix)));
  }
  const std::string grid =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nspace: left-posterior-superior\n"
      "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nendian: little\n";
  write("volume_files", "nrrd-raw", grid + "encoding: raw\n\n" + voxels);
  write("volume_files", "nrrd-text", grid + "encoding: text\n\n1 2 3 4 5 6 7 8\n");
  write("volume_files", "nrrd-detached", grid + "encoding: raw\ndata file: ../v.raw\n\n");
  const std::string meta =
      "ObjectType = Image\nNDims = 3\nElementSpacing = 1 1 1\nDimSize = 2 2 2\n"
      "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 0 0 0\nElementType = MET_UCHAR\n";
  write("volume_files", "mha-raw", meta + "ElementDataFile = LOCAL\n" + voxels);
  write("volume_files", "mha-text", meta + "BinaryData = False\nElementDataFile = LOCAL\n1 2 3 4 5 6 7 8\n");
  write("volume_files", "mha-texts",
        "Comment = " + std::string(240, 'c') +
            "\nAcquisitionDate = 2007.03.21\nName = n\nObjectSubType = s\n" + meta +
            "Modality = MET_MOD_CT\nAnatomicalOrientation = RAI\nElementDataFile = LOCAL\n" + voxels);
  std::string gipl(256, '\0');
  for (const std::size_t axis : {0, 1, 2}) gipl[2 * axis + 1] = 2;
  gipl[9] = 8;                                                                          // unsigned bytes
  for (const std::size_t axis : {0, 1, 2}) gipl.replace(10 + 4 * axis, 2, "\x3f\x80");  // 1 mm
  gipl.replace(252, 4, "\xef\xff\xe9\xb0");
  write("volume_files", "gipl", gipl + voxels);
  write("volume_files", "gipl-gzip", gzip(gipl + voxels));
}

void write_pictures() {
  const std::string rows = "abcdefghijkl";
  const std::string density = test::png_chunk("pHYs", test::big(5000) + test::big(5000) + "\1");
  write("volume_files", "png", test::Png{.before = density}.with(rows));
  write("volume_files", "png-deep", test::Png{.bits = 16}.with(rows + rows));
  write("volume_files", "png-colours",
        test::Png{.columns = 2, .rows = 1, .colour_type = 6}.with(rows.substr(0, 8)));
  write("volume_files", "png-interlaced", test::Png{.interlaced = true}.with(rows));
  const std::string palette = test::png_chunk("PLTE", "rgbRGBabc") + test::png_chunk("tRNS", "a");
  write("volume_files", "png-palette",
        test::Png{.bits = 2, .colour_type = 3, .before = palette}.with("\x18\x24\x18"));
  const std::vector<std::uint8_t> grey(128, 90);
  write("volume_files", "jpeg",
        test::Jpeg{.dpi = 254, .app1 = test::exif_orientation_marker(6, true)}.with(grey));
  write("volume_files", "jpeg-progressive", test::Jpeg{.progressive = true}.with(grey));
  write("volume_files", "jpeg-colours",
        test::Jpeg{.columns = 8, .channels = 3}.with(std::vector<std::uint8_t>(192, 90)));
  test::TiffPage page{.bytes = rows};
  page.dpi = 508.0;
  page.orientation = 8;
  write("volume_files", "tiff", test::tiff({page}));
  page.compression = 5;
  write("volume_files", "tiff-pages", test::tiff({page, page}));
  test::TiffPage tiled{.columns = 4, .rows = 3, .samples = 3, .meaning = 2, .compression = 8, .tile = 16};
  tiled.bytes = rows + rows + rows;
  write("volume_files", "tiff-tiles", test::tiff({tiled}));
  write("volume_files", "tiff-palette",
        test::tiff({test::TiffPage{.meaning = 3, .compression = 32773, .bytes = rows}}));
  write("volume_files", "tiff-bits", test::tiff({test::TiffPage{.bits = 1, .bytes = "abc"}}));
}

// Two boxes that overlap, one of them with a hole.
imaging::Segments boxes() {
  imaging::Segments segments{{{7, 5, 4}}, {}, {}};
  const Index3 size = segments.geometry.size;
  for (const bool is_hollow : {false, true}) {
    std::vector<std::uint8_t> voxels(static_cast<std::size_t>(segments.geometry.voxel_count()));
    for (std::int64_t k = is_hollow ? 1 : 0; k < size.z - 1; ++k) {
      for (std::int64_t j = 1; j < size.y - 1; ++j) {
        for (std::int64_t i = is_hollow ? 3 : 1; i < size.x - 1; ++i) {
          const bool is_hole = is_hollow && i == 4 && j == 2;
          voxels[static_cast<std::size_t>(segments.geometry.offset({i, j, k}))] = is_hole ? 0 : 1;
        }
      }
    }
    imaging::Segment segment;
    segment.name = is_hollow ? "hollow" : "box";
    segment.slices = imaging::slices_of(segments.geometry, voxels);
    segments.list.push_back(std::move(segment));
  }
  return segments;
}

// As fractions of 255, a byte each.
void make_fractional(DcmDataset& dataset) {
  const imaging::Segments segments = boxes();
  std::vector<Uint8> bytes;
  for (const imaging::Segment& segment : segments.list) {
    for (const auto& [k, slice] : segment.slices) {
      for (const std::uint8_t inside : slice) bytes.push_back(inside != 0 ? 200 : 60);
    }
  }
  if (bytes.size() % 2 != 0) bytes.push_back(0);
  for (const auto& [key, bits] : {std::pair{DCM_BitsAllocated, 8}, {DCM_BitsStored, 8}, {DCM_HighBit, 7}}) {
    dataset.putAndInsertUint16(key, static_cast<Uint16>(bits));
  }
  dataset.putAndInsertString(DCM_SegmentationType, "FRACTIONAL");
  dataset.putAndInsertString(DCM_SegmentationFractionalType, "PROBABILITY");
  dataset.putAndInsertUint16(DCM_MaximumFractionalValue, 255);
  dataset.putAndInsertUint8Array(DcmTag(DCM_PixelData, EVR_OB), bytes.data(), bytes.size());
}

void write_results() {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "result.dcm";
  const auto must = [](const Status& done) {
    if (!done) qFatal("%s", done.error().message.c_str());
  };
  must(imaging::write_structure_set(boxes(), {}, file));
  write("result_files", "structure-set", test::contents(file));
  test::edit(file, [](DcmDataset& dataset) {
    DcmItem* region = nullptr;
    DcmItem* contour = nullptr;
    dataset.findAndGetSequenceItem(DCM_ROIContourSequence, region);
    region->findAndGetSequenceItem(DCM_ContourSequence, contour);
    contour->putAndInsertString(DCM_ContourData, "2\\-3\\0\\2\\9.5\\3\\2\\1\\1e2");
  });
  write("result_files", "sagittal-beyond", test::contents(file));
  must(imaging::write_segmentation(boxes(), {}, file));
  write("result_files", "segmentation", test::contents(file));
  test::set_text(file, 0x0062, 0x0001, "FRACTIONAL");
  write("result_files", "bits-for-bytes", test::contents(file));
  test::edit(file, make_fractional);
  write("result_files", "fractions", test::contents(file));
  test::set_text(file, 0x0062, 0x0001, "BINARY");
  write("result_files", "bytes-for-bits", test::contents(file));
  test::set_text(file, 0x0062, 0x0001, "FRACTIONAL");
  if (!test::recode(file, EXS_RLELossless, false)) qFatal("cannot encode fractions");
  write("result_files", "fractions-rle", test::contents(file));
}

std::string session_json_in(const fs::path& file) {
  const std::string_view name = document::session_entry_names().front();
  auto archive = document::ZipReader::open(file, document::session_entry_names()).value();
  const auto text = archive.read(name, archive.size(name)).value();
  return {reinterpret_cast<const char*>(text.data()), text.size()};
}

void write_studies() {
  const auto document = test::make_case(test::lumpy_volume({9, 8, 9}));
  document::Start start;
  start.seeds = {test::ball_at(*document->volume(), {0.3, -0.2, 0.4}, 2.0)};
  if (const auto begun = document->level_set().begin(start); !begun)
    qFatal("%s", begun.error().message.c_str());
  test::run(document->level_set(), 3);
  const auto painted =
      document->level_set().paint(test::ball_at(*document->volume(), {1, 0, 1}, 1.0), solver::Brush::add);
  if (!painted) qFatal("%s", painted.error().message.c_str());
  document::Label label = *document->labels().find(document->labels().add("Left").value());
  label.meaning = imaging::find_segment_meaning("kidney").value();
  if (const auto set = document->labels().set(label); !set) qFatal("%s", set.error().message.c_str());

  auto contents = document::snapshot_of(*document).value();
  write("recipe", "recipe.json", contents.recipe.to_text().value());
  contents.origin.phantom = "tumour";
  contents.truth = std::make_shared<const BitMask>(contents.phi->mask());
  const test::TemporaryFolder folder;
  if (const auto saved = document::write_session(contents, folder / "case"); !saved) {
    qFatal("%s", saved.error().message.c_str());
  }
  write("session", "session.tidemark", test::contents(folder / "case"));
  write("session", "session.json", session_json_in(folder / "case"));
  for (const document::OwnLesson& lesson : document::own_lessons()) {
    write("lesson", std::string(lesson.name), std::string(lesson.text));
  }
  for (const std::string& name : renderer::preset_names())
    write("transfer_preset", name, renderer::preset(name).value().to_json());
}

}  // namespace

// What is thrown ends it, which a tool of developers may do.
// NOLINTNEXTLINE(bugprone-exception-escape)
int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: fuzz_seeds FOLDER\n", stderr);
    return 2;
  }
  corpus = argv[1];
  write_plain_dicom();
  write_dicom_of_several_slices();
  write_compressed_dicom();
  write_csa_headers();
  write_multiparts();
  write_media_directories();
  write_archives();
  write_volumes();
  write_pictures();
  write_results();
  write_studies();
  return 0;
}
