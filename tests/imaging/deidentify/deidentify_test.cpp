// De-identified series: UIDs, patients, dates, options, and what is left out.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <QProcess>
#include <QTest>

#include <memory>

#include "imaging/deidentify/deidentify.h"
#include "imaging/dicom/dicom.h"
#include "tests/imaging/dicom/enhanced_files.h"
#include "tests/imaging/dicom/recode.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::deidentify_test {

namespace {

namespace fs = std::filesystem;
using imaging::Deidentified;
using imaging::DeidentifyOptions;
using Kind = imaging::LeftOutFile::Kind;

// A file that was written.
class Written {
 public:
  explicit Written(const fs::path& file) {
    if (file_.loadFile(file.c_str()).bad()) qFatal("cannot read %s", file.c_str());
  }
  [[nodiscard]] QString text(const DcmTagKey& key) {
    OFString value;
    static_cast<void>(file_.getDataset()->findAndGetOFStringArray(key, value));
    return QString::fromLatin1(value.c_str());
  }
  [[nodiscard]] bool has(const DcmTagKey& key) { return file_.getDataset()->tagExists(key); }
  [[nodiscard]] DcmItem& item(const DcmTagKey& sequence, long index = 0) {
    DcmItem* found = nullptr;
    if (file_.getDataset()->findAndGetSequenceItem(sequence, found, index).bad()) qFatal("no such item");
    return *found;
  }
  [[nodiscard]] QString meta(const DcmTagKey& key) {
    OFString value;
    static_cast<void>(file_.getMetaInfo()->findAndGetOFString(key, value));
    return QString::fromLatin1(value.c_str());
  }

 private:
  DcmFileFormat file_;
};

QString text_in(DcmItem& item, const DcmTagKey& key) {
  OFString value;
  static_cast<void>(item.findAndGetOFString(key, value));
  return QString::fromLatin1(value.c_str());
}

void put(const fs::path& file, const DcmTagKey& key, const char* value) {
  edit(file, [&](DcmDataset& dataset) { static_cast<void>(dataset.putAndInsertString(key, value)); });
}

}  // namespace

class DeidentifyTest : public QObject {
  Q_OBJECT

  std::unique_ptr<TemporaryFolder> folder_;
  std::vector<fs::path> files_;

  [[nodiscard]] fs::path out() const { return *folder_ / "out"; }

  [[nodiscard]] Result<Deidentified> make(const DeidentifyOptions& options = {}) const {
    auto made = imaging::deidentify(files_, out(), options);
    if (!made) return made;
    if (const Status committed = made->folder.commit(); !committed) return pass_on(committed);
    return made;
  }

 private slots:
  void init() {
    folder_ = std::make_unique<TemporaryFolder>();
    files_ = write_series(sample_volume({7, 5, 3}), *folder_ / "series");
  }

  void voxels_and_geometry_stay() {
    QCOMPARE(failure(make()), QString());
    const imaging::Series series = only_series(out());
    QVERIFY2(series.loadable, series.reason.c_str());
    const auto read = imaging::load_dicom(series);
    QCOMPARE(failure(read), QString());
    verify_same(*read, sample_volume({7, 5, 3}));
  }

  void the_files_say_what_was_done() {
    const auto made = make({.keep_device = true, .shift_dates = true});
    QCOMPARE(failure(made), QString());
    Written file(out() / made->files[0].name);
    QCOMPARE(file.text(DCM_PatientIdentityRemoved), QString("YES"));
    QVERIFY(file.text(DCM_DeidentificationMethod).contains("PS3.15"));
    QCOMPARE(file.text(DCM_LongitudinalTemporalInformationModified), QString("MODIFIED"));
    QStringList codes;
    for (long i = 0; i < 3; ++i) {
      DcmItem& code = file.item(DCM_DeidentificationMethodCodeSequence, i);
      codes += text_in(code, DCM_CodeValue);
      QCOMPARE(text_in(code, DCM_CodingSchemeDesignator), QString("DCM"));
    }
    QCOMPARE(codes, (QStringList{"113100", "113107", "113109"}));
  }

