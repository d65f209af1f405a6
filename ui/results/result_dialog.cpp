#include "ui/results/result_dialog.h"

#include <QDialogButtonBox>
#include <QVBoxLayout>

#include "ui/look/theme.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

constexpr int kWidth = 520;

}  // namespace

QString source_note(const engine::LoadedStudy& study) {
  if (study.dicom_files.empty()) {
    return ResultDialog::tr(
        "The study that is open is no DICOM series. The result makes a new study of an anonymous patient and "
        "refers to no images: other systems cannot lay it over any.");
  }
  return ResultDialog::tr(
      "The result becomes a new series of the study that is open. It holds its patient's name and number, "
      "and "
      "refers to its images.");
}

ResultDialog::ResultDialog(CaseWindow& window, const QString& title)
    : QDialog(&window),
      window_(window),
      choice_(new ResultChoice(this)),
      work_(new WorkLine(this)),
      go_(new QPushButton(this)) {
  setWindowTitle(title);
  setAttribute(Qt::WA_DeleteOnClose);
  connect(&proxy(), &engine::CaseProxy::state_changed, this, &ResultDialog::follow);
  connect(&proxy(), &engine::CaseProxy::failed, this, [this](const QString& message) {
    if (waiting_) rest(message);
  });
  connect(work_, &WorkLine::cancelled, this, [this] {
    if (waiting_) return rest(tr("Cancelled."));
    give_up();
  });
}

void ResultDialog::build(bool with_choice, QWidget* target, const QString& note, const QString& verb,
                         const QString& tip) {
  auto* column = new QVBoxLayout(this);
  column->setSpacing(kSpace);
  column->addWidget(choice_);
  with_choice_ = with_choice;
  target_ = target;
  choice_->setVisible(with_choice);
  column->addWidget(target);
  column->addWidget(make_note(note));
  column->addStretch(1);
  column->addWidget(work_);
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close, this);
  go_->setText(verb);
  go_->setToolTip(tip);
  go_->setDefault(true);
  buttons->addButton(go_, QDialogButtonBox::ActionRole);
  connect(go_, &QPushButton::clicked, this, &ResultDialog::start);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  column->addWidget(buttons);
  follow();
  resize(kWidth, layout()->totalHeightForWidth(kWidth));
}

void ResultDialog::follow() {
  choice_->show_state(proxy().state());
  const bool something = with_choice_ ? choice_->has_choice() : proxy().state().begun;
  choice_->setEnabled(!busy_);
  target_->setEnabled(!busy_);
  go_->setEnabled(!busy_ && something && ready());
}

void ResultDialog::start() {
  if (!busy_) confirm([this] { take_case(); });
}

void ResultDialog::take_case() {
  busy_ = waiting_ = true;
  work_->begin(tr("Looking at the case"));
  follow();
  proxy().take_snapshot(
      window_.view_state(),
      [self = QPointer(this)](const Snapshot& snapshot) {
        if (!self || !std::exchange(self->waiting_, false)) return;
        self->begin(snapshot);
      },
      [self = QPointer(this)] {
        if (self) self->rest(tr("The case could not be read"));
      });
}

void ResultDialog::rest(const QString& said) {
  busy_ = waiting_ = false;
  work_->end(said);
  follow();
}

void ResultDialog::reject() {
  give_up();
  QDialog::reject();
}

}  // namespace tidemark::ui
