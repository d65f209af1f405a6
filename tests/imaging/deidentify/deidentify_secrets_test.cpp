// A series full of what tells who the patient is, and the bytes of what is left of it.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <QFile>
#include <QRegularExpression>
#include <QTest>

#include <array>
#include <cstring>
#include <memory>
#include <vector>

#include "imaging/deidentify/deidentify.h"
#include "imaging/deidentify/profile.h"
#include "imaging/dicom/dicom.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::deidentify_secrets_test {

namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "ZAPHOD";

// What must not be found: a name, dates, times and numbers. A date's digits may lie in a long random number.
constexpr std::array kSecrets{
    kName,      "zaphod",   "(?<![0-9])19370419(?![0-9])", "19370419113355", "113355.471147",
    "47114711", "47\\.1147"};

void require(const OFCondition& good) {
  if (good.bad()) qFatal("%s", good.text());
}

std::string secret_of(DcmEVR vr, const DcmTagKey& key) {
  switch (vr) {
    case EVR_AS:
      return "071Y";
    case EVR_DA:
      return "19370419";
    case EVR_DT:
      return "19370419113355.471147";
    case EVR_TM:
      return "113355.471147";
    case EVR_DS:
      return "47.114711";
    case EVR_IS:
      return "47114711";
    case EVR_UI:
      return "1.2.826.0.1.47114711." + std::to_string(key.getGroup()) + "." +
             std::to_string(key.getElement());
    case EVR_UR:
      return "https://zaphod.example/47114711";
    default:
      return "ZAPHOD^BEEBLE";
  }
}

void put_secret(DcmItem& item, const DcmTagKey& key) {
  const DcmTag tag(key);
  const std::string words = "ZAPHOD 47114711.";
  std::vector<Uint16> pairs(words.size() / 2);
  std::memcpy(pairs.data(), words.data(), words.size());
  switch (tag.getEVR()) {
    case EVR_SQ: {
      DcmItem* inside = nullptr;
      require(item.findOrCreateSequenceItem(tag, inside, 0));
      require(inside->putAndInsertString(DCM_PatientName, "ZAPHOD^BEEBLE"));
      require(inside->putAndInsertString(DCM_CodeMeaning, "ZAPHOD"));
      return;
    }
    case EVR_UN: {
      auto unknown = std::make_unique<DcmOtherByteOtherWord>(tag);
      require(unknown->putUint8Array(reinterpret_cast<const Uint8*>(words.data()),
                                     static_cast<unsigned long>(words.size())));
      return require(item.insert(unknown.release()));
    }
    case EVR_OB:
      return require(item.putAndInsertUint8Array(tag, reinterpret_cast<const Uint8*>(words.data()),
                                                 static_cast<unsigned long>(words.size())));
    case EVR_OW:
      return require(
          item.putAndInsertUint16Array(tag, pairs.data(), static_cast<unsigned long>(pairs.size())));
    case EVR_US:
      return require(item.putAndInsertUint16(tag, 4711));
    case EVR_SS:
    case EVR_UL:
    case EVR_SL:
    case EVR_FL:
    case EVR_FD:
    case EVR_AT:
      qFatal("no secret of that representation: %s", key.toString().c_str());
    default:
      return require(item.putAndInsertString(tag, secret_of(tag.getEVR(), key).c_str()));
  }
}

// All attributes of the dictionary that do not stay as they are, but for what makes the object a document.
std::vector<DcmTagKey> telling_attributes() {
  std::vector<DcmTagKey> keys;
  DcmDataDictionary& dictionary = dcmDataDict.wrlock();
  for (auto entry = dictionary.normalBegin(); entry != dictionary.normalEnd(); ++entry) {
    const DcmTagKey key = **entry;
    const DcmEVR vr = (*entry)->getEVR();
    const bool is_document = key == DCM_ContentSequence || key == DCM_EncapsulatedDocument;
    if (key.getGroup() < 8 || key.getGroup() % 2 != 0 || is_document || vr == EVR_na) continue;
    const auto fate = imaging::fate_of({key.getGroup(), key.getElement()}, DcmVR(vr).getVRName(), {});
    if (fate != imaging::Fate::keep && key.getElement() != 0) keys.push_back(key);
  }
  dcmDataDict.wrunlock();
  return keys;
}

void fill(DcmItem& item, const std::vector<DcmTagKey>& keys) {
  for (const DcmTagKey& key : keys) {
    if (key.getGroup() < 0xfff0) put_secret(item, key);
  }
  // Private, unknown, and of repeating groups.
  require(item.putAndInsertString(DcmTag(0x0009, 0x0010, EVR_LO), "ZAPHOD INC"));
  require(item.putAndInsertString(DcmTag(0x0009, 0x1001, EVR_LO), "ZAPHOD"));
  require(item.putAndInsertString(DcmTag(0x0018, 0xfff1, EVR_LO), "ZAPHOD"));
  require(item.putAndInsertString(DcmTag(0x0018, 0xfff3, EVR_UI), "1.2.826.0.1.47114711.9"));
  require(item.putAndInsertString(DcmTag(0x5000, 0x0030, EVR_SH), "ZAPHOD"));
  require(item.putAndInsertString(DcmTag(0x6000, 0x1500, EVR_LO), "ZAPHOD"));
  require(item.putAndInsertString(DcmTag(0x6002, 0x4000, EVR_LT), "ZAPHOD"));
  const Uint16 overlay[] = {0x415a, 0x4850, 0x444f};  // ZAPHOD
  require(item.putAndInsertUint16Array(DcmTag(0x6000, 0x3000, EVR_OW), overlay, 3));
  // Words where the dictionary has a number.
  require(item.putAndInsertString(DcmTag(0x0018, 0x1310, EVR_LO), "ZAPHOD"));
}