  void the_validator_has_no_objection_data() {
    QTest::addColumn<bool>("shift");
    QTest::newRow("without dates") << false;
    QTest::newRow("with dates") << true;
  }

  void the_validator_has_no_objection() {
    QFETCH(bool, shift);
    const auto made = make({.shift_dates = shift});
    QCOMPARE(failure(made), QString());
    QProcess validator;
    validator.setProcessChannelMode(QProcess::MergedChannels);
    validator.start("dciodvfy", {QString::fromStdString((out() / made->files[0].name).string())});
    QVERIFY2(validator.waitForFinished(), "dciodvfy (package dicom3tools) does not run");
    const QString said = validator.readAll();
    QVERIFY2(said.contains("CT") && !said.contains("Error"), qPrintable(said));
  }

  void uids_are_new_and_the_same_in_all_files() {
    Written old_first(files_[0]);
    for (const fs::path& file : files_) {
      edit(file, [&](DcmDataset& dataset) {
        DcmItem* image = nullptr;
        static_cast<void>(dataset.findOrCreateSequenceItem(DCM_ReferencedImageSequence, image, 0));
        static_cast<void>(image->putAndInsertString(DCM_ReferencedSOPClassUID, UID_CTImageStorage));
        static_cast<void>(image->putAndInsertString(DCM_ReferencedSOPInstanceUID,
                                                    qPrintable(old_first.text(DCM_SOPInstanceUID))));
      });
    }
    const auto made = make();
    QCOMPARE(failure(made), QString());
    Written first(out() / made->files[0].name);
    for (const imaging::DeidentifiedFile& one : made->files) {
      Written old(one.source);
      Written file(out() / one.name);
      for (const DcmTagKey& key : {DCM_StudyInstanceUID, DCM_SeriesInstanceUID, DCM_FrameOfReferenceUID}) {
        QVERIFY(file.text(key) != old.text(key));
        QCOMPARE(file.text(key), first.text(key));
      }
      QVERIFY(file.text(DCM_SOPInstanceUID) != old.text(DCM_SOPInstanceUID));
      QCOMPARE(file.meta(DCM_MediaStorageSOPInstanceUID), file.text(DCM_SOPInstanceUID));
      QCOMPARE(file.text(DCM_SOPClassUID), old.text(DCM_SOPClassUID));
      DcmItem& image = file.item(DCM_ReferencedImageSequence);
      QCOMPARE(text_in(image, DCM_ReferencedSOPInstanceUID), first.text(DCM_SOPInstanceUID));
      QCOMPARE(text_in(image, DCM_ReferencedSOPClassUID), QString(UID_CTImageStorage));
    }
    QCOMPARE(made->uids.at(old_first.text(DCM_SOPInstanceUID).toStdString()),
             first.text(DCM_SOPInstanceUID).toStdString());
  }

  void uids_can_stay() {
    const auto made = make({.keep_uids = true});
    QCOMPARE(failure(made), QString());
    for (const imaging::DeidentifiedFile& one : made->files) {
      QCOMPARE(Written(out() / one.name).text(DCM_SOPInstanceUID),
               Written(one.source).text(DCM_SOPInstanceUID));
    }
  }

  void a_patient_gets_one_new_id_and_another_patient_another() {
    put(files_[2], DCM_PatientID, "SOMEBODY");
    const auto made = make();
    QCOMPARE(failure(made), QString());
    const QString first = Written(out() / made->files[0].name).text(DCM_PatientID);
    QVERIFY(first.startsWith('P') && first != "PHANTOM");
    QCOMPARE(Written(out() / made->files[1].name).text(DCM_PatientID), first);
    QCOMPARE(Written(out() / made->files[1].name).text(DCM_PatientName), first);
    QVERIFY(Written(out() / made->files[2].name).text(DCM_PatientID) != first);
    QCOMPARE(made->patients.size(), std::size_t{2});
  }

