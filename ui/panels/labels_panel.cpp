#include "ui/panels/labels_panel.h"

#include <QCheckBox>
#include <QColorDialog>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTableView>
#include <QToolButton>

#include "ui/look/theme.h"
#include "ui/panels/acceptance_text.h"
#include "ui/panels/label_paint_controls.h"
#include "ui/panels/label_tool_controls.h"
#include "ui/panels/labels_model.h"
#include "ui/panels/meaning_picker.h"
#include "ui/panels/refine_choice.h"
#include "ui/widgets/form.h"
#include "ui/widgets/slider_number.h"
#include "ui/widgets/wide_button.h"

namespace tidemark::ui {
namespace {

constexpr int kMarkColumn = 30;  // a check box, or a colour
constexpr int kTableHeight = 180;

}  // namespace

LabelsPanel::LabelsPanel(QWidget* parent)
    : Panel(tr("Open a study to keep what you segment as labels."), parent), model_(new LabelsModel(this)) {
  add(make_table());
  painting_ = new LabelPaintControls;
  add(painting_);
  add(make_actions());
  tools_ = new LabelToolControls;
  add(tools_);
  connect(take_all_, &QCheckBox::toggled, this, [this](bool on) {
    const document::Take take = on ? document::Take::others_too : document::Take::free_voxels;
    tools_->set_take(take);
    painting_->set_take(take);
  });
  connect(model_, &LabelsModel::edited, this, [this](const document::Label& label) {
    if (proxy()) proxy()->set_label(label);
  });
  show_buttons();
}

QWidget* LabelsPanel::make_table() {
  table_ = new QTableView;
  table_->setModel(model_);
  table_->setAccessibleName(tr("Labels"));
  table_->setSelectionBehavior(QAbstractItemView::SelectRows);
  table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
  table_->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed);
  table_->setTabKeyNavigation(false);
  table_->setShowGrid(false);
  table_->setWordWrap(false);
  table_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  table_->verticalHeader()->setDefaultSectionSize(table_->fontMetrics().height() + kSpace);
  table_->setMinimumHeight(kTableHeight);
  table_->verticalHeader()->hide();
  QHeaderView* header = table_->horizontalHeader();
  header->setMinimumSectionSize(kMarkColumn);
  header->setHighlightSections(false);
  for (const int column : {LabelsModel::visible, LabelsModel::locked, LabelsModel::colour}) {
    header->setSectionResizeMode(column, QHeaderView::Fixed);
    header->resizeSection(column, kMarkColumn);
  }
  header->setSectionResizeMode(LabelsModel::name, QHeaderView::Stretch);
  header->setSectionResizeMode(LabelsModel::volume, QHeaderView::ResizeToContents);
  connect(table_, &QTableView::clicked, this, &LabelsPanel::choose_colour);
  connect(table_, &QTableView::activated, this, &LabelsPanel::choose_colour);
  connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &LabelsPanel::show_buttons);

  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpaceTight);
  column->addWidget(table_);
  column->addWidget(make_table_buttons());
  return part;
}

QWidget* LabelsPanel::make_table_buttons() {
  auto* buttons = new QWidget;
  auto* row = new QHBoxLayout(buttons);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpaceTight);
  auto* add = make_wide_button(tr("Add"), u"add", tr("Adds an empty label."));
  remove_ = make_wide_button(tr("Remove"), u"remove", tr("Removes the chosen label and what it holds."));
  row->addWidget(add);
  row->addWidget(remove_);
  connect(add, &QToolButton::clicked, this, &LabelsPanel::add_label);
  connect(remove_, &QToolButton::clicked, this, [this] {
    if (proxy() && chosen()) proxy()->remove_label(chosen()->id);
  });
  return buttons;
}

QWidget* LabelsPanel::make_actions() {
  auto* part = new QWidget;
  Form form(part);
  meaning_ = new MeaningPicker;
  form.row(tr("Meaning"), meaning_,
           tr("What the chosen label is, in codes of SNOMED CT for other systems. Type to search."));
  connect(meaning_, &MeaningPicker::picked, this,
          [this](const std::optional<imaging::SegmentMeaning>& meaning) {
            const QModelIndexList rows = table_->selectionModel()->selectedRows();
            if (!rows.isEmpty()) model_->set_meaning(rows.first().row(), meaning);
          });
  accept_ = new QPushButton(tr("Accept surface into label"));
  accept_->setToolTip(tr(
      "What is inside becomes the label. The surface stays until the panel Place surface begins another."));
  form.wide(accept_);
  connect(accept_, &QPushButton::clicked, this, &LabelsPanel::accept_surface);
  take_all_ = new QCheckBox(tr("Take voxels of other labels"));
  take_all_->setToolTip(
      tr("Otherwise only voxels that have no label yet are taken. Voxels of locked labels stay."));
  form.wide(take_all_);
  accepted_ = new QLabel;
  accepted_->setWordWrap(true);
  accepted_->hide();
  form.wide(accepted_);
  begin_ = new QPushButton(tr("Place surface from label"));
  begin_->setToolTip(tr("The surface begins anew around the chosen label, to go on with it."));
  form.wide(begin_);
  connect(begin_, &QPushButton::clicked, this, [this] {
    if (proxy() && chosen()) proxy()->begin_from_label(chosen()->id);
  });
  refine_ = new QPushButton(tr("Refine label"));
  refine_->setToolTip(
      tr("The surface begins around the chosen label and stays near to it. Colours show what has changed."));
  form.wide(refine_);
  within_ = RefineChoice::add_number(form);
  connect(refine_, &QPushButton::clicked, this, [this] {
    if (proxy() && chosen()) proxy()->begin_from_label(chosen()->id, within_->value());
  });
  compare_ = new QPushButton(tr("Compare surface with label"));
  compare_->setToolTip(tr(
      "Dice, distances and colours for how far the surface is from the chosen label, while it moves, too."));
  form.wide(compare_);
  opacity_ = form.slider(tr("Opacity"), tr("Of all labels, in slices and in 3D."));
  opacity_->set_decimals(0);
  opacity_->set_range(0.0, 100.0);
  opacity_->set_unit(QStringLiteral("%"));
  connect(opacity_, &SliderNumber::edited, this, [this](double value) {
    change_display([=](engine::DisplaySettings& settings) { settings.label_opacity = value / 100.0; });
  });
  return part;
}

