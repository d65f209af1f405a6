#include "ui/panels/initialise_panel.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/look/theme.h"
#include "ui/panels/file_start_page.h"
#include "ui/panels/smoothing_controls.h"
#include "ui/panels/start_pages.h"
#include "ui/widgets/form.h"

namespace tidemark {

InitialisePanel::InitialisePanel(QWidget* parent)
    : Panel(tr("Open a study to begin a level set in it."), parent) {
  add(new SmoothingControls);
  auto* part = new QWidget;
  Form form(part);
  form.heading(tr("Start"));
  from_ = form.choice(tr("Begin with"), tr("What the level set is at first."));
  add(part);
  add_pages();
  add_start();
  connect(from_, &QComboBox::currentIndexChanged, this, &InitialisePanel::show_page);
  show_page(0);
}

void InitialisePanel::add_pages() {
  pages_ = {new SphereStartPage,
            new ValueStartPage(ValueStartPage::Extent::everywhere),
            new ValueStartPage(ValueStartPage::Extent::connected),
            new FileStartPage(StartFile::mask),
            new LabelStartPage,
            new FileStartPage(StartFile::level_set)};
  for (StartPage* page : pages_) {
    from_->addItem(page->title());
    add(page);
    connect(page, &StartPage::changed, this, &InitialisePanel::show_sentence);
    connect(page, &StartPage::failed, this, [this](const QString& message) {
      problem_->setText(message);
      problem_->show();
    });
  }
}

void InitialisePanel::add_start() {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpace);
  sentence_ = make_note({});
  replaces_ = make_note(tr("It replaces the present surface; Undo brings that back."));
  replaces_->setForegroundRole(QPalette::PlaceholderText);
  problem_ = make_note({});
  problem_->hide();
  start_ = new QPushButton(tr("Start"));
  start_->setToolTip(tr("Begins the level set as said above."));
  connect(start_, &QPushButton::clicked, this, [this] {
    problem_->hide();
    pages_[static_cast<std::size_t>(page_)]->start();
  });
  for (QWidget* widget : {static_cast<QWidget*>(sentence_), static_cast<QWidget*>(replaces_),
                          static_cast<QWidget*>(problem_), static_cast<QWidget*>(start_)}) {
    column->addWidget(widget);
  }
  add(part);
}

void InitialisePanel::show_page(int index) {
  page_ = index;
  for (int other = 0; other < static_cast<int>(pages_.size()); ++other) {
    pages_[static_cast<std::size_t>(other)]->setVisible(other == index);
  }
  problem_->hide();
  show_sentence();
}

void InitialisePanel::show_sentence() {
  if (!session()) return;
  const StartPage& page = *pages_[static_cast<std::size_t>(page_)];
  sentence_->setText(page.sentence());
  start_->setEnabled(page.can_start());
  replaces_->setVisible(session()->state().begun && page.can_start());
}

void InitialisePanel::attach() {
  Panel::attach();
  problem_->hide();
}

void InitialisePanel::refresh() {
  show_sentence();
}

}  // namespace tidemark
