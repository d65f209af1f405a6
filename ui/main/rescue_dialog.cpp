#include "ui/main/rescue_dialog.h"

#include <QDateTime>
#include <QFileInfo>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>
#include <algorithm>

#include "engine/phantom_text.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

constexpr std::size_t kMostListed = 8;

QString age(const std::filesystem::path& copy) {
  const QDateTime written = QFileInfo(text_of(copy)).lastModified();
  return tr("copy of %1").arg(QLocale().toString(written, QLocale::ShortFormat));
}

// "Liver, study of 2004-07-31, copy of 21/11/2026 14:03", and below it where the study is.
QString entry(const document::Recoverable& copy) {
  const document::StudyOrigin& study = copy.study;
  QString name = QString::fromStdString(study.name);
  if (name.isEmpty()) name = engine::phantom_text(study.phantom).title;
  if (name.isEmpty()) name = text_of(study.path.filename());
  if (name.isEmpty()) name = tr("A case");
  QStringList facts;
  if (!study.phantom.empty()) facts << tr("phantom");
  if (!study.date.empty()) facts << tr("study of %1").arg(QString::fromStdString(study.date));
  facts << age(copy.file);
  QString html =
      QStringLiteral("<li><b>%1</b>, %2").arg(name.toHtmlEscaped(), facts.join(", ").toHtmlEscaped());
  if (!study.path.empty()) html += QStringLiteral("<br>%1").arg(text_of(study.path).toHtmlEscaped());
  return html + QStringLiteral("</li>");
}

// "Curvature flow, your answers to this lesson, copy of 21/11/2026 14:03".
QString entry(const document::RescuedLesson& rescued) {
  const QString title = QString::fromStdString(rescued.lesson.title);
  return QStringLiteral("<li><b>%1</b>, %2, %3</li>")
      .arg(title.toHtmlEscaped(), tr("your answers to this lesson"), age(rescued.copy).toHtmlEscaped());
}

}  // namespace

RescueAnswer ask_about_copies(QWidget* parent, const QString& why, const RescuedWork& work) {
  const auto& copies = work.cases;
  QString list = work.lesson ? entry(*work.lesson) : QString();
  for (std::size_t index = 0; index < std::min(copies.size(), kMostListed); ++index)
    list += entry(copies[index]);
  if (copies.size() > kMostListed) list += tr("<li>and %1 more</li>").arg(copies.size() - kMostListed);
  QMessageBox box(QMessageBox::Question, tr("Rescued work"), why, QMessageBox::NoButton, parent);
  box.setInformativeText(QStringLiteral("<ul style='margin:0 0 0 -22px'>%1</ul>").arg(list));
  const bool one = copies.size() + (work.lesson ? 1 : 0) == 1;
  QPushButton* open = box.addButton(one ? tr("Open it") : tr("Open them"), QMessageBox::AcceptRole);
  QPushButton* discard =
      box.addButton(one ? tr("Throw it away") : tr("Throw them away"), QMessageBox::DestructiveRole);
  QPushButton* later = box.addButton(tr("Ask again later"), QMessageBox::RejectRole);
  box.setDefaultButton(open);
  box.setEscapeButton(later);
  box.exec();
  if (box.clickedButton() == open) return RescueAnswer::open;
  return box.clickedButton() == discard ? RescueAnswer::discard : RescueAnswer::later;
}

}  // namespace tidemark::ui
