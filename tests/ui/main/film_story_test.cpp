// A film of the evolution in the active view, one that is given up, and one too many.
#include <QImageReader>
#include <QPushButton>
#include <QStatusBar>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/case_files.h"
#include "ui/main/film_writer.h"
#include "ui/main/message_bar.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::test::film_story_test {
namespace {

constexpr int kPatience = 120'000;  // ms

std::vector<QImage> pictures_of(const QString& file) {
  QImageReader reader(file, "gif");
  std::vector<QImage> pictures;
  for (QImage picture = reader.read(); !picture.isNull(); picture = reader.read()) {
    pictures.push_back(picture.convertToFormat(QImage::Format_RGB32));
  }
  return pictures;
}

qint64 yellow_pixels(const QImage& picture) {
  qint64 count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const QRgb pixel = picture.pixel(x, y);
      if (qRed(pixel) > 150 && qGreen(pixel) > 120 && qBlue(pixel) < 100) ++count;
    }
  }
  return count;
}

}  // namespace

class FilmStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void the_surface_grows_in_the_active_view() {
    Desktop desktop(story_executor(), {900, 620});
    QVERIFY(desktop.open_phantom("sphere"));
    desktop.begin(6.0);
    desktop.wait_until_idle();
    auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
    QVERIFY(axial);
    QTest::mouseClick(axial, Qt::LeftButton, {}, QPoint(8, 8));

    // Before the first step there is nothing to film.
    const TemporaryFolder folder;
    const QString file = QString::fromStdString((folder / "growth.gif").string());
    auto* bar = desktop.window().findChild<ui::MessageBar*>();
    desktop.window().films().write(*desktop.window().active_case(), file);
    QVERIFY(Desktop::wait_for([&] { return bar->text().contains("has not moved yet"); }, kPatience));
    QVERIFY(!QFile::exists(file));

    desktop.press(Qt::Key_P);
    QVERIFY(
        Desktop::wait_for([&] { return desktop.state().converged && !desktop.state().playing; }, kPatience));
    desktop.wait_until_idle();
    QString written;
    QObject::connect(desktop.window().findChild<ui::CaseFiles*>(), &ui::CaseFiles::written,
                     [&](const QString& name) { written = name; });
    desktop.window().films().write(*desktop.window().active_case(), file);
    QVERIFY(Desktop::wait_for([&] { return !written.isEmpty(); }, kPatience));
    QCOMPARE(written, file);
    QCOMPARE(bar->text(), QString());

    const auto pictures = pictures_of(file);
    QVERIFY2(pictures.size() >= 30 && pictures.size() <= 130, qPrintable(QString::number(pictures.size())));
    const double aspect = static_cast<double>(axial->width()) / axial->height();
    QVERIFY(std::abs(static_cast<double>(pictures.front().width()) / pictures.front().height() - aspect) <
            0.02);
    const auto first = static_cast<double>(yellow_pixels(pictures.front()));
    const auto last = static_cast<double>(yellow_pixels(pictures.back()));
    QVERIFY2(first > 30.0 && last > 1.4 * first, qPrintable(QString("%1 %2").arg(first).arg(last)));
  }

  void a_film_is_given_up() {
    Desktop desktop(story_executor(), {900, 620});
    QVERIFY(desktop.open_phantom("tumour"));
    desktop.begin(9.0);
    desktop.proxy().step(200);
    desktop.wait_until_idle();
    QTest::mouseClick(desktop.view<ui::VolumeViewWidget>(), Qt::MiddleButton, {}, QPoint(8, 8));
    const TemporaryFolder folder;
    desktop.window().films().write(*desktop.window().active_case(),
                                   QString::fromStdString((folder / "none.gif").string()));
    ui::StatusProgress* line = nullptr;
    QVERIFY(Desktop::wait_for(
        [&] {
          for (auto* view : desktop.window().statusBar()->findChildren<ui::StatusProgress*>()) {
            if (view->isVisible()) line = view;
          }
          return line != nullptr;
        },
        kPatience));
    QCOMPARE(line->accessibleName(), QString("Writing none.gif"));
    QTest::mouseClick(line->findChild<QPushButton*>(), Qt::LeftButton);
    QVERIFY(Desktop::wait_for([&] { return !line->isVisible(); }, kPatience));
    QVERIFY(std::filesystem::is_empty(folder.path()));
  }

  void a_second_film_does_not_end_the_first() {
    Desktop desktop(story_executor(), {900, 620});
    QVERIFY(desktop.open_phantom("tumour"));
    desktop.begin(9.0);
    desktop.proxy().step(100);
    desktop.wait_until_idle();
    const TemporaryFolder folder;
    QStringList written;
    QObject::connect(desktop.window().findChild<ui::CaseFiles*>(), &ui::CaseFiles::written,
                     [&](const QString& name) { written << name; });
    QStringList names;
    for (const char* name : {"first.gif", "second.gif"}) {
      names << QString::fromStdString((folder / name).string());
      desktop.window().films().write(*desktop.window().active_case(), names.last());
    }
    const auto* bar = desktop.window().findChild<ui::MessageBar*>();
    QVERIFY(Desktop::wait_for([&] { return bar->text() == "A film is being written already."; }, kPatience));
    QVERIFY(Desktop::wait_for([&] { return !written.isEmpty(); }, kPatience));
    QCOMPARE(written, QStringList(names.first()));
    QVERIFY(!pictures_of(names.first()).empty());
    QVERIFY(!QFile::exists(names.last()));
    QCOMPARE(bar->text(), QString());
    // Now there is room for it.
    desktop.window().films().write(*desktop.window().active_case(), names.last());
    QVERIFY(Desktop::wait_for([&] { return written == names; }, kPatience));
  }
};

TIDEMARK_TEST(FilmStoryTest)

}  // namespace tidemark::test::film_story_test

#include "film_story_test.moc"
