// PET over CT of one patient, from real files.
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QPushButton>
#include <QToolButton>

#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/value_bar.h"
#include "ui/panels/registration_dialog.h"

namespace tidemark::test::fusion_story_test {

class FusionStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void pet_over_ct_is_seen_read_and_registered() {
    constexpr int kPatience = 60000;
    const auto file = [](const char* name) {
      return QString::fromStdString((studies_folder() / "v10_sarcoma_pet_ct_mr" / name).string());
    };
    Desktop desktop(story_executor());
    QVERIFY(desktop.open(file("CT_image.nii.gz")));
    auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
    QVERIFY(axial);
    // A voxel of the tumour.
    const Geometry& grid = desktop.proxy().volume().geometry;
    const glm::dvec3 tumour = grid.to_patient({81.0, 86.0, 27.0});
    desktop.proxy().display().change([&](engine::DisplaySettings& s) {
      s.cursor_mm = tumour;
      s.window = {40.0, 400.0};
    });
    desktop.wait_until_idle();
    const QImage ct = axial->grab_picture();
    const auto& images = desktop.proxy().display().settings().images;

    desktop.window().actions().add_image->trigger();
    auto* dialog = desktop.window().findChild<QFileDialog*>();
    QVERIFY(dialog);
    name_file(*dialog, file("PET_image.nii.gz"));
    QVERIFY(Desktop::wait_for([&] { return images.size() == 1; }, kPatience));
    desktop.wait_until_idle();
    QVERIFY(difference(ct, axial->grab_picture()) > 0.05);
    QVERIFY(Desktop::hover(*axial, axial->position_of(tumour).toPoint()));
    const QString values = desktop.window().findChild<ui::ValueBar*>()->text();
    QVERIFY2(values.contains("PET_image"), qPrintable(values));
    desktop.screenshot("fusion-1-pet-over-ct");

    QToolButton* registering = nullptr;
    for (auto* button : desktop.window().findChildren<QToolButton*>()) {
      if (button->accessibleName() == "Register image" && button->isVisible()) registering = button;
    }
    QVERIFY(registering);
    QTest::mouseClick(registering, Qt::LeftButton);
    QPointer<ui::RegistrationDialog> asked = desktop.window().findChild<ui::RegistrationDialog*>();
    QVERIFY(asked);
    QPushButton* accept = nullptr;
    for (auto* button : asked->findChildren<QPushButton*>()) {
      if (button->text() == "&Accept") accept = button;
    }
    QVERIFY(accept);
    QVERIFY(Desktop::wait_for([&] { return accept->isEnabled(); }, kPatience));
    // Nothing is accepted before it can be seen.
    int pictures = 0;
    for (auto* widget : asked->findChildren<QWidget*>()) {
      if (!widget->isVisible() || widget->children().size() > 0 || widget->width() < 600) continue;
      if (widget->height() != 200) continue;
      const QImage picture = widget->grab().toImage();
      QImage black(picture.size(), QImage::Format_RGB32);
      black.fill(Qt::black);
      QVERIFY(difference(picture, black) > 0.05);
      ++pictures;
    }
    QCOMPARE(pictures, 2);
    desktop.screenshot_at_once("fusion-2-registered");
    QVERIFY(images[0].image->to_case == glm::dmat4(1.0));
    QTest::mouseClick(accept, Qt::LeftButton);
    QVERIFY(Desktop::wait_for([&] { return asked.isNull(); }, kPatience));
    QVERIFY(images[0].image->to_case != glm::dmat4(1.0));
    desktop.wait_until_idle();
    desktop.screenshot("fusion-3-accepted");
  }
};

TIDEMARK_STUDY_TEST(FusionStoryTest)

}  // namespace tidemark::test::fusion_story_test

#include "fusion_story_test.moc"
