// Files whose tags are wrong. DCMTK would crash on some of them, and read others as something else.
#include "tests/imaging/dicom/bad_dicom.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::bad_dicom_structure_test {

namespace {

constexpr const char* kExplicitSyntax = "1.2.840.10008.1.2.1";
constexpr const char* kImplicitSyntax = "1.2.840.10008.1.2";
constexpr const char* kBigEndianSyntax = "1.2.840.10008.1.2.2";
constexpr const char* kDeflated = "1.2.840.10008.1.2.1.99";
constexpr std::uint32_t kReferencedImages = 0x00081140;

// A slice with one more element, or another in its place.
std::string with(std::uint32_t tag, const std::string& encoded, Coding coding = kExplicit) {
  return file(Dataset::slice(coding).put(tag, encoded));
}

std::string with_sequence(const std::string& value, std::uint32_t length, Coding coding = kExplicit) {
  return with(kReferencedImages, element(kReferencedImages, "SQ", value, coding, length), coding);
}

std::string with_nested(int depth, const char* vr, Coding coding, bool has_lengths) {
  return with(kReferencedImages, nested(depth, vr, coding, has_lengths), coding);
}

std::vector<BadDicom> beginnings() {
  const std::string slice = Dataset::slice().bytes();
  const std::string good = meta(kExplicitSyntax);
  const std::string sequence = element(0x00020020, "SQ", sequence_end(), kExplicit, kUndefinedLength);
  const std::string endless = element(0x00020020, "UN", sequence_end(), kExplicit, kUndefinedLength);
  const std::string syntax = "TransferSyntaxUID (0002,0010) is ";
  return {
      {"empty", "", "is not a DICOM file"},
      {"one byte", "D", "is not a DICOM file"},
      {"preamble without its magic word", std::string(200, '\0'), "is not a DICOM file"},
      {"preamble alone", preamble(), "the dataset is missing"},
      {"noise", preamble() + std::string(500, '\x42'), "is damaged"},
      {"text", preamble() + "Dear colleague, the scan is on the other disk.", "is damaged"},
      {"no dataset", preamble() + good, "the dataset is missing"},
      {"group length too small", preamble() + meta(kExplicitSyntax, 20) + slice,
       "FileMetaInformationGroupLength (0002,0000)"},
      {"group length too large", preamble() + meta(kExplicitSyntax, 200) + slice, "(0002,0000)"},
      {"group length beyond the file", preamble() + meta(kExplicitSyntax, 0xfffffff0) + slice, "(0002,0000)"},
      {"sequence in group 0002", preamble() + meta(kExplicitSyntax, 0) + sequence + slice, "(0002,0020)"},
      {"endless element in group 0002", preamble() + meta(kExplicitSyntax, 0) + endless + slice,
       "(0002,0020)"},
      {"implicit group 0002", preamble() + text(0x00020010, "UI", kExplicitSyntax, kImplicit) + slice,
       "(0002,0010)"},
      {"big endian group 0002", preamble() + text(0x00020010, "UI", kExplicitSyntax, kBigEndian) + slice,
       "group 0002"},
      {"big endian group 0002 without preamble", text(0x00020010, "UI", kExplicitSyntax, kBigEndian) + slice,
       "group 0002"},
      {"odd length in group 0002", preamble() + element(0x00020010, "UI", "1.2") + slice, "(0002,0010)"},
      {"unknown representation in group 0002", preamble() + element(0x00020010, "ZZ", "1.2.") + slice,
       "(0002,0010)"},
      {"unknown syntax", file("1.2.3.4", slice), syntax + "1.2.3.4"},
      {"no syntax", file("", slice), syntax},
      {"syntax in words", file("little \x1b[2J\n", slice), syntax + "little ?[2J?"},
      {"JPEG XL", file("1.2.840.10008.1.2.4.110", slice), "JPEG XL Lossless"},
      {"JPEG XL", file("1.2.840.10008.1.2.4.110", slice), "JPEG XL"},
      {"video", file("1.2.840.10008.1.2.4.102", slice), "MPEG-4"},
      {"JPIP", file("1.2.840.10008.1.2.4.94", slice), "JPIP"},
      {"GE's private syntax", file("1.2.840.113619.5.2", slice), "GE Private"},
      {"a directory of a disk",
       file(kExplicitSyntax, element(0x00041220, "SQ", item(text(0x00041500, "CS", "..\\..\\ETC\\PASSWD")))),
       "without an image"},
  };
}

std::vector<BadDicom> lengths() {
  constexpr std::uint32_t kName = 0x00100010;
  const auto lies = [&](std::uint32_t length, Coding coding = kExplicit) {
    return with(kName, element(kName, "UN", "abcd", coding, length), coding);
  };
  std::string backwards;
  for (std::uint32_t k = 10000; k > 0; --k) backwards += element(0x00110000 + k, "UN", "", kImplicit);
  std::string private_elements;
  for (std::uint32_t k = 0; k < 100; ++k) private_elements += element(0x00110010 + k, "LO", "ab");
  for (std::uint32_t k = 0; k < 220000; ++k) private_elements += element(0x00111000 + k % 60000, "UN", "");
  std::string crowd;
  for (std::uint32_t k = 0; k < 300000; ++k) crowd += element(0x00110000, "UN", "", kImplicit);
  return {
      {"odd length", with(kName, element(kName, "PN", "abc")),
       "PatientName (0010,0010) has an odd length, 3"},
      {"odd length, implicit", with(kName, element(kName, "PN", "abc", kImplicit), kImplicit),
       "(0010,0010) has an odd length"},
      {"odd length, big endian", with(kName, element(kName, "PN", "abc", kBigEndian), kBigEndian),
       "(0010,0010) has an odd length"},
      {"length beyond the file", lies(0x7ffffffe), "(0010,0010) says 2147483646 bytes"},
      {"length of almost 4 GiB", lies(0xfffffffe), "(0010,0010) says 4294967294 bytes"},
      {"length beyond the file, implicit", lies(0x7ffffffe, kImplicit), "(0010,0010) says 2147483646 bytes"},
      {"length beyond the file, big endian", lies(0x7ffffffe, kBigEndian), "(0010,0010) says"},
      {"short length beyond the file", with(0x7fe10010, element(0x7fe10010, "LO", "ab", kExplicit, 0xfff0)),
       "(7FE1,0010) says 65520 bytes, 2 are left"},
      {"no representation", with(kName, element(kName, "", "abcd", kImplicit)),
       "(0010,0010) has no value representation"},
      {"representation in small letters", with(kName, element(kName, "pn", "abcd")),
       "(0010,0010) has no value representation"},
      {"DCMTK's own name of a representation", with(kName, element(kName, "Pi", "abcd")),
       "(0010,0010) has no value representation"},
      {"explicit tags called implicit", file(kImplicitSyntax, Dataset::slice().bytes()), "is damaged"},
      {"implicit tags called explicit", file(kExplicitSyntax, Dataset::slice(kImplicit).bytes()),
       "has no value representation"},
      {"little endian called big", file(kBigEndianSyntax, Dataset::slice().bytes()), "is damaged"},
      {"big endian called little", file(kExplicitSyntax, Dataset::slice(kBigEndian).bytes()), "is damaged"},
      {"a piece of a tag at the end", file(Dataset::slice()) + std::string("\x10\0", 2),
       "ends within an element"},
      {"a tag without length at the end",
       file(Dataset::slice()) + std::string("\xe2\x7f\x10\0OB\0\0\x04\0", 10),
       "(7FE2,0010) ends within its length"},
      {"zeros after the end", file(Dataset::slice()) + std::string(512, '\0'),
       "has no value representation (bytes 00 00)"},
      {"10,000 elements in reverse", file(kImplicitSyntax, backwards), "not in order"},
      {"220,000 private elements of 100 creators", file(kExplicitSyntax, private_elements), "not in order"},
      {"300,000 empty elements", file(kImplicitSyntax, crowd), "is one of more than"},
  };
}

std::vector<BadDicom> sequences() {
  const std::string name = text(0x00100010, "PN", "Doe");
  const std::string image = "ReferencedImageSequence (0008,1140) ";
  const std::string tagless = long_word(0xe00dfffe);
  return {
      {"no sequence delimiter", with_sequence(item(name), kUndefinedLength), image + "holds (0020,000D)"},
      {"no item delimiter",
       with_sequence(item(name, kExplicit, kUndefinedLength) + sequence_end(), kUndefinedLength),
       image + "has a delimiter (FFFE,E0DD)"},
      {"the file ends in a sequence",
       file(kExplicitSyntax, element(kReferencedImages, "SQ", "", kExplicit, kUndefinedLength)),
       image + "has no sequence delimiter"},
      {"the file ends in an item",
       file(kExplicitSyntax, element(kReferencedImages, "SQ", item("", kExplicit, kUndefinedLength),
                                     kExplicit, kUndefinedLength)),
       image + "has no item delimiter"},
      {"the wrong delimiter", with_sequence(item(name) + item_end(), kUndefinedLength),
       image + "holds (FFFE,E00D)"},
      {"a delimiter in a sequence with a length", with_sequence(item(name) + sequence_end(), 8 + 12 + 8),
       image + "has a delimiter"},
      {"a delimiter in an item with a length", with_sequence(item(name + item_end()), 8 + 12 + 8),
       image + "has a delimiter (FFFE,E00D)"},
      {"a delimiter of 4 bytes",
       with_sequence(item(name) + element(0xfffee0dd, "", "abcd", kImplicit), kUndefinedLength),
       image + "has a delimiter (FFFE,E0DD) of 4 bytes"},
      {"an item delimiter in the dataset", with(0x00100010, item_end()), "(FFFE,E00D)"},
      {"a sequence delimiter in the dataset", with(0x00100010, sequence_end()), "(FFFE,E0DD)"},
      {"an item in the dataset", with(0x00100010, item(name)), "(FFFE,E000)"},
      {"an item longer than its sequence", with_sequence(item(name, kExplicit, 100), 8 + 12),
       image + "has an item of 100 bytes, 12 are left"},
      {"an element longer than its item",
       with_sequence(item(element(0x00100010, "UN", "ab", kExplicit, 60)), 8 + 14),
       "PatientName (0010,0010) says 60 bytes, 2 are left"},
      {"a sequence longer than the file", with_sequence(item(name), 0x10000000),
       image + "says 268435456 bytes"},
      {"an element where an item belongs", with_sequence(name, kUndefinedLength),
       image + "holds (0010,0010)"},
      {"a sequence of 4 bytes", with_sequence("abcd", 4), image + "ends within an element"},
      {"a sequence of no known end",
       with(kReferencedImages,
            element(kReferencedImages, "OB", item(name) + sequence_end(), kExplicit, kUndefinedLength)),
       image + "has no length, and is no sequence"},
      {"implicit: a value that begins as a tag and ends within it",
       with(kReferencedImages, element(kReferencedImages, "SQ", long_word(0xe000fffe), kImplicit), kImplicit),
       image + "ends within an element"},
      {"implicit: a delimiter alone",
       with(kReferencedImages, element(kReferencedImages, "SQ", sequence_end(), kImplicit), kImplicit),
       image + "has a delimiter"},
      {"65 deep", with_nested(65, "SQ", kExplicit, false), image + "lies in more than 64 sequences"},
      {"65 deep with lengths", with_nested(65, "SQ", kExplicit, true), "more than 64 sequences"},
      {"65 deep, implicit", with_nested(65, "SQ", kImplicit, false), "more than 64 sequences"},
      {"65 deep, implicit with lengths", with_nested(65, "SQ", kImplicit, true), "more than 64 sequences"},
      {"65 deep, big endian", with_nested(65, "SQ", kBigEndian, true), "more than 64 sequences"},
      {"65 deep, of unknown representation", with_nested(65, "UN", kExplicit, false),
       "more than 64 sequences"},
      {"20,000 deep", with_nested(20000, "SQ", kExplicit, false), "more than 64 sequences"},
      {"20,000 deep with lengths", with_nested(20000, "SQ", kExplicit, true), "more than 64 sequences"},
      {"20,000 deep, implicit", with_nested(20000, "SQ", kImplicit, false), "more than 64 sequences"},
      {"20,000 deep, implicit with lengths", with_nested(20000, "SQ", kImplicit, true),
       "more than 64 sequences"},
      {"20,000 deep, big endian", with_nested(20000, "SQ", kBigEndian, false), "more than 64 sequences"},
      {"20,000 deep, of unknown representation", with_nested(20000, "UN", kExplicit, false),
       "more than 64 sequences"},
      {"20,000 deep, of unknown representation, with lengths", with_nested(20000, "UN", kExplicit, true),
       "more than 64 sequences"},
      {"20,000 deep without an end",
       file(kExplicitSyntax, nested(20000, "SQ", kExplicit, false).substr(0, 240000)),
       "more than 64 sequences"},
  };
}

std::vector<BadDicom> deflated_files() {
  const std::string slice = Dataset::slice().bytes();
  const std::string stream = deflated(slice);
  const std::string deep = nested(20000, "SQ", kExplicit, false);
  const std::string bomb = element(0x00091010, "OB", std::string(100 << 20, '\0'));
  return {
      {"deflate: a bomb", file(kDeflated, deflated(bomb)), "inflates to more than 67108864 bytes"},
      {"deflate: no stream", file(kDeflated, slice), "is not a deflate stream"},
      {"deflate: cut", file(kDeflated, stream.substr(0, stream.size() - 4)),
       "ends within its deflate stream"},
      {"deflate: nothing in it", file(kDeflated, deflated("")), "without an image"},
      {"deflate: 20,000 deep", file(kDeflated, deflated(deep)), "more than 64 sequences"},
      {"deflate: length beyond the end",
       file(kDeflated, deflated(element(0x00100010, "UN", "abcd", kExplicit, 0x7ffffffe))),
       "(0010,0010) says 2147483646 bytes, 4 are left"},
  };
}

// Cut at every 64th byte; the whole file has a pixel data element at its end.
std::vector<BadDicom> pieces() {
  std::vector<BadDicom> files;
  for (const Coding coding : {kExplicit, kImplicit, kBigEndian}) {
    const std::string whole = file(Dataset::slice(coding));
    const char* const name = coding.is_big_endian ? "big endian"
                             : coding.is_explicit ? "explicit"
                                                  : "implicit";
    for (std::size_t kept = 64; kept < whole.size(); kept += 64) {
      const char* const field = kept < 132 ? "" : "is ";
      files.push_back({std::string(name) + " cut at " + std::to_string(kept), whole.substr(0, kept), field});
    }
  }
  return files;
}

}  // namespace

class BadDicomStructureTest : public QObject {
  Q_OBJECT

 private slots:
  void a_file_that_begins_badly_is_refused_data() { add_rows(beginnings()); }
  void a_file_that_begins_badly_is_refused() { verify_refused(); }
  void a_wrong_length_is_refused_data() { add_rows(lengths()); }
  void a_wrong_length_is_refused() { verify_refused(); }
  void a_wrong_sequence_is_refused_data() { add_rows(sequences()); }
  void a_wrong_sequence_is_refused() { verify_refused(); }
  void a_wrong_deflate_stream_is_refused_data() { add_rows(deflated_files()); }
  void a_wrong_deflate_stream_is_refused() { verify_refused(); }
  void a_piece_of_a_file_is_refused_data() { add_rows(pieces()); }
  void a_piece_of_a_file_is_refused() { verify_refused(); }
};

TIDEMARK_TEST(BadDicomStructureTest)

}  // namespace tidemark::test::bad_dicom_structure_test

#include "bad_dicom_structure_test.moc"
