#include "ui/panels/initialise_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "solver/coarse_grid.h"
#include "ui/look/theme.h"
#include "ui/panels/file_start_method.h"
#include "ui/panels/model_controls.h"
#include "ui/panels/smoothing_controls.h"
#include "ui/panels/start_methods.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {

InitialisePanel::InitialisePanel(QWidget* parent)
    : Panel(tr("Open a study to place a surface in it."), parent) {
  add(new SmoothingControls);
  auto* part = new QWidget;
  Form form(part);
  form.heading(tr("Place surface"));
  from_ = form.choice(tr("Begin with"), tr("What the surface is at first: from there it moves."));
  add(part);
  add_methods();
  add_start();
  add(new ModelControls);
  connect(from_, &QComboBox::currentIndexChanged, this, &InitialisePanel::show_method);
  show_method(0);
}

void InitialisePanel::add_methods() {
  methods_ = {new SphereStartMethod,
              new ValueStartMethod(ValueStartMethod::Extent::everywhere),
              new ValueStartMethod(ValueStartMethod::Extent::connected),
              new SpeedStartMethod,
              new FileStartMethod(StartFile::mask),
              new LabelStartMethod,
              new FileStartMethod(StartFile::level_set)};
  for (StartMethod* method : methods_) {
    from_->addItem(method->title());
    add(method);
    connect(method, &StartMethod::changed, this, &InitialisePanel::show_sentence);
    const auto say = [this](const QString& message) {
      problem_->setText(message);
      problem_->show();
    };
    connect(method, &StartMethod::failed, this, say);
    connect(method, &StartMethod::remarked, this, say);
  }
}

void InitialisePanel::add_start() {
  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpace);
  coarse_to_fine_ = new QCheckBox(tr("Coarse to fine"));
  coarse_to_fine_->setToolTip(
      tr("The surface comes to rest at a quarter and half of the resolution before its first step. Much "
         "sooner at rest in a large study; what is thinner than a few voxels can be missed."));
  sentence_ = make_note({});
  replaces_ = make_note(tr("It replaces the present surface; Undo brings that back."));
  replaces_->setForegroundRole(QPalette::PlaceholderText);
  replaces_->hide();  // until there is a surface
  problem_ = make_note({});
  problem_->hide();
  start_ = new QPushButton(tr("Place surface"));
  start_->setToolTip(tr("Places the surface as said above."));
  connect(start_, &QPushButton::clicked, this, [this] {
    problem_->hide();
    methods_[static_cast<std::size_t>(method_)]->start(coarse_to_fine_->isChecked() ? levels() : 1);
  });
  for (QWidget* widget :
       {static_cast<QWidget*>(coarse_to_fine_), static_cast<QWidget*>(sentence_),
        static_cast<QWidget*>(replaces_), static_cast<QWidget*>(problem_), static_cast<QWidget*>(start_)}) {
    column->addWidget(widget);
  }
  add(part);
}

void InitialisePanel::show_method(int index) {
  method_ = index;
  problem_->hide();
  for (int other = 0; other < static_cast<int>(methods_.size()); ++other) {
    methods_[static_cast<std::size_t>(other)]->setVisible(other == index);
  }
  show_sentence();
}

int InitialisePanel::levels() const {
  const StartMethod& method = *methods_[static_cast<std::size_t>(method_)];
  const bool is_raw =
      proxy()->parameters().data_form == solver::DataForm::raw && document::uses_tent(proxy()->drive());
  return method.has_levels() && !is_raw ? solver::levels_for(proxy()->volume().geometry) : 1;
}

void InitialisePanel::show_sentence() {
  if (!proxy()) return;
  const StartMethod& method = *methods_[static_cast<std::size_t>(method_)];
  sentence_->setText(method.sentence());
  coarse_to_fine_->setVisible(levels() > 1);
  start_->setEnabled(method.can_start());
  replaces_->setVisible(proxy()->state().begun && method.can_start());
}

void InitialisePanel::attach() {
  problem_->hide();  // the parts may tell of one of the next case
  Panel::attach();
}

void InitialisePanel::refresh() {
  show_sentence();
}

}  // namespace tidemark::ui
