#include "ui/panels/model_controls.h"

#include <QFileDialog>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "engine/stroke_painting.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/model_choice.h"
#include "ui/results/file_name.h"
#include "ui/settings.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/path_text.h"
#include "ui/widgets/question.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {
namespace {

constexpr std::size_t kMostToCountClicks = 20'000;  // voxels: strokes from files can be whole organs

}  // namespace

ModelControls::ModelControls(QWidget* parent) : CaseWidget(parent), content_(new QWidget) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(content_);
  Form form(content_);
  form.heading(tr("Model of a server"));
  choice_ = new ModelChoice;
  form.wide(choice_);
  add_question(form);
  add_answer(form);
  connect_client();
  content_->hide();
}

void ModelControls::add_question(Form& form) {
  clicks_ = form.figure(tr("Clicks"), tr("The middle of each stroke of examples, inside and outside."));
  tool_ = new QToolButton;
  tool_->setText(tr("Mark clicks"));
  tool_->setIcon(icon(u"tool-examples"));
  tool_->setIconSize({kIcon, kIcon});
  tool_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  tool_->setCheckable(true);
  tool_->setFocusPolicy(Qt::StrongFocus);
  tool_->setToolTip(tr("Left button: inside. Right button: outside. With Ctrl: takes strokes away."));
  connect(tool_, &QToolButton::clicked, this, [this] {
    if (proxy()) proxy()->display().choose_tool(engine::Tool::examples);
    refresh();
  });
  ask_ = new QPushButton(tr("Ask the model"));
  ask_->setToolTip(tr("Sends voxels, spacing and clicks to the server, after a question the first time."));
  connect(ask_, &QPushButton::clicked, this, &ModelControls::ask);
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpace);
  row->addWidget(tool_);
  row->addWidget(ask_, 1);
  form.wide(row);
  work_ = new WorkLine;
  form.wide(work_);
  connect(choice_, &ModelChoice::changed, this, [this] {
    if (proxy()) refresh();
  });
  connect(choice_, &ModelChoice::list_wanted, this, [this] {
    if (!choice_->server() || client_.busy()) return;
    begin(tr("Asking the server"));
    client_.list(*choice_->server());
  });
}

void ModelControls::add_answer(Form& form) {
  answer_ = new QWidget;
  Form below(answer_);
  found_ = below.note({});
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpaceTight);
  const auto add = [&](const QString& text, const QString& tip, void (ModelControls::*use)()) {
    auto* button = new QPushButton(text);
    button->setToolTip(tip);
    connect(button, &QPushButton::clicked, this, use);
    row->addWidget(button);
  };
  add(tr("As surface"), tr("Places the surface around what was found; Undo takes it back."),
      &ModelControls::use_as_surface);
  add(tr("As labels"), tr("Adds what was found as labels; Undo takes them back."),
      &ModelControls::use_as_labels);
  add(tr("As speed…"), tr("Writes what was found into a file, and lets it drive the surface."),
      &ModelControls::use_as_speed);
  below.wide(row);
  form.wide(answer_);
}

void ModelControls::connect_client() {
  connect(work_, &WorkLine::cancelled, &client_, &engine::ModelClient::cancel);
  connect(&client_, &engine::ModelClient::progressed, this, [this](double fraction, const QString& step) {
    if (work_->working()) work_->set_progress(fraction, step);
  });
  connect(&client_, &engine::ModelClient::failed, this, &ModelControls::end);
  connect(&client_, &engine::ModelClient::cancelled, this, [this] { end(tr("Cancelled.")); });
  connect(&client_, &engine::ModelClient::listed, this, [this](const auto& models) {
    choice_->set_models(models);
    end(models->empty() ? tr("The server has no model for volumes.") : QString());
  });
  connect(&client_, &engine::ModelClient::found, this, &ModelControls::take);
  connect(&client_, &engine::ModelClient::start_made, this, [this](const document::Start& start) {
    if (asked_) asked_->begin(start);
    end({});
  });
  connect(&client_, &engine::ModelClient::map_written, this, &ModelControls::drive_by);
}

void ModelControls::attach() {
  counted_.reset();
  content_->setVisible(choice_->read() && proxy());
  if (!proxy() || cases_.find(proxy())) return;
  // Whichever case is shown then.
  connect(proxy(), &QObject::destroyed, &client_, [this] {
    if (!asked_ && client_.busy()) client_.cancel();
  });
  cases_[*proxy()] = {};
}

QString ModelControls::clicks_text() const {
  if (!counted_) return tr("none");
  const Geometry& grid = proxy()->volume().geometry;
  const auto count = [&](const std::vector<std::int64_t>& voxels) {
    return voxels.size() > kMostToCountClicks ? tr("many") : count_text(engine::count_strokes(grid, voxels));
  };
  return tr("%1 inside, %2 outside").arg(count(counted_->inside), count(counted_->outside));
}

QString ModelControls::finding_text(const engine::ModelFinding& finding) {
  QStringList parts;
  for (std::size_t i = 0; i < finding.ml.size(); ++i) {
    parts << tr("%1: %2").arg(QString::fromStdString(finding.segments->list[i].name),
                              number_text(finding.ml[i], 1, tr("ml")));
  }
  const QString all = parts.join(QStringLiteral("; "));
  return finding.answer.is_probability ? tr("Found a probability; where it is at least one half: %1").arg(all)
                                       : tr("Found: %1").arg(all);
}

