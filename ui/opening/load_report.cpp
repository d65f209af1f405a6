#include "ui/opening/load_report.h"

#include <QBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <algorithm>

#include "engine/message_text.h"
#include "imaging/results/results.h"
#include "ui/look/theme.h"
#include "ui/opening/grid_text.h"
#include "ui/widgets/elided_label.h"

namespace tidemark::ui {
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
  const QString first = engine::message_text(changes.front());
  if (changes.size() == 1) return LoadReport::tr("%1; %2").arg(grid, first);
  return LoadReport::tr("%1; %n changes: %2, …", nullptr, static_cast<int>(changes.size())).arg(grid, first);
}

QString html_list(const QString& items) {
  return QStringLiteral("<ul style='margin:2px 0 0 -22px'>%1</ul>").arg(items);
}

QString form_text(imaging::ResultForm form) {
  return form == imaging::ResultForm::segmentation ? LoadReport::tr("a DICOM segmentation")
                                                   : LoadReport::tr("a structure set");
}

QString result_text(const engine::FoundResult& result) {
  return LoadReport::tr("%1 is %2")
      .arg(QString::fromStdString(result.file.filename().string()), form_text(result.form));
}

}  // namespace

LoadReport::LoadReport(const engine::LoadedStudy& study, const std::vector<engine::FoundResult>& results,
                       QWidget* parent)
    : QFrame(parent), details_button_(new QPushButton(tr("Details"))) {
  setAccessibleName(tr("Report of loading"));
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(kSpace, kSpaceTight, kSpace, kSpaceTight);
  column->setSpacing(kSpaceTight);
  column->addWidget(make_line(study, results));
  QWidget* details = make_details(study.volume->changes, results);
  column->addWidget(details);
  details->hide();
  connect(details_button_, &QPushButton::toggled, details, &QWidget::setVisible);
}

QWidget* LoadReport::make_line(const engine::LoadedStudy& study,
                               const std::vector<engine::FoundResult>& results) {
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
  if (!results.empty()) row->addWidget(make_offer(results));
  details_button_->setCheckable(true);
  details_button_->setToolTip(tr("Shows or hides all that was found and changed when the study was read"));
  row->addWidget(details_button_);
  auto* close = new QPushButton(tr("Dismiss"));
  close->setAccessibleName(tr("Dismiss the report of loading"));
  connect(close, &QPushButton::clicked, this, &LoadReport::dismiss);
  row->addWidget(close);
  return line;
}

// Goes when it is accepted: importing twice would double the labels.
QWidget* LoadReport::make_offer(const std::vector<engine::FoundResult>& results) {
  auto* offer = new QWidget;
  auto* row = new QHBoxLayout(offer);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  auto* what = new QLabel(results.size() == 1 ? tr("Beside it: %1").arg(form_text(results.front().form))
                                              : tr("Beside it: %n segmentations or structure sets", nullptr,
                                                   static_cast<int>(results.size())));
  what->setTextFormat(Qt::PlainText);
  row->addWidget(what);
  QStringList files;
  QStringList lines{tr("Adds what these files hold as new labels:")};
  for (const engine::FoundResult& result : results) {
    files << QString::fromStdString(result.file.string());
    lines << result_text(result);
  }
  auto* accept = new QPushButton(tr("Import labels"));
  accept->setToolTip(lines.join(QLatin1Char('\n')));
  connect(accept, &QPushButton::clicked, this, [this, offer, files] {
    offer->hide();
    emit import_wanted(files);
  });
  row->addWidget(accept);
  return offer;
}

QWidget* LoadReport::make_details(const std::vector<std::string>& changes,
                                  const std::vector<engine::FoundResult>& results) {
  QString text;
  for (const std::string& change : changes) {
    text += QStringLiteral("<li>%1</li>").arg(engine::message_text(change).toHtmlEscaped());
  }
  text = changes.empty() ? tr("Nothing was changed or missing.")
                         : tr("Found and changed when it was read:") + html_list(text);
  QString beside;
  for (const engine::FoundResult& result : results) {
    beside += QStringLiteral("<li>%1</li>").arg(result_text(result).toHtmlEscaped());
  }
  if (!beside.isEmpty()) text += QStringLiteral("<div>%1</div>").arg(tr("Beside it:")) + html_list(beside);
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

}  // namespace tidemark::ui
