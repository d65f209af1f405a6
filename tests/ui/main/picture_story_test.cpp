// A picture on the desktop: opened like any study, one slice alone, and a disc in it found.
#include <QLabel>
#include <fstream>
#include <glm/geometric.hpp>
#include <numbers>

#include "imaging/load_study.h"
#include "tests/imaging/files/pictures.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/case_exports.h"
#include "ui/main/case_window.h"
#include "ui/settings.h"

namespace tidemark::test::picture_story_test {

namespace {

constexpr std::uint32_t kColumns = 240;
constexpr std::uint32_t kRows = 180;
constexpr double kSpacing = 0.5;  // mm
const glm::dvec2 kCentre(118.0, 92.0);
constexpr double kRadius = 48.0;  // pixels

bool is_inside(std::uint32_t x, std::uint32_t y) {
  return glm::distance(glm::dvec2(x, y), kCentre) <= kRadius;
}

// A bright disc on grey, both with some texture.
std::string disc() {
  std::string rows;
  for (std::uint32_t y = 0; y < kRows; ++y) {
    for (std::uint32_t x = 0; x < kColumns; ++x) {
      const auto texture = (x * 7 + y * 13) % 9;
      rows += static_cast<char>((is_inside(x, y) ? 180 : 60) + texture);
    }
  }
  const std::string density = big(2000) + big(2000) + "\1";  // pixels a metre
  return Png{.columns = kColumns, .rows = kRows, .before = png_chunk("pHYs", density)}.with(rows);
}

}  // namespace

class PictureStoryTest : public QObject {
  Q_OBJECT

  TemporaryFolder folder_;

  QString written(const char* name, const std::string& bytes) {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return QString::fromStdString((folder_ / name).string());
  }

 private slots:
  void a_bright_disc_is_found() {
    Desktop desktop(story_executor(), {1366, 768});
    ui::settings::layout().set(ui::ViewLayout::two_two);
    ui::CaseWindow* window = desktop.open(written("cells.png", disc()));
    QVERIFY(window);
    // The other planes would be lines. The next study has the layout that was chosen.
    QCOMPARE(window->views().size(), qsizetype{1});
    auto* slice = desktop.view<ui::SliceViewWidget>("Axial");
    QVERIFY(slice);
    QVERIFY(ui::settings::layout().get() == ui::ViewLayout::two_two);
    QVERIFY(shows_a_picture(*slice));
    QVERIFY(!desktop.proxy().volume().geometry.oriented);
    desktop.screenshot("picture-1-opened");

    const glm::dvec3 centre = desktop.proxy().volume().geometry.to_patient({kCentre, 0.0});
    desktop.window().actions().tool(engine::Tool::seed)->trigger();
    QTest::mouseClick(slice, Qt::LeftButton, {}, slice->position_of(centre).toPoint());
    QVERIFY(Desktop::wait_for([&] { return desktop.state().begun; }));
    desktop.wait_until_idle();
    desktop.screenshot("picture-2-placed");
    desktop.press(Qt::Key_P);
    QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 0 && !desktop.state().playing; }, 120000));
    desktop.wait_until_idle();
    desktop.screenshot("picture-3-converged");
    QVERIFY(desktop.state().converged);

    const double area = std::numbers::pi * kRadius * kRadius * kSpacing * kSpacing;
    const double found = desktop.state().surface.volume_ml * 1000.0;  // 1 mm thick
    QVERIFY2(std::abs(found / area - 1.0) < 0.02, qPrintable(QString("%1 mm2 of %2").arg(found).arg(area)));

    const std::string file = (folder_ / "cells.nii.gz").string();
    desktop.window().exports().write_mask(*window, QString::fromStdString(file));
    QVERIFY(Desktop::wait_for([&] { return std::filesystem::exists(file); }));
    desktop.wait_until_idle();
    const auto mask = imaging::load_mask(file);
    QCOMPARE(failure(mask), QString());
    Mask truth;
    truth.geometry = mask->geometry;
    for (std::uint32_t y = 0; y < kRows; ++y) {
      for (std::uint32_t x = 0; x < kColumns; ++x) truth.voxels.push_back(is_inside(x, y) ? 1 : 0);
    }
    QVERIFY2(dice(*mask, truth) > 0.99, qPrintable(QString::number(dice(*mask, truth))));

    // Every layout and every kind of view can be asked for all the same.
    for (const auto layout : {ui::ViewLayout::paper, ui::ViewLayout::two_two, ui::ViewLayout::one_three}) {
      window->set_layout(layout);
      desktop.wait_until_idle();
      desktop.screenshot(QStringLiteral("picture-4-layout-%1").arg(static_cast<int>(layout)));
    }
    QVERIFY(desktop.view<ui::VolumeViewWidget>());
  }

  void a_bad_picture_is_refused_in_a_sentence_data() {
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<QString>("reason");
    const std::string whole = disc();
    QTest::newRow("cut off") << QByteArray::fromStdString(whole.substr(0, whole.size() / 2)) << "truncated";
    QTest::newRow("of 100000 x 100000")
        << QByteArray::fromStdString(Png{.columns = 100000, .rows = 100000}.header() + png_chunk("IDAT", "x"))
        << "IHDR: 100000 x 100000 pixels are more than";
    QTest::newRow("text") << QByteArray("Dear colleague,\n") << "not a PNG file";
  }

  void a_bad_picture_is_refused_in_a_sentence() {
    QFETCH(QByteArray, bytes);
    QFETCH(QString, reason);
    Desktop desktop(solver::ExecutorKind::host, {1100, 700});
    const QString path = written("bad.png", bytes.toStdString());
    desktop.window().open(path);
    const auto is_said = [&] {
      const auto labels = desktop.window().findChildren<QLabel*>();
      return std::any_of(labels.begin(), labels.end(), [&](const QLabel* label) {
        return label->isVisible() && label->text().contains("bad.png") && label->text().contains(reason);
      });
    };
    QVERIFY(Desktop::wait_for(is_said));
    desktop.screenshot(
        QStringLiteral("picture-5-%1").arg(QString(QTest::currentDataTag()).replace(' ', '-')));
    QVERIFY(desktop.window().active_case() == nullptr);
  }
};

TIDEMARK_TEST(PictureStoryTest)

}  // namespace tidemark::test::picture_story_test

#include "picture_story_test.moc"