const document::Label* LabelsPanel::chosen() const {
  const QModelIndexList rows = table_->selectionModel()->selectedRows();
  return rows.isEmpty() ? nullptr : model_->label(rows.first().row());
}

std::vector<std::uint8_t> LabelsPanel::all_chosen() const {
  std::vector<std::uint8_t> labels;
  for (const QModelIndex& index : table_->selectionModel()->selectedRows())
    labels.push_back(model_->label(index.row())->id);
  return labels;
}

void LabelsPanel::add_label() {
  if (!proxy()) return;
  choose_new_ = true;
  proxy()->add_label(new_name());
}

QString LabelsPanel::new_name() const {
  return tr("Label %1").arg(model_->rowCount() + 1);
}

// Accepts into the chosen label, or makes the first one.
void LabelsPanel::accept_surface() {
  if (!proxy()) return;
  const document::Take take =
      take_all_->isChecked() ? document::Take::others_too : document::Take::free_voxels;
  const document::Label* const label = chosen();
  if (!label) choose_new_ = true;
  proxy()->accept_surface(label ? label->id : std::uint8_t{0}, take, new_name());
}

void LabelsPanel::show_acceptance() {
  const auto& acceptance = proxy()->state().acceptance;
  accepted_->setVisible(acceptance.has_value());
  if (!acceptance) return;
  accepted_->setText(acceptance_text(*acceptance));
}

void LabelsPanel::choose_colour(const QModelIndex& index) {
  const document::Label* label = model_->label(index.row());
  if (!label || index.column() != LabelsModel::colour) return;
  auto* dialog = new QColorDialog(QColor(label->colour[0], label->colour[1], label->colour[2]), this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(dialog, &QColorDialog::colorSelected, this, [this, id = label->id](const QColor& colour) {
    for (int row = 0; row < model_->rowCount(); ++row) {
      if (model_->label(row)->id == id) model_->set_colour(row, colour);
    }
  });
  dialog->open();
}

void LabelsPanel::attach() {
  Panel::attach();
  choose_new_ = false;
  disconnect(choices_);
  // The rows of the case before choose nothing in this one.
  model_->show({}, {});
  if (!proxy()) return;
  take_all_->setChecked(proxy()->display().label_brush().take == document::Take::others_too);
  choices_ = connect(&proxy()->display(), &engine::Display::label_chosen, this, &LabelsPanel::choose);
}

void LabelsPanel::choose(std::uint8_t label) {
  refresh();  // a hidden panel may not have it yet
  for (int row = 0; row < model_->rowCount(); ++row) {
    if (model_->label(row)->id == label) table_->selectRow(row);
  }
}

void LabelsPanel::refresh() {
  const engine::CaseState& state = proxy()->state();
  const int before = model_->rowCount();
  const document::Label* label = before > 0 ? chosen() : proxy()->chosen_label();
  const int was = label ? label->id : 0;  // 0: none
  model_->show(state.labels, state.label_statistics);
  const int rows = model_->rowCount();
  if (rows != before) {
    // A reset drops the selection.
    const bool own = state.acceptance && !state.acceptance->kept.empty();
    int row = rows - 1;
    for (int other = 0; other < rows && !((choose_new_ || own) && rows > before); ++other) {
      if (model_->label(other)->id == was) row = other;
    }
    if (row >= 0) table_->selectRow(row);
    choose_new_ = false;
  }
  opacity_->set_value(100.0 * proxy()->display().settings().label_opacity);
  show_acceptance();
  show_buttons();
}

void LabelsPanel::show_buttons() {
  const document::Label* label = chosen();
  remove_->setEnabled(label && !label->locked);
  tools_->set_labels(all_chosen());
  painting_->set_label(label ? label->id : std::uint8_t{0});
  meaning_->show_label(label);
  const bool begun = proxy() && proxy()->state().begun;
  const bool locked = label && label->locked;
  accept_->setEnabled(begun && !locked);
  accept_->setToolTip(!begun   ? tr("There is no surface yet.")
                      : locked ? tr("The chosen label is locked.")
                      : !label ? tr("The surface's inside becomes a new label.")
                               : tr("The surface's inside becomes the chosen label. Where the two have no "
                                    "voxel in common it becomes a label of its own."));
  begin_->setEnabled(label != nullptr);
  refine_->setEnabled(label != nullptr);
  compare_->setEnabled(label != nullptr && begun);
}

void LabelsPanel::set_compare_action(QAction* action) {
  connect(compare_, &QPushButton::clicked, action, &QAction::trigger);
}

}  // namespace tidemark::ui