  void an_id_that_is_given_is_for_one_patient_alone() {
    const auto made = make({.patient_id = "CASE-7", .patient_name = "Case^Seven"});
    QCOMPARE(failure(made), QString());
    Written file(out() / made->files[0].name);
    QCOMPARE(file.text(DCM_PatientID), QString("CASE-7"));
    QCOMPARE(file.text(DCM_PatientName), QString("Case^Seven"));
    put(files_[2], DCM_PatientID, "SOMEBODY");
    const auto two = make({.patient_id = "CASE-7"});
    QVERIFY(!two && two.error().kind == ErrorKind::usage);
    QVERIFY2(failure(two).contains("more than one patient"), qPrintable(failure(two)));
    for (const char* bad : {"", "  ", "a\\b", "M\xc3\xbcller"}) {
      const auto refused = make({.patient_id = bad});
      QVERIFY(!refused && refused.error().kind == ErrorKind::usage);
    }
  }

  void an_id_is_told_apart_by_its_letters_in_any_character_set() {
    const char* const latin_1 = "M\xfcller";
    put(files_[0], DCM_SpecificCharacterSet, "ISO_IR 100");
    put(files_[0], DCM_PatientID, latin_1);
    put(files_[1], DCM_SpecificCharacterSet, "ISO_IR 192");
    put(files_[1], DCM_PatientID, "Müller");
    put(files_[2], DCM_PatientID, "M\xf6ller");  // of no character set
    const auto made = make();
    QCOMPARE(failure(made), QString());
    QCOMPARE(made->patients.size(), std::size_t{2});
    QVERIFY(made->patients.contains("Müller") && made->patients.contains("Möller"));
    fs::remove_all(out());
    put(files_[2], DCM_PatientID, latin_1);
    QCOMPARE(failure(make({.patient_id = "CASE-7"})), QString());
  }

  void an_id_of_two_issuers_is_of_two_patients() {
    put(files_[0], DCM_IssuerOfPatientID, "Clinic");
    put(files_[2], DCM_IssuerOfPatientID, "Clínica");
    put(files_[2], DCM_SpecificCharacterSet, "ISO_IR 192");
    const auto made = make();
    QCOMPARE(failure(made), QString());
    QCOMPARE(made->patients.size(), std::size_t{2});
    // A file without an issuer, as results often are, is of the patient with its ID.
    const QString first = Written(out() / made->files[0].name).text(DCM_PatientID);
    QCOMPARE(Written(out() / made->files[1].name).text(DCM_PatientID), first);
    QVERIFY(Written(out() / made->files[2].name).text(DCM_PatientID) != first);
    QVERIFY(made->patients.contains("PHANTOM") && made->patients.contains("PHANTOM (Clínica)"));
  }

  void dates_go_or_move_together() {
    for (const fs::path& file : files_) {
      put(file, DCM_StudyDate, "20240301");
      put(file, DCM_AcquisitionDate, "20240302");
      put(file, DCM_StudyTime, "101112");
      put(file, DCM_PatientBirthDate, "19370419");
    }
    const auto without = make();
    QCOMPARE(failure(without), QString());
    Written gone(out() / without->files[0].name);
    QVERIFY(gone.has(DCM_StudyDate) && gone.text(DCM_StudyDate).isEmpty());
    QVERIFY(gone.text(DCM_StudyTime).isEmpty());
    fs::remove_all(out());
    const auto made = make({.shift_dates = true, .shift_days = -2});
    QCOMPARE(failure(made), QString());
    Written moved(out() / made->files[0].name);
    QCOMPARE(moved.text(DCM_StudyDate), QString("20240228"));
    QCOMPARE(moved.text(DCM_AcquisitionDate), QString("20240229"));
    QCOMPARE(moved.text(DCM_StudyTime), QString("101112"));
    QVERIFY(moved.text(DCM_PatientBirthDate).isEmpty());
    fs::remove_all(out());
    const auto random = make({.shift_dates = true});
    QCOMPARE(failure(random), QString());
    const int days = random->patients.begin()->second.days;
    QVERIFY(days < 0 && days >= -3650);
    QCOMPARE(Written(out() / random->files[0].name).text(DCM_StudyDate),
             QDate(2024, 3, 1).addDays(days).toString("yyyyMMdd"));
  }

