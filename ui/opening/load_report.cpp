#include "ui/opening/load_report.h"

#include <QBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <algorithm>

#include "ui/look/theme.h"
#include "ui/opening/grid_text.h"
#include "ui/widgets/elided_label.h"

namespace tidemark {
namespace {

constexpr int kMostLines = 8;  // of the details; more scroll

// As high as its text is, up to some lines.
class TextArea : public QScrollArea {
 public:
  explicit TextArea(QLabel* text) {
    setFrameShape(QFrame::NoFrame);
    setWidgetResizable(true);
    setWidget(text);
  }

 protected:
  void resizeEvent(QResizeEvent* event) override {
    QScrollArea::resizeEvent(event);
    setFixedHeight(std::min(widget()->heightForWidth(width()), kMostLines * fontMetrics().lineSpacing()));
  }
};

QString summary(const Volume& volume) {
  const auto& changes = volume.changes;
  const QString grid = grid_text(volume.geometry);
  if (changes.empty()) return grid;
  const QString first = QString::fromStdString(changes.front());
  if (changes.size() == 1) return LoadReport::tr("%1; %2").arg(grid, first);
  return LoadReport::tr("%1; %2 changes: %3, …").arg(grid).arg(changes.size()).arg(first);
}

}  // namespace

LoadReport::LoadReport(const LoadedStudy& study, QWidget* parent)
    : QFrame(parent), details_button_(new QPushButton(tr("Details"))) {
  setAccessibleName(tr("Report of loading"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(kSpace, kSpaceTight, kSpace, kSpaceTight);
  column->setSpacing(kSpaceTight);
  column->addWidget(make_line(study));
  QWidget* details = make_details(study.volume->changes);
  column->addWidget(details);
  details->hide();
  connect(details_button_, &QPushButton::toggled, details, &QWidget::setVisible);
}

QWidget* LoadReport::make_line(const LoadedStudy& study) {
  auto* line = new QWidget;
  auto* row = new QHBoxLayout(line);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  auto* title = new QLabel(study.name);
  title->setTextFormat(Qt::PlainText);
  QFont bold = title->font();
  bold.setWeight(QFont::DemiBold);
  title->setFont(bold);
  row->addWidget(title);
  row->addWidget(new ElidedLabel(summary(*study.volume)), 1);
  details_button_->setCheckable(true);
  details_button_->setToolTip(tr("Shows or hides all that was found and changed when the study was read"));
  row->addWidget(details_button_);
  auto* close = new QPushButton(tr("Dismiss"));
  close->setAccessibleName(tr("Dismiss the report of loading"));
  connect(close, &QPushButton::clicked, this, &LoadReport::dismiss);
  row->addWidget(close);
  return line;
}

QWidget* LoadReport::make_details(const std::vector<std::string>& changes) {
  QString text;
  for (const std::string& change : changes) {
    text += QStringLiteral("<li>%1</li>").arg(QString::fromStdString(change).toHtmlEscaped());
  }
  text = changes.empty() ? tr("Nothing was changed or missing.")
                         : tr("Found and changed when it was read:") +
                               QStringLiteral("<ul style='margin:2px 0 0 -22px'>%1</ul>").arg(text);
  auto* what = new QLabel(text);
  what->setObjectName("what");
  what->setTextFormat(Qt::RichText);
  what->setWordWrap(true);
  what->setAlignment(Qt::AlignLeft | Qt::AlignTop);
  what->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
  return new TextArea(what);
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