void ModelControls::refresh() {
  const document::Drive& drive = proxy()->drive();
  if (drive.strokes != counted_ || clicks_->text().isEmpty()) {
    counted_ = drive.strokes;
    clicks_->setText(clicks_text());
  }
  tool_->setChecked(proxy()->display().settings().tool == engine::Tool::examples);
  const imaging::AiModel* model = choice_->model();
  const bool needs_click =
      model && model->clicks == imaging::AiModel::Clicks::required && (!counted_ || counted_->inside.empty());
  choice_->setEnabled(!client_.busy());
  ask_->setEnabled(model && !needs_click && !client_.busy());
  const OfCase& kept = cases_[*proxy()];
  if (client_.busy() && asked_ == proxy()) {
    if (!work_->working()) work_->begin(tr("Waiting for the server"));
  } else {
    work_->end(client_.busy() && asked_ ? tr("The server works on %1.").arg(asked_->name())
               : !choice_->server()     ? choice_->problem()
               : needs_click            ? tr("The model needs a click inside of what it is to find.")
                                        : kept.said);
  }
  if (kept.finding) found_->setText(finding_text(*kept.finding));
  answer_->setVisible(kept.finding != nullptr);
  answer_->setEnabled(!client_.busy());
}

// The first time that voxels of a case go to a server.
bool ModelControls::may_send() {
  const QPointer<engine::CaseProxy> sent(proxy());
  const QString where = choice_->where();
  if (cases_[*sent].allowed.contains(where)) return true;
  const QString text = tr("The voxels of %1, their spacing, place and direction, and the clicks go to the "
                          "server %2:\n\n%3\n\nNo "
                          "name, no number and no DICOM header are sent. The server may keep what it gets.")
                           .arg(sent->name(), QString::fromStdString(choice_->server()->name), where);
  const auto answer =
      ui::ask(this, tr("Send this study?"), text, QMessageBox::Yes | QMessageBox::No, QMessageBox::No);
  if (answer != QMessageBox::Yes || !sent || sent != proxy()) return false;
  cases_[*sent].allowed.insert(where);
  return true;
}

void ModelControls::ask() {
  if (!proxy() || !choice_->model() || client_.busy() || !may_send()) return;
  asked_ = proxy();
  cases_[*asked_].finding.reset();
  begin(tr("Calling the server"));
  const auto study = asked_->shared_study();
  client_.ask(*choice_->server(), study->volume, {*choice_->model(), choice_->label(), {}, {study->audited}},
              asked_->drive().strokes);
  refresh();
}

void ModelControls::take(std::shared_ptr<const engine::ModelFinding> finding) {
  if (asked_) cases_[*asked_].finding = std::move(finding);
  end({});
}

void ModelControls::use_as_surface() {
  if (!proxy() || client_.busy()) return;
  begin(tr("Placing the surface"));
  client_.make_start(cases_[*proxy()].finding, choice_->number());
}

void ModelControls::use_as_labels() {
  if (!proxy()) return;
  proxy()->import_labels(cases_[*proxy()].finding->segments);
}

// A file, so that a session finds the map again.
void ModelControls::use_as_speed() {
  const QPointer<engine::CaseProxy> wanted(proxy());
  if (!wanted || client_.busy()) return;
  const auto finding = cases_[*wanted].finding;
  auto* dialog =
      new QFileDialog(this, tr("Keep the map that drives the surface"), settings::save_folder().get(),
                      tr("Volumes (%1);;All files (*)").arg(QStringLiteral("*.nii.gz *.nii *.nrrd *.mha")));
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setAcceptMode(QFileDialog::AcceptSave);
  dialog->selectFile(file_name_of(QString::fromStdString(finding->model)) + QStringLiteral(".nii.gz"));
  connect(dialog, &QFileDialog::fileSelected, this, [this, wanted, finding](const QString& file) {
    if (!wanted || wanted != proxy() || client_.busy()) return;
    if (is_of_study(wanted->study(), path_of(file))) {
      asked_ = wanted;
      return end(tr("%1 is a file of the study, which is never written to: choose another name.").arg(file));
    }
    begin(tr("Writing the map"));
    client_.write_map(finding, choice_->number(), path_of(file));
  });
  dialog->open();
}

// In the place of a map that drives it already, else of the first function.
void ModelControls::drive_by(const std::shared_ptr<const document::SpeedMap>& map) {
  if (asked_) {
    const auto take = [map](document::Drive& drive) {
      drive.map = map;
      auto& terms = drive.setting.terms;
      const auto is_map = [](const solver::SpeedTerm& term) { return term.function == "image"; };
      if (terms.empty()) terms.emplace_back();
      if (std::ranges::none_of(terms, is_map)) terms.front() = {"image", {}};
    };
    asked_->change_drive(take, engine::CaseProxy::new_gesture());
  }
  end({});
}

void ModelControls::begin(const QString& what) {
  asked_ = proxy();
  cases_[*asked_].said.clear();
  work_->begin(what);
  choice_->setEnabled(false);
  ask_->setEnabled(false);
  answer_->setEnabled(false);
}

void ModelControls::end(const QString& said) {
  if (asked_) {
    cases_[*asked_].said = said;
  }
  work_->end(said);
  if (proxy()) refresh();
}

}  // namespace tidemark::ui