  void characteristics_stay_on_request_and_high_ages_do_not() {
    for (const fs::path& file : files_) {
      put(file, DCM_PatientSex, "F");
      put(file, DCM_PatientAge, "095Y");
      put(file, DCM_PatientWeight, "61.5");
    }
    put(files_[1], DCM_PatientAge, "089Y");
    const auto without = make();
    QCOMPARE(failure(without), QString());
    Written gone(out() / without->files[0].name);
    QVERIFY(gone.text(DCM_PatientSex).isEmpty() && !gone.has(DCM_PatientAge) && !gone.has(DCM_PatientWeight));
    fs::remove_all(out());
    const auto made = make({.keep_characteristics = true});
    QCOMPARE(failure(made), QString());
    Written kept(out() / made->files[0].name);
    QCOMPARE(kept.text(DCM_PatientSex), QString("F"));
    QCOMPARE(kept.text(DCM_PatientAge), QString("090Y"));
    QCOMPARE(kept.text(DCM_PatientWeight), QString("61.5"));
    QCOMPARE(Written(out() / made->files[1].name).text(DCM_PatientAge), QString("089Y"));
  }

  void texts_of_annotations_become_dummies_and_their_places_stay() {
    edit(files_[0], [](DcmDataset& dataset) {
      DcmItem* graphic = nullptr;
      DcmItem* text = nullptr;
      static_cast<void>(dataset.findOrCreateSequenceItem(DCM_GraphicAnnotationSequence, graphic, 0));
      static_cast<void>(graphic->putAndInsertString(DCM_GraphicLayer, "LAYER"));
      static_cast<void>(graphic->findOrCreateSequenceItem(DCM_TextObjectSequence, text, 0));
      static_cast<void>(text->putAndInsertString(DCM_UnformattedTextValue, "Zaphod"));
    });
    const auto made = make();
    QCOMPARE(failure(made), QString());
    DcmItem* text = nullptr;
    Written file(out() / made->files[0].name);
    DcmItem& graphic = file.item(DCM_GraphicAnnotationSequence);
    QCOMPARE(text_in(graphic, DCM_GraphicLayer), QString("LAYER"));
    QVERIFY(graphic.findAndGetSequenceItem(DCM_TextObjectSequence, text, 0).good());
    QCOMPARE(text_in(*text, DCM_UnformattedTextValue), QString("DUMMY"));
  }

  void risky_images_are_left_out_unless_they_are_wanted_data() {
    QTest::addColumn<QByteArray>("attribute");
    QTest::addColumn<unsigned>("tag");
    QTest::addColumn<QByteArray>("value");
    const auto row = [](const char* attribute, unsigned tag, const char* value) {
      QTest::newRow(attribute) << QByteArray(attribute) << tag << QByteArray(value);
    };
    row("BurnedInAnnotation (0028,0301)", 0x00280301U, "YES");
    row("RecognizableVisualFeatures (0028,0302)", 0x00280302U, "YES");
    row("SpecimenLabelInImage (0048,0010)", 0x00480010U, "YES");
    row("SOPClassUID (0008,0016)", 0x00080016U, UID_MultiframeGrayscaleByteSecondaryCaptureImageStorage);
    row("ConversionType (0008,0064)", 0x00080064U, "WSD");
    row("ImageType (0008,0008)", 0x00080008U, "DERIVED\\SECONDARY\\SCREEN SAVE");
  }

