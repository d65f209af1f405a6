// Further images of a case: found, shown over the slices, read under the mouse, and taken out again.
#include <QCheckBox>
#include <QFileDialog>
#include <QListWidget>
#include <QPushButton>
#include <QToolButton>
#include <cmath>

#include "imaging/files/volume_file.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/image_adder.h"
#include "ui/main/message_bar.h"
#include "ui/main/value_bar.h"
#include "ui/widgets/number_box.h"

namespace tidemark::test::images_story_test {

namespace {

constexpr int kPatience = 60000;

// A ball in a box, in values from 0 to 100 times `bright`.
Volume ball_in_a_box(Index3 size, glm::dvec3 spacing_mm, glm::dvec3 middle_mm, float bright) {
  Volume volume;
  volume.geometry.size = size;
  volume.geometry.spacing_mm = spacing_mm;
  volume.geometry.origin_mm = middle_mm - 0.5 * glm::dvec3(size - Index3(1)) * spacing_mm;
  std::vector<float> values;
  for (std::int64_t k = 0; k < size.z; ++k) {
    for (std::int64_t j = 0; j < size.y; ++j) {
      for (std::int64_t i = 0; i < size.x; ++i) {
        const glm::dvec3 place = volume.geometry.to_patient(glm::dvec3(i, j, k));
        values.push_back(glm::length(place - middle_mm) < 20.0 ? 100.0F * bright : 10.0F * bright);
      }
    }
  }
  volume.voxels = std::move(values);
  return volume;
}

}  // namespace

class ImagesStoryTest : public QObject {
  Q_OBJECT

  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;

  QString made(const char* name, const Volume& volume) {
    const auto file = folder_ / name;
    [[maybe_unused]] const Status written = imaging::write_volume_file(volume, file);
    return QString::fromStdString(file.string());
  }
  // By the menu's action and its dialog.
  void choose_image(const QString& file) {
    desktop_->window().actions().add_image->trigger();
    auto* dialog = desktop_->window().findChild<QFileDialog*>();
    QVERIFY(dialog);
    name_file(*dialog, file);
  }
  void add_image(const QString& file) {
    const std::size_t before = images().size();
    choose_image(file);
    QVERIFY(Desktop::wait_for([&] { return images().size() > before; }, kPatience));
    desktop_->wait_until_idle();
  }
  const std::vector<engine::ShownImage>& images() { return desktop_->proxy().display().settings().images; }
  ui::SliceViewWidget* axial() { return desktop_->view<ui::SliceViewWidget>("Axial"); }
  QImage picture() {
    desktop_->wait_until_idle();
    return axial()->grab_picture();
  }
  QString values_at(glm::dvec3 place) {
    const QPoint at = axial()->position_of(place).toPoint();
    if (!Desktop::hover(*axial(), at)) return {};
    return desktop_->window().findChild<ui::ValueBar*>()->text();
  }
 private slots:
  void an_image_is_shown_over_the_slices_and_taken_out() {
    desktop_ = std::make_unique<Desktop>(story_executor());
    const glm::dvec3 middle(0.0);
    QVERIFY(desktop_->open(made("ct.nii.gz", ball_in_a_box({80, 80, 60}, glm::dvec3(1.0), middle, 1.0F))));
    QVERIFY(axial());
    const QImage before = picture();
    // Coarser voxels, and only a part of the study.
    add_image(made("pet.nii.gz", ball_in_a_box({14, 14, 14}, glm::dvec3(4.0), middle, 0.05F)));
    const auto* told = desktop_->window().findChild<ui::MessageBar*>();
    QVERIFY2(told->text().startsWith("It is not known whether pet.nii.gz has the study's frame of reference"),
             qPrintable(told->text()));
    QVERIFY(find_text(desktop_->window(), "Its place is not sure: no common frame of reference is known."));
    // The message makes the view lower while it is there.
    for (auto* button : desktop_->window().findChildren<QPushButton*>()) {
      if (button->text().remove('&') == "Dismiss" && button->isVisible())
        QTest::mouseClick(button, Qt::LeftButton);
    }
    QVERIFY(Desktop::wait_for([&] {
      return axial()->physical_size() == renderer::PictureSize{static_cast<std::int64_t>(before.width()),
                                                               static_cast<std::int64_t>(before.height())};
    }));
    const QImage half = picture();
    QVERIFY2(difference(before, half) > 0.05, qPrintable(QString::number(difference(before, half))));
    desktop_->screenshot("images-1-added");
    QVERIFY2(values_at(middle).contains("   pet.nii.gz 5   "), qPrintable(values_at(middle)));
    QVERIFY(values_at({-35.0, 0.0, 0.0}).contains(QStringLiteral("–")));

    // Opacity by the keyboard.
    auto* opacity = find_seen<ui::NumberBox>(desktop_->window(), "Image opacity");
    QVERIFY(opacity);
    opacity->setFocus();
    opacity->selectAll();
    QTest::keyClicks(opacity, "100");
    QTest::keyClick(opacity, Qt::Key_Return);
    QCOMPARE(images()[0].opacity, 1.0);
    const QImage full = picture();
    QVERIFY(difference(half, full) > 0.02);

    // Hidden by a click on its check mark: the picture is as it was.
    auto* list = find_seen<QListWidget>(desktop_->window(), "Images over the slices");
    QVERIFY(list);
    const QRect row = list->visualItemRect(list->item(0));
    QTest::mouseClick(list->viewport(), Qt::LeftButton, {}, {row.left() + 10, row.center().y()});
    QVERIFY(!images()[0].visible);
    QVERIFY(difference(before, picture()) < 0.01);

    auto* remove = find_seen<QToolButton>(desktop_->window(), "Remove image");
    QVERIFY(remove);
    QTest::mouseClick(remove, Qt::LeftButton);
    QVERIFY(images().empty());
    QVERIFY(!list->isVisible());
    QVERIFY(!values_at(middle).contains("pet"));
  }

