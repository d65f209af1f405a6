// Icons and themes: everything can be seen, and told apart.
#include <QApplication>
#include <QMainWindow>
#include <QPainter>
#include <QStyle>
#include <QStyleOption>
#include <QTest>
#include <QToolBar>
#include <QToolButton>
#include <algorithm>
#include <cmath>

#include "tests/support/test_program.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace tidemark::test::look_test {

namespace {

// Names that the desktop asks for.
const QStringList kNames =
    QStringLiteral(
        "open-folder open-file server save save-as export phantom recent close undo redo play pause step "
        "step-back "
        "restart "
        "tool-window tool-crosshair tool-probe tool-probe-transfer tool-seed tool-paint tool-erase "
        "tool-distance "
        "tool-angle tool-examples tool-wall tool-why tool-label label-outline label-livewire label-values "
        "tool-profile clip-plane "
        "layout-single "
        "layout-one-three "
        "layout-two-two "
        "layout-paper view-slice-axial "
        "view-slice-coronal view-slice-sagittal view-oblique view-speed view-3d view-pages tile cascade tabs "
        "link lock "
        "unlock eye eye-off add remove duplicate colour camera reset-view maximise full-screen settings "
        "about warning "
        "handbook info target curve label statistics keyboard theme-light theme-dark lockstep more")
        .split(QLatin1Char(' '));

QImage drawn(const QString& name, int side, QIcon::Mode mode = QIcon::Normal) {
  return ui::icon(name).pixmap(QSize(side, side), mode).toImage().convertToFormat(QImage::Format_ARGB32);
}

double linear(double part) {
  return part <= 0.04045 ? part / 12.92 : std::pow((part + 0.055) / 1.055, 2.4);
}

// Contrast ratio as in WCAG 2.1.
double contrast(const QColor& one, const QColor& other) {
  const auto luminance = [](const QColor& c) {
    return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
  };
  const auto [low, high] = std::minmax({luminance(one), luminance(other)});
  return (high + 0.05) / (low + 0.05);
}

// Sum of the opacities, in pixels.
double ink(const QImage& image) {
  double sum = 0.0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += qAlpha(image.pixel(x, y)) / 255.0;
  }
  return sum;
}

// Largest difference of the red, green and blue of what is opaque from `colour`.
int distance_to(const QImage& image, const QColor& colour) {
  int largest = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QColor pixel = image.pixelColor(x, y);
      if (pixel.alpha() < 250) continue;
      largest = std::max({largest, std::abs(pixel.red() - colour.red()),
                          std::abs(pixel.green() - colour.green()), std::abs(pixel.blue() - colour.blue())});
    }
  }
  return largest;
}

// All icons with their names, on the theme's window: for the eye.
QImage contact_sheet(const QPalette& palette, int side, qreal scale) {
  constexpr int kColumns = 11;
  const QStringList names = ui::icon_names();
  const QSize cell(104, side + 34);
  const int rows = (static_cast<int>(names.size()) + kColumns - 1) / kColumns;
  QImage sheet(QSizeF(cell.width() * kColumns * scale, cell.height() * rows * scale).toSize(),
               QImage::Format_RGB32);
  sheet.setDevicePixelRatio(scale);
  sheet.fill(palette.color(QPalette::Window));
  QPainter painter(&sheet);
  QFont font = painter.font();
  font.setPixelSize(10);
  painter.setFont(font);
  painter.setPen(palette.color(QPalette::WindowText));
  for (int i = 0; i < names.size(); ++i) {
    const QPoint corner(i % kColumns * cell.width(), i / kColumns * cell.height());
    const QIcon picture = ui::icon(names[i]);
    picture.paint(&painter, QRect(corner + QPoint(52 - side - 2, 8), QSize(side, side)));
    picture.paint(&painter, QRect(corner + QPoint(54, 8), QSize(side, side)), Qt::AlignCenter,
                  QIcon::Disabled);
    painter.drawText(QRect(corner + QPoint(0, side + 12), QSize(cell.width(), 16)), Qt::AlignCenter,
                     names[i]);
  }
  return sheet;
}

}  // namespace