  void risky_images_are_left_out_unless_they_are_wanted() {
    QFETCH(QByteArray, attribute);
    QFETCH(unsigned, tag);
    QFETCH(QByteArray, value);
    put(files_[1], DcmTagKey(static_cast<Uint16>(tag >> 16), static_cast<Uint16>(tag & 0xffff)), value);
    const auto made = make();
    QCOMPARE(failure(made), QString());
    QCOMPARE(made->files.size(), std::size_t{2});
    QCOMPARE(made->left_out.size(), std::size_t{1});
    QCOMPARE(made->left_out[0].file, files_[1]);
    QCOMPARE(made->left_out[0].kind, Kind::risky);
    QVERIFY2(made->left_out[0].reason.starts_with(attribute.toStdString()), made->left_out[0].reason.c_str());
    fs::remove_all(out());
    const auto all = make({.with_risky_images = true});
    QCOMPARE(failure(all), QString());
    QCOMPARE(all->files.size(), std::size_t{3});
    QVERIFY(all->files[0].risk.empty() && !all->files[1].risk.empty());
  }

  void ultrasound_must_deny_burned_in_text() {
    for (const fs::path& file : files_) {
      put(file, DCM_SOPClassUID, UID_UltrasoundImageStorage);
      set_text(file, 0x0028, 0x0301, "");
    }
    put(files_[0], DCM_BurnedInAnnotation, "NO");
    const auto made = make();
    QCOMPARE(failure(made), QString());
    QCOMPARE(made->files.size(), std::size_t{1});
  }

  void photographs_must_deny_text_and_face_data() {
    QTest::addColumn<QByteArray>("sop_class");
    QTest::addColumn<std::size_t>("kept");
    QTest::newRow("of a part of the body") << QByteArray(UID_VLPhotographicImageStorage) << std::size_t{1};
    QTest::newRow("endoscopy, moving") << QByteArray(UID_VideoEndoscopicImageStorage) << std::size_t{1};
    QTest::newRow("any, by a class of old") << QByteArray(UID_RETIRED_VLImageStorage) << std::size_t{1};
    QTest::newRow("of an eye") << QByteArray(UID_OphthalmicPhotography8BitImageStorage) << std::size_t{3};
    QTest::newRow("of tissue") << QByteArray(UID_VLWholeSlideMicroscopyImageStorage) << std::size_t{3};
  }

  void photographs_must_deny_text_and_face() {
    QFETCH(QByteArray, sop_class);
    QFETCH(std::size_t, kept);
    for (const fs::path& file : files_) {
      put(file, DCM_SOPClassUID, sop_class);
      set_text(file, 0x0028, 0x0301, "");
    }
    put(files_[0], DCM_BurnedInAnnotation, "NO");
    put(files_[0], DCM_RecognizableVisualFeatures, "NO");
    put(files_[1], DCM_BurnedInAnnotation, "NO");
    const auto made = make();
    QCOMPARE(failure(made), QString());
    QCOMPARE(made->files.size(), kept);
    QCOMPARE(made->files[0].source, files_[0]);
  }

  void documents_and_other_files_are_left_out() {
    put(files_[0], DCM_SOPClassUID, UID_BasicTextSRStorage);
    put(files_[1], DCM_SOPClassUID, UID_EncapsulatedPDFStorage);
    const fs::path words = *folder_ / "series/words.txt";
    QVERIFY(write_file(words, "no DICOM"));
    files_.push_back(words);
    const auto made = make({.with_risky_images = true});
    QCOMPARE(failure(made), QString());
    QCOMPARE(made->files.size(), std::size_t{1});
    QCOMPARE(made->left_out.size(), std::size_t{3});
    QCOMPARE(made->left_out[0].kind, Kind::document);
    QVERIFY(made->left_out[0].reason.find("BasicTextSR") != std::string::npos);
    QCOMPARE(made->left_out[1].kind, Kind::document);
    QCOMPARE(made->left_out[2].kind, Kind::not_dicom);
  }