  void a_swipe_line_parts_the_study_and_its_images() {
    desktop_ = std::make_unique<Desktop>(story_executor());
    QVERIFY(desktop_->open(made("ct.nii.gz", ball_in_a_box({80, 80, 60}, glm::dvec3(1.0), {}, 1.0F))));
    add_image(made("pet.nii.gz", ball_in_a_box({30, 30, 30}, glm::dvec3(3.0), {}, 0.05F)));
    const auto show = [&](bool visible) {
      desktop_->proxy().display().change([=](engine::DisplaySettings& s) {
        s.crosshair = false;
        s.images[0].visible = visible;
      });
      return picture();
    };
    const QImage alone = show(false);
    const QImage fused = show(true);
    QVERIFY2(difference(alone, fused) > 0.02, qPrintable(QString::number(difference(alone, fused))));

    // The line is in the middle at first.
    desktop_->press(Qt::Key_V);
    QVERIFY(desktop_->proxy().display().settings().swipe);
    const auto part = [](const QImage& image, double from, double to) {
      const auto left = qRound(from * image.width());
      return image.copy(left, 0, qRound(to * image.width()) - left, image.height());
    };
    const QImage middle = picture();
    QVERIFY(difference(part(middle, 0.0, 0.47), part(alone, 0.0, 0.47)) < 0.001);
    QVERIFY(difference(part(middle, 0.53, 1.0), part(fused, 0.53, 1.0)) < 0.001);
    desktop_->screenshot("images-2-swipe");

    // Dragged to the right, with a tool that would do something else there.
    desktop_->press(Qt::Key_B);
    const int y = axial()->height() / 3;
    const int x = axial()->width() / 2;
    QVERIFY(Desktop::hover(*axial(), {x, y}));
    QVERIFY(axial()->cursor().shape() == Qt::SplitHCursor);
    Desktop::drag(*axial(), {QPoint(x, y), QPoint(x + x / 4, y), QPoint(x + x / 2, y)});
    QVERIFY(Desktop::hover(*axial(), {x / 4, y}));
    QVERIFY(axial()->cursor().shape() != Qt::SplitHCursor);
    QVERIFY(std::abs(desktop_->proxy().display().settings().swipe_at - 0.75) < 0.01);
    QVERIFY(!desktop_->state().begun);  // nothing was painted
    desktop_->press(Qt::Key_W);
    QVERIFY(Desktop::hover(*axial(), {2, 2}));
    const QImage right = picture();
    QVERIFY(difference(part(right, 0.0, 0.72), part(alone, 0.0, 0.72)) < 0.001);
    QVERIFY(difference(part(right, 0.78, 1.0), part(fused, 0.78, 1.0)) < 0.001);

    // Off by the panel.
    auto* swipe = find_seen<QCheckBox>(desktop_->window(), "Swipe line");
    QVERIFY(swipe && swipe->isChecked());
    QTest::mouseClick(swipe, Qt::LeftButton, {}, {8, swipe->height() / 2});
    QVERIFY(difference(picture(), fused) < 0.001);
  }

