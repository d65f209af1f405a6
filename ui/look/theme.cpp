#include "ui/look/theme.h"

#include <QApplication>
#include <QIcon>
#include <QToolTip>
#include <iterator>

#include "ui/look/polish_again.h"
#include "ui/look/style.h"

namespace tidemark::ui {
namespace {

struct Colours {
  QRgb window;
  QRgb base;  // fields and lists
  QRgb alternate;
  QRgb button;
  QRgb text;
  QRgb disabled;
  QRgb placeholder;
  QRgb highlight;
  QRgb highlighted_text;
  QRgb disabled_highlight;
  QRgb link;
  QRgb visited;
  QRgb tip;
  QRgb light;  // from here on: bevels and lines
  QRgb midlight;
  QRgb mid;
  QRgb dark;
  QRgb shadow;
};

constexpr Colours kLight{
    .window = 0xfff0f0f1,
    .base = 0xffffffff,
    .alternate = 0xfff6f6f7,
    .button = 0xfff7f7f8,
    .text = 0xff1c1d1f,
    .disabled = 0xff7b7e82,
    .placeholder = 0xff6a6d71,
    .highlight = 0xff1d69ad,
    .highlighted_text = 0xffffffff,
    .disabled_highlight = 0xffe3e5e8,
    .link = 0xff155fa3,
    .visited = 0xff6b4a9c,
    .tip = 0xfffafafa,
    .light = 0xffffffff,
    .midlight = 0xffe4e5e7,
    .mid = 0xffc4c6c9,
    .dark = 0xff9b9ea3,
    .shadow = 0xff6d7074,
};

constexpr Colours kDark{
    .window = 0xff252627,
    .base = 0xff1a1b1c,
    .alternate = 0xff202122,
    .button = 0xff343536,
    .text = 0xffe4e5e6,
    .disabled = 0xff8b8d90,
    .placeholder = 0xff98999c,
    .highlight = 0xff2b6cab,
    .highlighted_text = 0xffffffff,
    .disabled_highlight = 0xff3c3e40,
    .link = 0xff79b4ec,
    .visited = 0xffb79ae0,
    .tip = 0xff3a3b3d,
    .light = 0xff4a4b4d,
    .midlight = 0xff3e4041,
    .mid = 0xff48494b,
    .dark = 0xff151616,
    .shadow = 0xff0b0b0c,
};

constexpr QRgb kCases[] = {0xff0072b2, 0xffd55e00, 0xff009e73, 0xffcc79a7, 0xff56b4e9, 0xff8c6d1f};

// Qt itself draws nothing with the palette's bright text, in which style sheets find it.
QRgb chosen(const Colours& colours) {
  constexpr int kShare = 35;  // percent
  const auto mix = [](int over, int under) { return (over * kShare + under * (100 - kShare)) / 100; };
  return qRgb(mix(qRed(colours.highlight), qRed(colours.window)),
              mix(qGreen(colours.highlight), qGreen(colours.window)),
              mix(qBlue(colours.highlight), qBlue(colours.window)));
}

QPalette palette_of(const Colours& colours) {
  QPalette palette;
  using Role = QPalette::ColorRole;
  const std::pair<Role, QRgb> all[] = {
      {Role::Window, colours.window},
      {Role::WindowText, colours.text},
      {Role::Base, colours.base},
      {Role::AlternateBase, colours.alternate},
      {Role::Text, colours.text},
      {Role::PlaceholderText, colours.placeholder},
      {Role::Button, colours.button},
      {Role::ButtonText, colours.text},
      {Role::BrightText, chosen(colours)},
      {Role::Highlight, colours.highlight},
      {Role::HighlightedText, colours.highlighted_text},
      {Role::Link, colours.link},
      {Role::LinkVisited, colours.visited},
      {Role::ToolTipBase, colours.tip},
      {Role::ToolTipText, colours.text},
      {Role::Light, colours.light},
      {Role::Midlight, colours.midlight},
      {Role::Mid, colours.mid},
      {Role::Dark, colours.dark},
      {Role::Shadow, colours.shadow},
  };
  for (const auto& [role, colour] : all) palette.setColor(role, QColor(colour));
  for (const Role role : {Role::WindowText, Role::Text, Role::ButtonText, Role::HighlightedText}) {
    palette.setColor(QPalette::Disabled, role, QColor(colours.disabled));
  }
  palette.setColor(QPalette::Disabled, Role::Base, QColor(colours.window));
  palette.setColor(QPalette::Disabled, Role::Highlight, QColor(colours.disabled_highlight));
  return palette;
}

// Slim bars, docks and groups that are parted by lines rather than boxes. Colours are the palette's, so that
// another theme needs no other style sheet: mid is a line, midlight what is under the mouse, bright-text what
// is chosen, highlight an accent.
constexpr const char* kStyleSheet = R"(
QToolBar { border: none; padding: 2px 4px; spacing: 1px; }
QToolBar::separator:horizontal { background: palette(mid); width: 1px; margin: 4px 5px; }
QToolBar::separator:vertical { background: palette(mid); height: 1px; margin: 5px 4px; }
QToolBar QToolButton { border: 1px solid transparent; border-radius: 4px; padding: 3px; }
QToolBar QToolButton#qt_toolbar_ext_button { padding: 0px; }
QToolBar QToolButton:hover { background: palette(midlight); }
QToolBar QToolButton:pressed, QToolBar QToolButton:checked { background: palette(bright-text); border-color: palette(highlight); }
QToolBar QToolButton:focus { border-color: palette(highlight); }
QToolBar QToolButton[popupMode="1"] { padding-right: 16px; }
QToolBar QToolButton[popupMode="2"] { padding-right: 12px; }
QToolBar QToolButton::menu-button { border: none; width: 14px; }
QToolBar QToolButton::menu-indicator { subcontrol-origin: padding; subcontrol-position: right center; }
QTabWidget::pane { border: none; border-top: 1px solid palette(mid); }
QTabBar::tab { border: 2px solid transparent; padding: 4px 10px; }
QTabBar::tab:hover { background: palette(midlight); }
QTabBar::tab:top:selected { border-bottom-color: palette(highlight); }
QTabBar::tab:bottom:selected { border-top-color: palette(highlight); }
QTabBar::tab:left:selected { border-right-color: palette(highlight); }
QTabBar::tab:right:selected { border-left-color: palette(highlight); }
QDockWidget::title { background: palette(midlight); padding: 4px 8px; }
QMainWindow::separator { background: transparent; width: 5px; height: 5px; }
QMainWindow::separator:hover { background: palette(highlight); }
QGroupBox { border: none; border-top: 1px solid palette(mid); margin-top: 1.3em; padding-top: 4px; }
QGroupBox::title { subcontrol-origin: margin; subcontrol-position: top left; padding: 0 6px 2px 0; }
QGroupBox[checkable="true"] { margin-top: 1.8em; }
QGroupBox[checkable="true"]::title { padding: 3px 6px 3px 0; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QStatusBar::item { border: none; }
QToolTip { background: palette(window); color: palette(window-text); border: 1px solid palette(mid); padding: 3px 5px; }
)";

QPalette tip_palette(const QPalette& palette) {
  QPalette tip = palette;
  tip.setColor(QPalette::Window, palette.color(QPalette::ToolTipBase));
  return tip;
}

// File dialogs ask for some twenty icons of the desktop's theme. Where there is none but hicolor, which has
// only those of programs, Qt looks for each of them in hundreds of folders: 50,000 files that do not exist
// for each dialog.
void leave_out_empty_icon_theme() {
  const QString theme = QIcon::themeName();
  if (theme.isEmpty() || theme == QLatin1String("hicolor"))
    QIcon::setThemeSearchPaths({QStringLiteral(":/icons")});
}

}  // namespace

QPalette light_palette() {
  return palette_of(kLight);
}
QPalette dark_palette() {
  return palette_of(kDark);
}

bool is_dark(const QPalette& palette) {
  return palette.color(QPalette::WindowText).lightnessF() > palette.color(QPalette::Window).lightnessF();
}

void apply_theme(QApplication& application, Theme theme) {
  // The platform's wish can be read only before the first palette of ours.
  static const bool system_is_dark = is_dark(QGuiApplication::palette());
  const bool dark = theme == Theme::dark || (theme == Theme::system && system_is_dark);
  const QPalette palette = dark ? dark_palette() : light_palette();
  if (application.styleSheet().isEmpty()) {
    leave_out_empty_icon_theme();
    QApplication::setStyle(new Style);  // owned by the application
    application.setStyleSheet(QString::fromLatin1(kStyleSheet));
  }
  QApplication::setPalette(palette);
  QToolTip::setPalette(tip_palette(palette));
  polish_again();
}

QColor problem_colour(const QPalette& palette) {
  return is_dark(palette) ? QColor(0xff, 0x7b, 0x72) : QColor(0xb4, 0x23, 0x18);
}

QColor case_colour(int number) {
  const int colours = static_cast<int>(std::size(kCases));
  return QColor::fromRgb(kCases[(number - 1 + colours) % colours]);
}

}  // namespace tidemark::ui
