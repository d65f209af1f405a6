// Actions of the profile, dummy values, and dates that are moved.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <QTest>

#include "imaging/deidentify/dummy_value.h"
#include "imaging/deidentify/profile.h"
#include "imaging/deidentify/pseudonyms.h"
#include "imaging/deidentify/shifted_date.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::deidentify_profile_test {

using imaging::DeidentifyOptions;
using imaging::Fate;

class DeidentifyProfileTest : public QObject {
  Q_OBJECT

 private slots:
  void each_action_has_its_fate_data() {
    QTest::addColumn<int>("group");
    QTest::addColumn<int>("element");
    QTest::addColumn<QString>("vr");
    QTest::addColumn<int>("fate");
    const auto row = [](const char* name, int group, int element, const char* vr, Fate fate) {
      QTest::newRow(name) << group << element << QString(vr) << static_cast<int>(fate);
    };
    row("X", 0x0010, 0x4000, "LT", Fate::remove);
    row("Z", 0x0008, 0x0050, "SH", Fate::empty);
    row("D", 0x0012, 0x0010, "LO", Fate::replace);
    row("D, a sequence", 0x0070, 0x0001, "SQ", Fate::replace);
    row("D, a UID", 0x006a, 0x0003, "UI", Fate::map_uid);
    row("U", 0x0020, 0x000d, "UI", Fate::map_uid);
    row("Z/D", 0x0008, 0x0023, "DA", Fate::replace);
    row("X/Z", 0x0008, 0x0022, "DA", Fate::empty);
    row("X/Z, a sequence", 0x0008, 0x1110, "SQ", Fate::remove);
    row("X/Z, a sequence that images need", 0x0040, 0x0555, "SQ", Fate::empty);
    row("X/D", 0x0018, 0x1030, "LO", Fate::replace);
    row("X/D, a sequence", 0x0008, 0x1072, "SQ", Fate::remove);
    row("X/Z/D", 0x0008, 0x1010, "SH", Fate::replace);
    row("X/Z/D, a sequence", 0x0008, 0x0082, "SQ", Fate::remove);
    row("X/Z/U*", 0x0008, 0x1140, "SQ", Fate::keep);
    row("a class", 0x0008, 0x0016, "UI", Fate::keep);
    row("private", 0x0009, 0x0010, "LO", Fate::remove);
    row("unknown", 0x0018, 0xfffd, "", Fate::remove);
    row("a curve", 0x5002, 0x3000, "OW", Fate::remove);
    row("an overlay", 0x6000, 0x3000, "OW", Fate::remove);
    row("an overlay's label", 0x601e, 0x1500, "LO", Fate::remove);
    row("a group length", 0x0008, 0x0000, "UL", Fate::remove);
    row("a name that no row has", 0x0014, 0x2006, "PN", Fate::replace);
    row("a UID that no row has", 0x0020, 0x9312, "UI", Fate::map_uid);
    row("a date that no row has", 0x0014, 0x3076, "DA", Fate::replace);
    row("an address that no row has", 0x0008, 0x1190, "UR", Fate::remove);
    row("free text that no row has", 0x0062, 0x0006, "ST", Fate::replace);
    row("a number", 0x0028, 0x0010, "US", Fate::keep);
    row("a term", 0x0008, 0x0060, "CS", Fate::keep);
  }

  void each_action_has_its_fate() {
    QFETCH(int, group);
    QFETCH(int, element);
    QFETCH(QString, vr);
    const imaging::DicomTag tag{static_cast<std::uint16_t>(group), static_cast<std::uint16_t>(element)};
    QTEST(static_cast<int>(imaging::fate_of(tag, vr.toStdString(), {})), "fate");
  }