  void outlines_stand_above_images() {
    desktop_ = std::make_unique<Desktop>(story_executor());
    QVERIFY(desktop_->open(made("ct.nii.gz", ball_in_a_box({60, 60, 60}, glm::dvec3(1.0), {}, 1.0F))));
    desktop_->proxy().paint({glm::dvec3(0.0), 15.0}, solver::Brush::add, engine::CaseProxy::new_gesture());
    desktop_->wait_until_idle();
    const auto yellow = [](const QImage& image) {
      int count = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          const QColor colour = image.pixelColor(x, y);
          count += colour.red() > 200 && colour.green() > 180 && colour.blue() < 120 ? 1 : 0;
        }
      }
      return count;
    };
    const int before = yellow(picture());
    QVERIFY2(before > 200, qPrintable(QString::number(before)));
    add_image(made("grey.nii.gz", ball_in_a_box({30, 30, 30}, glm::dvec3(3.0), {}, 0.05F)));
    desktop_->proxy().display().change([](engine::DisplaySettings& s) {
      s.images[0].colours = engine::ImageColours::grey;
      s.images[0].opacity = 1.0;
    });
    desktop_->screenshot("images-3-outline");
    // The message makes the view a little lower.
    QVERIFY2(yellow(picture()) > before * 7 / 10, qPrintable(QString::number(yellow(picture()))));
  }

  // All are asked for before the first one has been read.
  void images_go_to_the_cases_for_which_they_were_chosen() {
    desktop_ = std::make_unique<Desktop>(story_executor());
    ui::CaseWindow* first =
        desktop_->open(made("a.nii.gz", ball_in_a_box({40, 40, 40}, glm::dvec3(1.0), {}, 1.0F)));
    ui::CaseWindow* second =
        desktop_->open(made("b.nii.gz", ball_in_a_box({40, 40, 40}, glm::dvec3(1.0), {}, 1.0F)));
    QVERIFY(first && second);
    const auto image = [&](const char* name) {
      return made(name, ball_in_a_box({20, 20, 20}, glm::dvec3(2.0), {}, 1.0F));
    };
    const QStringList files{image("pet.nii.gz"), image("t1.nii.gz"), image("t2.nii.gz")};
    ui::ImageAdder& adder = desktop_->window().images();
    adder.add_file(*first, files[0]);
    adder.add_file(*second, files[1]);
    adder.add_file(*first, files[2]);
    const auto names = [](ui::CaseWindow& window) {
      QStringList all;
      for (const engine::ShownImage& shown : window.proxy().display().settings().images)
        all << QString::fromStdString(shown.image->name);
      all.sort();
      return all;
    };
    QVERIFY(Desktop::wait_for([&] { return names(*first).size() == 2 && names(*second).size() == 1; },
                              kPatience));
    QVERIFY2(names(*second).front().startsWith("t1"), qPrintable(names(*second).join(' ')));
    QVERIFY2(names(*first)[0].startsWith("pet") && names(*first)[1].startsWith("t2"),
             qPrintable(names(*first).join(' ')));
  }

  void an_image_is_something_to_save() {
    desktop_ = std::make_unique<Desktop>(story_executor());
    ui::CaseWindow* window =
        desktop_->open(made("ct.nii.gz", ball_in_a_box({40, 40, 40}, glm::dvec3(1.0), {}, 1.0F)));
    QVERIFY(window);
    const auto modified = [&] { return desktop_->state().modified && window->isWindowModified(); };
    desktop_->wait_until_idle();
    QVERIFY(!modified());
    add_image(made("pet.nii.gz", ball_in_a_box({20, 20, 20}, glm::dvec3(2.0), {}, 1.0F)));
    QVERIFY(modified());
    const auto save = [&] {
      desktop_->press(Qt::Key_S, Qt::ControlModifier);
      QVERIFY(Desktop::wait_for([&] { return !modified(); }, kPatience));
    };
    window->session_file = QString::fromStdString((folder_ / "with-pet.tidemark").string());
    save();
    // A registration that is accepted moves it.
    desktop_->proxy().display().change([](engine::DisplaySettings& settings) {
      auto moved = std::make_shared<document::CaseImage>(*settings.images[0].image);
      moved->to_case[3].x = 2.0;
      settings.images[0].image = moved;
    });
    QVERIFY(modified());
    save();
    desktop_->press(Qt::Key_W, Qt::ControlModifier);
    QVERIFY(Desktop::wait_for([&] { return desktop_->window().cases().isEmpty(); }));
    QVERIFY(desktop_->open(QString::fromStdString((folder_ / "with-pet.tidemark").string())));
    QVERIFY(
        Desktop::wait_for([&] { return images().size() == 1 && images().front().image->volume; }, kPatience));
    desktop_->wait_until_idle();
    QVERIFY(!desktop_->state().modified);
  }

  void a_thin_slice_of_a_long_study_is_added() {
    desktop_ = std::make_unique<Desktop>(story_executor());
    QVERIFY(desktop_->open(made("ct.nii.gz", ball_in_a_box({8, 8, 1000}, glm::dvec3(1.0), {}, 1.0F))));
    // At the study's voxel 20 along z.
    add_image(made("slice.nii.gz", ball_in_a_box({60, 60, 1}, {1.0, 1.0, 3.0}, {0.0, 0.0, -479.5}, 1.0F)));
    QCOMPARE(images().size(), std::size_t{1});
  }

  void an_image_elsewhere_in_the_patient_is_refused() {
    desktop_ = std::make_unique<Desktop>(story_executor());
    QVERIFY(desktop_->open(made("ct.nii.gz", ball_in_a_box({40, 40, 40}, glm::dvec3(1.0), {}, 1.0F))));
    choose_image(made("far.nii.gz", ball_in_a_box({20, 20, 20}, glm::dvec3(1.0), {500.0, 0.0, 0.0}, 1.0F)));
    const auto told = [&] {
      for (const auto* label : desktop_->window().findChildren<QLabel*>()) {
        if (label->isVisible() && label->text().contains("lies elsewhere in the patient")) return true;
      }
      return false;
    };
    QVERIFY(Desktop::wait_for(told, kPatience));
    QVERIFY(images().empty());
  }
};

TIDEMARK_TEST(ImagesStoryTest)

}  // namespace tidemark::test::images_story_test

#include "images_story_test.moc"
