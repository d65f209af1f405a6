#include "ui/opening/load_report.h"

#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>

#include "ui/opening/grid_text.h"

namespace tidemark {

LoadReport::LoadReport(const LoadedStudy& study, QWidget* parent) : QFrame(parent) {
  setFrameShape(QFrame::StyledPanel);
  setAccessibleName(tr("Report of loading"));
  const auto& changes = study.volume->changes;
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(14, 10, 10, 10);
  grid->setColumnStretch(0, 1);

  auto* title = new QLabel(study.name, this);
  title->setTextFormat(Qt::PlainText);
  title->setWordWrap(true);
  QFont bold = title->font();
  bold.setWeight(QFont::DemiBold);
  title->setFont(bold);
  grid->addWidget(title, 0, 0);

  grid->addWidget(new QLabel(grid_text(study.volume->geometry), this), 1, 0);

  QString text;
  for (const std::string& change : changes) {
    text += QStringLiteral("<li>%1</li>").arg(QString::fromStdString(change).toHtmlEscaped());
  }
  text = changes.empty() ? tr("Nothing was changed or missing.")
                         : tr("Found and changed when it was read:") +
                               QStringLiteral("<ul style='margin:2px 0 0 -22px'>%1</ul>").arg(text);
  auto* what = new QLabel(text, this);
  what->setObjectName("what");
  what->setTextFormat(Qt::RichText);
  what->setWordWrap(true);
  what->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  grid->addWidget(what, 2, 0);

  auto* close = new QPushButton(tr("Dismiss"), this);
  close->setAccessibleName(tr("Dismiss the report of loading"));
  connect(close, &QPushButton::clicked, this, &LoadReport::dismiss);
  grid->addWidget(close, 0, 1, 3, 1, Qt::AlignTop);
}

void LoadReport::dismiss() {
  hide();
  emit dismissed();
}

void LoadReport::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    dismiss();
  } else {
    QFrame::keyPressEvent(event);
  }
}

}  // namespace tidemark
