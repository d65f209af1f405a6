#include "ui/main/first_steps.h"

#include <QDialog>
#include <QTextBrowser>
#include <QVBoxLayout>

#include "ui/views/mouse_scheme.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

constexpr const char* kPageName = "first-steps-page";  // of the one window

QString row(const QString& what, const QString& how) {
  return QStringLiteral("<tr><td>%1</td><td>&nbsp;&nbsp;</td><td>%2</td></tr>").arg(what, how);
}

QString key(const QAction* action) {
  return action->shortcut().toString(QKeySequence::NativeText);
}

QString steps(const Actions& actions) {
  const QStringList steps = {
      tr("Open a study (%1), or a phantom from File &gt; Phantoms.").arg(key(actions.open_folder)),
      tr("Choose <b>Probe T and ε</b> (%1) and drag over the tissue you want.")
          .arg(key(actions.tool(engine::Tool::probe_speed))),
      tr("Place a surface: choose <b>Sphere</b> (%1) and click in the tissue, or press in its middle and "
         "drag.")
          .arg(key(actions.tool(engine::Tool::seed))),
      tr("Press <b>Play</b> (%1) and watch. Change T, ε and α, the weight of the data, while it runs: near "
         "1 the surface follows brightness, near 0 it becomes smooth.")
          .arg(key(actions.play)),
      tr("Paint (%1) or erase (%2) while it runs; undo (%3) takes anything back.")
          .arg(key(actions.tool(engine::Tool::paint)), key(actions.tool(engine::Tool::erase)),
               key(actions.undo)),
      tr("Accept the surface into a label, and export mask (%1), polygons or a DICOM segmentation.")
          .arg(key(actions.export_mask))};
  QString text;
  for (const QString& step : steps) text += QStringLiteral("<li>%1</li>").arg(step);
  return QStringLiteral("<ol>%1</ol>").arg(text);
}

QString mouse() {
  return QStringLiteral("<table>%1</table>")
      .arg(row(tr("left button"), mouse_scheme() == MouseScheme::itk_snap
                                      ? tr("the tool; else the crosshair on slices, turning in 3D")
                                      : tr("the tool; window and level on slices, turning in 3D")) +
           row(tr("middle button"), tr("move the picture")) +
           row(tr("right button"),
               tr("zoom, a click opens a menu; the opposite of the brush while painting")) +
           row(tr("with Examples"), tr("left inside, right outside, with Ctrl takes strokes away")) +
           row(tr("wheel"), tr("slices; the clip plane or zoom in 3D")) +
           row(tr("Shift + wheel"), tr("size of the brush")) + row(tr("Ctrl + wheel"), tr("zoom")) +
           row(tr("Shift + move"), tr("linked crosshair")) +
           row(tr("Ctrl + move"), tr("why the surface moves or rests there")) +
           row(tr("Alt + left"), tr("window and level, whatever the tool")) +
           row(tr("double click"), tr("one view large, and back")));
}

QString keys(const Actions& actions) {
  QString rows;
  for (const QAction* action : actions.all()) {
    if (!action->shortcut().isEmpty()) rows += row(key(action), action->property("tip").toString());
  }
  return QStringLiteral("<table>%1</table>").arg(rows);
}

}  // namespace

void show_first_steps(QWidget* parent, const Actions& actions) {
  auto* dialog = parent->findChild<QDialog*>(kPageName, Qt::FindDirectChildrenOnly);
  if (!dialog) {
    dialog = new QDialog(parent);
    dialog->setObjectName(kPageName);
    dialog->setWindowTitle(tr("First steps, mouse and keys"));
    auto* page = new QTextBrowser;
    page->setFrameShape(QFrame::NoFrame);
    auto* layout = new QVBoxLayout(dialog);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->addWidget(page);
    dialog->resize(560, 620);
  }
  // Keys may have been changed since.
  dialog->findChild<QTextBrowser*>()->setHtml(
      QStringLiteral("<h3>%1</h3>%2<h3>%3</h3>%4<h3>%5</h3>%6")
          .arg(tr("A first segmentation"), steps(actions), tr("Mouse"), mouse(), tr("Keys"), keys(actions)));
  dialog->show();
  dialog->raise();
  dialog->activateWindow();
}

}  // namespace tidemark::ui