void write_with_secrets(const fs::path& file, const std::vector<DcmTagKey>& keys, int number) {
  DcmFileFormat loaded;
  require(loaded.loadFile(file.c_str()));
  require(loaded.loadAllDataIntoMemory());
  DcmDataset& dataset = *loaded.getDataset();
  fill(dataset, keys);
  const std::string uid = "1.2.826.0.1.47114711.0." + std::to_string(number);
  require(dataset.putAndInsertString(DCM_SOPInstanceUID, uid.c_str()));
  DcmItem* image = nullptr;
  require(dataset.findOrCreateSequenceItem(DCM_ReferencedImageSequence, image, 0));
  fill(*image, keys);
  DcmItem* deeper = nullptr;
  require(image->findOrCreateSequenceItem(DCM_PurposeOfReferenceCodeSequence, deeper, 0));
  fill(*deeper, keys);
  require(loaded.getMetaInfo()->putAndInsertString(DCM_SourceApplicationEntityTitle, "ZAPHOD"));
  require(loaded.saveFile(file.c_str(), EXS_LittleEndianExplicit, EET_ExplicitLength));
  QFile bytes(QString::fromStdString(file.string()));
  if (!bytes.open(QIODevice::ReadWrite)) qFatal("cannot write the preamble");
  bytes.write("ZAPHOD in the preamble");
}

}  // namespace

class DeidentifySecretsTest : public QObject {
  Q_OBJECT

 private slots:
  void nothing_is_left_in_any_byte() {
    const TemporaryFolder folder;
    const Volume volume = sample_volume({6, 5, 3});
    const auto files = write_series(volume, folder / "ZAPHOD");
    const auto keys = telling_attributes();
    QVERIFY(keys.size() > 600);
    for (std::size_t i = 0; i < files.size(); ++i) write_with_secrets(files[i], keys, static_cast<int>(i));
    const QByteArray before = bytes_of(files[0]);
    QVERIFY(before.startsWith("ZAPHOD") && before.count("ZAPHOD") > 900);
    for (const char* secret : kSecrets) QVERIFY2(finds(before, secret), secret);

    auto made = imaging::deidentify(files, folder / "out", {.record = imaging::RecordedChanges::each});
    QCOMPARE(failure(made), QString());
    QCOMPARE(failure(made->folder.commit()), QString());
    QCOMPARE(made->files.size(), files.size());
    std::int64_t listed = 0;
    for (const imaging::DeidentifiedFile& file : made->files) {
      listed += static_cast<std::int64_t>(file.changes.size());
      verify_without_secrets(bytes_of(folder / "out" / file.name), file.name);
      verify_without_secrets(QByteArray::fromStdString(file.name), "the name");
      QVERIFY(file.changes.size() > keys.size());
      for (const imaging::ChangedAttribute& one : file.changes) {
        verify_without_secrets(QByteArray::fromStdString(one.path + one.keyword), "the list");
      }
    }
    QCOMPARE(values_of(*made), listed);
    const auto read = imaging::load_dicom(only_series(folder / "out"));
    QCOMPARE(failure(read), QString());
    verify_same(*read, volume);

    // The totals alone are the same, and nothing grows with the files.
    const auto summed =
        imaging::deidentify(files, folder / "again", {.record = imaging::RecordedChanges::totals});
    QCOMPARE(failure(summed), QString());
    QCOMPARE(values_of(*summed), listed);
    QCOMPARE(summed->totals.size(), made->totals.size());
    for (const imaging::DeidentifiedFile& file : summed->files) QVERIFY(file.changes.empty());
  }

 private:
  static std::int64_t values_of(const imaging::Deidentified& made) {
    std::int64_t sum = 0;
    for (const imaging::ChangeTotal& one : made.totals) sum += one.values;
    return sum;
  }

  static bool finds(const QByteArray& bytes, const char* secret) {
    return QRegularExpression(secret).match(QString::fromLatin1(bytes)).hasMatch();
  }

  static void verify_without_secrets(const QByteArray& bytes, const std::string& where) {
    QVERIFY(!bytes.isEmpty());
    for (const char* secret : kSecrets) {
      QVERIFY2(!finds(bytes, secret), qPrintable(QString::fromStdString(where) + ": " + secret));
    }
  }
};

TIDEMARK_TEST(DeidentifySecretsTest)

}  // namespace tidemark::test::deidentify_secrets_test

#include "deidentify_secrets_test.moc"