  void damaged_files_are_left_out_before_a_parser_sees_them() {
    truncate(files_[1], 700);
    const auto made = make();
    QCOMPARE(failure(made), QString());
    QCOMPARE(made->files.size(), std::size_t{2});
    QCOMPARE(made->left_out[0].kind, Kind::unreadable);
  }

  void nothing_left_is_an_error_and_no_folder() {
    for (const fs::path& file : files_) put(file, DCM_BurnedInAnnotation, "YES");
    const auto made = make();
    QVERIFY(!made && made.error().kind == ErrorKind::input);
    QVERIFY2(failure(made).contains("BurnedInAnnotation"), qPrintable(failure(made)));
    QVERIFY(!fs::exists(out()));
  }

  void a_stop_leaves_nothing() {
    std::stop_source stop;
    int done = 0;
    const Progress progress{[&](double, std::string_view) {
                              if (++done == 2) stop.request_stop();
                            },
                            stop.get_token()};
    const auto made = imaging::deidentify(files_, out(), {}, progress);
    QVERIFY(!made && made.error().kind == ErrorKind::cancelled);
    QCOMPARE(done, 2);
    for (const auto& entry : fs::directory_iterator(folder_->path())) {
      QCOMPARE(entry.path().filename().string(), std::string("series"));
    }
  }

  void compressed_pixels_stay_as_they_are() {
    register_encoders();
    for (const fs::path& file : files_) QVERIFY(recode(file, EXS_JPEGProcess14SV1, true));
    const auto made = make();
    QCOMPARE(failure(made), QString());
    QCOMPARE(Written(out() / made->files[0].name).meta(DCM_TransferSyntaxUID),
             QString(UID_JPEGProcess14SV1TransferSyntax));
    const auto read = imaging::load_dicom(only_series(out()));
    QCOMPARE(failure(read), QString());
    verify_same(*read, sample_volume({7, 5, 3}));
  }

  void other_encodings_stay_data() {
    QTest::addColumn<int>("syntax");
    QTest::newRow("implicit") << int{EXS_LittleEndianImplicit};
    QTest::newRow("big endian") << int{EXS_BigEndianExplicit};
    QTest::newRow("deflated") << int{EXS_DeflatedLittleEndianExplicit};
  }

  void other_encodings_stay() {
    QFETCH(int, syntax);
    for (const fs::path& file : files_) QVERIFY(recode(file, static_cast<E_TransferSyntax>(syntax), true));
    const auto made = make();
    QCOMPARE(failure(made), QString());
    const bool is_inflated = syntax == EXS_DeflatedLittleEndianExplicit;
    QCOMPARE(Written(out() / made->files[0].name).meta(DCM_TransferSyntaxUID),
             is_inflated ? QString(UID_LittleEndianExplicitTransferSyntax)
                         : Written(files_[0]).meta(DCM_TransferSyntaxUID));
    const auto read = imaging::load_dicom(only_series(out()));
    QCOMPARE(failure(read), QString());
    verify_same(*read, sample_volume({7, 5, 3}));
  }

  void frames_of_one_file_stay_a_volume() {
    const Volume volume = sample_volume({6, 5, 4});
    files_ = {*folder_ / "enhanced.dcm"};
    write_enhanced(frames_of(volume), files_[0]);
    QCOMPARE(failure(make()), QString());
    const auto read = imaging::load_dicom(only_series(out()));
    QCOMPARE(failure(read), QString());
    verify_same(*read, volume);
  }
};

TIDEMARK_TEST(DeidentifyTest)

}  // namespace tidemark::test::deidentify_test

#include "deidentify_test.moc"
