#include "ui/lessons/study_choice.h"

#include <fmt/format.h>

#include <QFileDialog>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QSignalBlocker>

#include "engine/phantom_text.h"
#include "imaging/phantom/phantom_name.h"
#include "ui/lessons/text_box.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {

StudyChoice::StudyChoice(QWidget* parent)
    : QWidget(parent), by_phantom_(new QRadioButton(tr("Phantom"))), by_file_(new QRadioButton(tr("File"))) {
  auto* grid = new QGridLayout(this);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(kSpace);
  grid->setVerticalSpacing(kSpaceTight);
  grid->setColumnStretch(1, 1);
  by_phantom_->setToolTip(tr("A synthetic study, whose truth is known."));
  by_file_->setToolTip(tr("A study that is handed out together with the lesson."));
  grid->addWidget(by_phantom_, 0, 0);
  grid->addWidget(make_phantom(), 0, 1);
  grid->addWidget(by_file_, 1, 0);
  grid->addWidget(make_file(), 1, 1);
  setFocusProxy(by_phantom_);
  connect(by_phantom_, &QRadioButton::clicked, this, &StudyChoice::keep);
  connect(by_file_, &QRadioButton::clicked, this, &StudyChoice::keep);
}

QWidget* StudyChoice::make_phantom() {
  auto* whole = new QWidget;
  auto* row = new QHBoxLayout(whole);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  kind_ = new QComboBox;
  kind_->setAccessibleName(tr("Phantom"));
  kind_->setToolTip(tr("The synthetic study."));
  guard_wheel(kind_);
  for (const std::string_view kind : imaging::phantom_kinds()) {
    const engine::PhantomText text = engine::phantom_text(kind);
    kind_->addItem(text.title, QString::fromUtf8(kind.data(), qsizetype(kind.size())));
    kind_->setItemData(kind_->count() - 1, text.sentence, Qt::ToolTipRole);
  }
  has_noise_ = new QCheckBox(tr("Noise"));
  has_noise_->setToolTip(tr("Another noise than the phantom's usual one."));
  noise_ = make_number_box(0.0, 100.0, 1);
  noise_->setSuffix(tr(" %"));
  noise_->setAccessibleName(tr("Noise in percent"));
  noise_->setToolTip(tr("Standard deviation in percent of the brightest tissue."));
  row->addWidget(kind_, 1);
  row->addWidget(has_noise_);
  row->addWidget(noise_);
  connect(kind_, &QComboBox::activated, this, [this] {
    keep();
    emit phantom_chosen();
  });
  connect(has_noise_, &QCheckBox::clicked, this, &StudyChoice::keep);
  connect(noise_, &NumberBox::valueChanged, this, &StudyChoice::keep);
  return whole;
}

QWidget* StudyChoice::make_file() {
  auto* whole = new QWidget;
  auto* row = new QHBoxLayout(whole);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpaceTight);
  file_ = new QLineEdit;
  file_->setAccessibleName(tr("File or folder of the study"));
  file_->setToolTip(tr("Relative to the lesson's file, and below its folder."));
  file_->setPlaceholderText(tr("beside the lesson, as study/series"));
  const auto button = [this](QStringView picture, const QString& name, bool folder) {
    auto* one = new QToolButton;
    one->setIcon(icon(picture));
    one->setIconSize({kIconSmall, kIconSmall});
    one->setFocusPolicy(Qt::StrongFocus);
    one->setToolTip(name);
    one->setAccessibleName(name);
    connect(one, &QToolButton::clicked, this, [this, folder] { choose(folder); });
    return one;
  };
  choose_file_ = button(u"open-file", tr("Choose a file"), false);
  choose_folder_ = button(u"open-folder", tr("Choose a folder"), true);
  row->addWidget(file_, 1);
  row->addWidget(choose_file_);
  row->addWidget(choose_folder_);
  connect(file_, &QLineEdit::textEdited, this, &StudyChoice::keep);
  return whole;
}

void StudyChoice::show_study(document::LessonStudy* study, const std::filesystem::path& folder) {
  study_ = study;
  folder_ = folder;
  if (study == nullptr) return;
  const QSignalBlocker quiet(noise_);
  const bool is_phantom = !study->phantom.empty();
  (is_phantom ? by_phantom_ : by_file_)->setChecked(true);
  if (const auto name = imaging::parse_phantom_name(study->phantom)) {
    kind_->setCurrentIndex(std::max(kind_->findData(QString::fromStdString(name->kind)), 0));
    has_noise_->setChecked(name->options.noise_percent >= 0.0);
    show_number(*noise_, std::max(name->options.noise_percent, 0.0), 1);
  }
  file_->setText(text_of(study->file));
  enable();
}

void StudyChoice::enable() {
  const bool is_phantom = by_phantom_->isChecked();
  kind_->setEnabled(is_phantom);
  has_noise_->setEnabled(is_phantom);
  noise_->setEnabled(is_phantom && has_noise_->isChecked());
  file_->setEnabled(!is_phantom);
  for (QToolButton* choose : {choose_file_, choose_folder_}) choose->setEnabled(!is_phantom);
}

void StudyChoice::keep() {
  if (study_ == nullptr) return;
  document::LessonStudy chosen;
  if (by_phantom_->isChecked()) {
    chosen.phantom = kind_->currentData().toString().toStdString();
    if (has_noise_->isChecked()) chosen.phantom += fmt::format(":{}", noise_->value());
  } else {
    chosen.file = path_of(file_->text().trimmed());
  }
  enable();
  if (chosen == *study_) return;
  *study_ = std::move(chosen);
  emit edited();
}

void StudyChoice::choose(bool folder) {
  auto* dialog = new QFileDialog(this, folder ? tr("The folder of the study") : tr("The file of the study"),
                                 text_of(folder_));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(folder ? QFileDialog::Directory : QFileDialog::ExistingFile);
  dialog->setOption(QFileDialog::ShowDirsOnly, folder);
  connect(dialog, &QFileDialog::fileSelected, this, [this](const QString& chosen) {
    // What is outside stays as it is: the lesson's problem then says why it cannot be.
    const std::filesystem::path path = path_of(chosen);
    const std::filesystem::path relative = folder_.empty() ? path : path.lexically_relative(folder_);
    file_->setText(text_of(relative));
    keep();
  });
  dialog->open();
}

}  // namespace tidemark::ui