  void options_keep_what_they_are_named_for() {
    const auto fate = [](int group, int element, const char* vr, const DeidentifyOptions& options) {
      return imaging::fate_of({static_cast<std::uint16_t>(group), static_cast<std::uint16_t>(element)}, vr,
                              options);
    };
    QCOMPARE(fate(0x0020, 0x000d, "UI", {.keep_uids = true}), Fate::keep);
    QCOMPARE(fate(0x0008, 0x1140, "SQ", {.keep_uids = true}), Fate::keep);
    QCOMPARE(fate(0x0040, 0xa124, "UI", {.keep_uids = true}), Fate::map_uid);
    QCOMPARE(fate(0x0018, 0x1000, "LO", {.keep_device = true}), Fate::keep);
    QCOMPARE(fate(0x0008, 0x0055, "AE", {.keep_device = true}), Fate::remove);
    QCOMPARE(fate(0x0008, 0x0080, "LO", {.keep_institution = true}), Fate::keep);
    QCOMPARE(fate(0x0010, 0x0040, "CS", {.keep_characteristics = true}), Fate::keep);
    QCOMPARE(fate(0x0010, 0x1030, "DS", {.keep_characteristics = true}), Fate::keep);
    QCOMPARE(fate(0x0010, 0x2110, "LO", {.keep_characteristics = true}), Fate::remove);
    QCOMPARE(fate(0x0008, 0x0020, "DA", {.shift_dates = true}), Fate::shift);
    QCOMPARE(fate(0x0008, 0x0030, "TM", {.shift_dates = true}), Fate::keep);
    QCOMPARE(fate(0x0018, 0x1078, "DT", {.shift_dates = true}), Fate::shift);
    QCOMPARE(fate(0x0010, 0x0030, "DA", {.shift_dates = true}), Fate::empty);
    QCOMPARE(fate(0x0016, 0x0077, "DT", {.shift_dates = true}), Fate::remove);
    QCOMPARE(fate(0x0018, 0x1200, "DA", {.keep_device = true, .shift_dates = true}), Fate::shift);
  }

  // Of every attribute that the dictionary knows, but for UIDs: they are mapped.
  void dummy_values_are_right_for_their_representation() {
    DcmDataDictionary& dictionary = dcmDataDict.wrlock();
    std::vector<DcmTagKey> keys;
    for (auto entry = dictionary.normalBegin(); entry != dictionary.normalEnd(); ++entry) {
      const DcmEVR vr = (*entry)->getEVR();
      const bool has_value = vr != EVR_SQ && vr != EVR_UI && vr != EVR_na;
      if (has_value && (*entry)->getGroup() >= 8) keys.push_back(**entry);
    }
    dcmDataDict.wrunlock();
    QVERIFY(keys.size() > 3000);
    for (const DcmTagKey& key : keys) {
      const auto element = imaging::dummy_element(key);
      QVERIFY2(element->checkValue("1").good(), key.toString().c_str());
      const DcmEVR vr = element->getTag().getEVR();
      const bool has_dummy = element->isaString() || vr == EVR_OB || vr == EVR_UN;
      QVERIFY2(!has_dummy || element->getLength() > 0, key.toString().c_str());
    }
  }

  void dates_move_by_days_through_the_calendar_data() {
    QTest::addColumn<QString>("old");
    QTest::addColumn<int>("days");
    QTest::addColumn<QString>("moved");
    QTest::newRow("a day") << "20240228" << 1 << "20240229";
    QTest::newRow("back over a year") << "20240101" << -1 << "20231231";
    QTest::newRow("far back") << "20240229" << -3650 << "20140303";
    QTest::newRow("several") << "20240101\\20240301" << -1 << "20231231\\20240229";
    QTest::newRow("old form") << "2004.07.31" << 1 << "20040801";
    QTest::newRow("a moment") << "20040731235959.125+0200" << 1 << "20040801235959.125+0200";
    QTest::newRow("no day") << "200407" << 1 << "";
    QTest::newRow("not in the calendar") << "20230230" << 1 << "";
    QTest::newRow("words") << "yesterday" << 1 << "";
    QTest::newRow("words behind") << "20040731 Zaphod" << 1 << "";
    QTest::newRow("empty") << "" << 1 << "";
  }

  void dates_move_by_days_through_the_calendar() {
    QFETCH(QString, old);
    QFETCH(int, days);
    QTEST(QString::fromStdString(imaging::shifted_dates(old.toStdString(), days)), "moved");
  }

  void the_same_uid_becomes_the_same() {
    imaging::Pseudonyms pseudonyms{DeidentifyOptions{}};
    const std::string one = pseudonyms.uids("1.2.3");
    QVERIFY(one.starts_with("2.25.") && one.size() <= 64);
    QCOMPARE(pseudonyms.uids("1.2.3 "), one);
    QCOMPARE(pseudonyms.uids("1.2.3\\1.2.840.10008.1.2"), one + "\\1.2.840.10008.1.2");
    QVERIFY(pseudonyms.uids("1.2.4") != one);
    QCOMPARE(pseudonyms.uids("1.2.840.10008.Zaphod").find("Zaphod"), std::string::npos);
    QCOMPARE(pseudonyms.known_uids().size(), std::size_t{3});
  }
};

TIDEMARK_TEST(DeidentifyProfileTest)

}  // namespace tidemark::test::deidentify_profile_test

#include "deidentify_profile_test.moc"