class LookTest : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { ui::apply_theme(*qApp, ui::Theme::system); }
  void cleanup() { ui::apply_theme(*qApp, ui::Theme::light); }

  void every_name_has_a_drawing() {
    for (const QString& name : kNames) QVERIFY2(!ui::icon(name).isNull(), qUtf8Printable(name));
    QStringList extra = ui::icon_names();
    for (const QString& name : kNames) extra.removeAll(name);
    QCOMPARE(extra, QStringList());  // a drawing that nobody asks for
  }

  // Dialogs for files look for icons of the desktop's theme: in a theme that has some, or nowhere on the
  // disk.
  void an_empty_icon_theme_is_not_searched() {
    const QString theme = QIcon::themeName();
    const bool is_empty = theme.isEmpty() || theme == "hicolor";
    QCOMPARE(QIcon::themeSearchPaths() == QStringList{":/icons"}, is_empty);
  }

  void an_unknown_name_gives_a_null_icon_and_a_warning() {
    QTest::ignoreMessage(QtWarningMsg, "There is no icon 'no-such-icon'");
    QVERIFY(ui::icon(u"no-such-icon").isNull());
  }

  void icons_take_the_colour_of_the_themes_text() {
    for (const ui::Theme theme : {ui::Theme::light, ui::Theme::dark}) {
      ui::apply_theme(*qApp, theme);
      const QPalette palette = QApplication::palette();
      for (const QString& name : ui::icon_names()) {
        const QImage normal = drawn(name, 48);
        QVERIFY2(ink(normal) > 30.0, qUtf8Printable(name));
        QVERIFY2(distance_to(normal, palette.color(QPalette::WindowText)) <= 2, qUtf8Printable(name));
        QVERIFY2(distance_to(drawn(name, 48, QIcon::Disabled),
                             palette.color(QPalette::Disabled, QPalette::WindowText)) <= 2,
                 qUtf8Printable(name));
        QVERIFY2(distance_to(drawn(name, 48, QIcon::Selected), palette.color(QPalette::HighlightedText)) <= 2,
                 qUtf8Printable(name));
      }
    }
  }

  void an_icon_made_before_a_change_of_theme_follows_it() {
    ui::apply_theme(*qApp, ui::Theme::light);
    const QIcon play = ui::icon(u"play");
    const QImage before = play.pixmap(24).toImage();
    ui::apply_theme(*qApp, ui::Theme::dark);
    QVERIFY(before != play.pixmap(24).toImage());
  }

  void icons_differ_from_each_other_also_when_small() {
    const QStringList names = ui::icon_names();
    for (int i = 0; i < names.size(); ++i) {
      const QImage one = drawn(names[i], 16);
      for (int j = i + 1; j < names.size(); ++j) {
        const QImage other = drawn(names[j], 16);
        double different = 0.0;
        for (int y = 0; y < 16; ++y) {
          for (int x = 0; x < 16; ++x)
            different += std::abs(qAlpha(one.pixel(x, y)) - qAlpha(other.pixel(x, y))) / 255.0;
        }
        QVERIFY2(different > 6.0, qUtf8Printable(names[i] + QStringLiteral(" and ") + names[j]));
      }
    }
  }

  void icons_keep_off_the_edge_and_stand_in_the_middle() {
    for (const QString& name : ui::icon_names()) {
      const QImage image = drawn(name, 96);
      QRect used;
      for (int y = 0; y < 96; ++y) {
        for (int x = 0; x < 96; ++x) {
          if (qAlpha(image.pixel(x, y)) > 32) used |= QRect(x, y, 1, 1);
        }
      }
      QVERIFY2(QRect(4, 4, 88, 88).contains(used), qUtf8Printable(name));
      const QPointF off = QRectF(used).center() - QPointF(48, 48);
      QVERIFY2(std::abs(off.x()) <= 6 && std::abs(off.y()) <= 6,
               qUtf8Printable(QStringLiteral("%1: %2, %3").arg(name).arg(off.x()).arg(off.y())));
      QVERIFY2(std::max(used.width(), used.height()) >= 56, qUtf8Printable(name));
    }
  }

  void icons_have_the_devices_pixels() {
    const QPixmap twice = ui::icon(u"save").pixmap(QSize(20, 20), 2.0);
    QCOMPARE(twice.size(), QSize(40, 40));
    QCOMPARE(twice.devicePixelRatio(), 2.0);
    QCOMPARE(ui::icon(u"save").pixmap(QSize(20, 20), 1.5).size(), QSize(30, 30));
    // Drawn, not enlarged: the sharp one holds steps that an enlarged one cannot.
    const QImage enlarged =
        drawn(QStringLiteral("save"), 20).scaled(40, 40, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
    QVERIFY(twice.toImage().convertToFormat(QImage::Format_ARGB32) != enlarged);
  }

  void the_applications_icon_has_colours_at_all_sizes() {
    for (const int side : {16, 32, 64, 256}) {
      const QImage image = ui::application_icon().pixmap(side, side).toImage();
      QCOMPARE(image.width(), side);
      int coloured = 0;
      for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) coloured += image.pixelColor(x, y).hsvSaturation() > 60;
      }
      QVERIFY(coloured > side * side / 4);
    }
  }

  void texts_have_enough_contrast_data() {
    QTest::addColumn<QPalette>("palette");
    QTest::newRow("light") << ui::light_palette();
    QTest::newRow("dark") << ui::dark_palette();
  }

  void texts_have_enough_contrast() {
    QFETCH(QPalette, palette);
    using P = QPalette;
    struct Pair {
      P::ColorGroup group;
      P::ColorRole text;
      P::ColorRole behind;
      double at_least;
    };
    const Pair pairs[] = {
        {P::Active, P::Text, P::Base, 4.5},
        {P::Active, P::Text, P::AlternateBase, 4.5},
        {P::Active, P::WindowText, P::Window, 4.5},
        {P::Active, P::WindowText, P::Midlight, 4.5},  // under the mouse, titles of docks
        {P::Active, P::ButtonText, P::Button, 4.5},
        {P::Active, P::HighlightedText, P::Highlight, 4.5},
        {P::Active, P::ToolTipText, P::ToolTipBase, 4.5},
        {P::Active, P::PlaceholderText, P::Base, 4.5},
        {P::Active, P::Link, P::Base, 4.5},
        {P::Active, P::Link, P::Window, 4.5},
        {P::Active, P::LinkVisited, P::Base, 4.5},
        {P::Inactive, P::HighlightedText, P::Highlight, 4.5},
        {P::Disabled, P::Text, P::Base, 3.0},
        {P::Disabled, P::WindowText, P::Window, 3.0},
        {P::Disabled, P::ButtonText, P::Button, 3.0},
        {P::Disabled, P::HighlightedText, P::Highlight, 3.0},
    };
    for (const auto& [group, text, behind, at_least] : pairs) {
      const double ratio = contrast(palette.color(group, text), palette.color(group, behind));
      QVERIFY2(
          ratio >= at_least,
          qUtf8Printable(
              QStringLiteral("group %1, role %2 on %3: %4").arg(group).arg(text).arg(behind).arg(ratio)));
    }
    // A chosen item differs from the others and from the window, also without its text.
    QVERIFY(contrast(palette.color(P::Highlight), palette.color(P::Window)) >= 2.0);
  }

  void themes_change_while_the_program_runs() {
    ui::apply_theme(*qApp, ui::Theme::dark);
    QVERIFY(ui::is_dark(QApplication::palette()));
    QCOMPARE(QApplication::palette().color(QPalette::Base), ui::dark_palette().color(QPalette::Base));
    ui::apply_theme(*qApp, ui::Theme::light);
    QVERIFY(!ui::is_dark(QApplication::palette()));
    ui::apply_theme(*qApp, ui::Theme::system);  // this platform's palette is light
    QVERIFY(!ui::is_dark(QApplication::palette()));
  }

  void buttons_of_windows_docks_and_tabs_stand_out_in_the_dark() {
    ui::apply_theme(*qApp, ui::Theme::dark);
    const QStyle& style = *QApplication::style();
    QStyleOptionTitleBar title;
    title.rect = QRect(0, 0, 200, 24);
    title.palette = QApplication::palette();
    title.titleBarFlags = Qt::WindowTitleHint | Qt::WindowSystemMenuHint | Qt::WindowCloseButtonHint;
    title.titleBarState = 0;  // not the active window
    title.subControls = QStyle::SC_TitleBarCloseButton | QStyle::SC_TitleBarLabel;
    const auto brightest_of = [](const QImage& image) {
      int brightest = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) brightest = std::max(brightest, qGray(image.pixel(x, y)));
      }
      return brightest;
    };
    QImage picture(title.rect.size(), QImage::Format_RGB32);
    picture.fill(Qt::black);
    QPainter painter(&picture);
    style.drawComplexControl(QStyle::CC_TitleBar, &title, &painter);
    painter.end();
    const QRect close = style.subControlRect(QStyle::CC_TitleBar, &title, QStyle::SC_TitleBarCloseButton);
    QVERIFY(brightest_of(picture.copy(close)) > 200);

    for (const auto which : {QStyle::SP_TitleBarCloseButton, QStyle::SP_TitleBarNormalButton,
                             QStyle::SP_ToolBarHorizontalExtensionButton}) {
      const QImage button = style.standardIcon(which).pixmap(48).toImage();
      QVERIFY(distance_to(button, QApplication::palette().color(QPalette::WindowText)) <= 2);
    }
    QStyleOption tab;
    tab.rect = QRect(0, 0, 24, 24);
    tab.palette = QApplication::palette();
    picture = QImage(24, 24, QImage::Format_RGB32);
    picture.fill(Qt::black);
    painter.begin(&picture);
    style.drawPrimitive(QStyle::PE_IndicatorTabClose, &tab, &painter);
    painter.end();
    QVERIFY(brightest_of(picture) > 200);
  }

  void the_arrow_to_the_tools_that_have_no_room_can_be_seen_in_the_dark() {
    ui::apply_theme(*qApp, ui::Theme::dark);
    QMainWindow window;
    QToolBar* bar = window.addToolBar("tools");
    for (int tool = 0; tool < 20; ++tool) bar->addAction(ui::icon(u"add"), "tool");
    window.resize(200, 100);
    window.show();
    QVERIFY(QTest::qWaitForWindowExposed(&window));
    auto* arrow = bar->findChild<QToolButton*>("qt_toolbar_ext_button");
    QVERIFY(arrow && arrow->isVisible());
    const QImage picture = arrow->grab().toImage();
    int bright = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) bright += qGray(picture.pixel(x, y)) > 150 ? 1 : 0;
    }
    QVERIFY2(bright >= 20, qPrintable(QString::number(bright)));
  }

  // TIDEMARK_CONTACT_SHEETS=folder keeps them, to be looked at.
  void contact_sheets_can_be_drawn() {
    for (const ui::Theme theme : {ui::Theme::light, ui::Theme::dark}) {
      ui::apply_theme(*qApp, theme);
      for (const qreal scale : {1.0, 2.0}) {
        const QImage sheet = contact_sheet(QApplication::palette(), ui::kIcon, scale);
        QVERIFY(!sheet.isNull());
        const QString folder = qEnvironmentVariable("TIDEMARK_CONTACT_SHEETS");
        if (folder.isEmpty()) continue;
        const QString file = QStringLiteral("%1/icons-%2-%3.png")
                                 .arg(folder, theme == ui::Theme::dark ? "dark" : "light")
                                 .arg(scale * 100);
        QVERIFY2(sheet.save(file), qUtf8Printable(file));
      }
    }
  }
};

TIDEMARK_TEST(LookTest)

}  // namespace tidemark::test::look_test

#include "look_test.moc"
