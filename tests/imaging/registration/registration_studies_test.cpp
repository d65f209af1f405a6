// Rigid registration of real studies.
#include <QElapsedTimer>

#include "imaging/load_study.h"
#include "imaging/resample.h"
#include "tests/imaging/registration/turned.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::registration_studies_test {

class RegistrationStudiesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_turned_and_shifted_head_comes_back() {
    const auto head = imaging::load_volume(test::studies_folder() / "v01_head_mr_brain_skull/MR.nii.gz");
    QCOMPARE(test::failure(head), QString());
    const glm::dmat4 transform = test::turned(head->geometry, 8.0, 12.0);
    const auto turned = imaging::resample(*head, transform, head->geometry, "head");
    QCOMPARE(test::failure(turned), QString());
    QElapsedTimer timer;
    timer.start();
    const auto found = imaging::register_rigidly(turned->volume, *head);
    QCOMPARE(test::failure(found), QString());
    const imaging::Registration miss = test::miss(*found, transform, head->geometry);
    qInfo("%.2f s; off by %.3f degrees, %.3f mm", static_cast<double>(timer.elapsed()) / 1000.0,
          miss.rotation_degrees, glm::length(miss.translation_mm));
    QVERIFY(miss.rotation_degrees < 0.5);
    QVERIFY(glm::length(miss.translation_mm) < 0.5);
  }

  // Three scanners, one patient, in one frame already, as contours of one tumour in each image tell. A
  // registration stays there, within what cropped images of thick slices tell: a voxel of the PET.
  void images_of_other_scanners_stay_in_place_data() {
    QTest::addColumn<QString>("image");
    QTest::newRow("T1 on CT") << "MR_T1";
    QTest::newRow("PET on CT") << "PET";
  }
  void images_of_other_scanners_stay_in_place() {
    QFETCH(QString, image);
    const auto folder = test::studies_folder() / "v10_sarcoma_pet_ct_mr";
    const auto file = [&](const char* kind) { return folder / (image.toStdString() + kind); };
    const auto ct = imaging::load_volume(folder / "CT_image.nii.gz");
    const auto ct_tumour = imaging::load_mask(folder / "CT_mask.nii.gz");
    const auto other = imaging::load_volume(file("_image.nii.gz"));
    const auto tumour = imaging::load_volume(file("_mask.nii.gz"));
    QVERIFY(ct && ct_tumour && other && tumour);
    const auto found = imaging::register_rigidly(*other, *ct);
    QCOMPARE(test::failure(found), QString());
    QVERIFY(found->information_before);
    QVERIFY(found->information_after >= *found->information_before);
    const auto placed = imaging::resample(*tumour, found->to_fixed, ct->geometry, "tumour");
    QCOMPARE(test::failure(placed), QString());
    Mask mask{ct->geometry, {}};
    for (const float value : placed->volume.values()) mask.voxels.push_back(value > 0.5F ? 1 : 0);
    const double overlap = dice(mask, *ct_tumour);
    qInfo("%.2f degrees, %.2f mm; Dice of the tumours %.3f", found->rotation_degrees,
          glm::length(found->translation_mm), overlap);
    QVERIFY(overlap > 0.8);
  }
};

TIDEMARK_STUDY_TEST(RegistrationStudiesTest)

}  // namespace tidemark::test::registration_studies_test

#include "registration_studies_test.moc"
