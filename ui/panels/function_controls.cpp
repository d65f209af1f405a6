#include "ui/panels/function_controls.h"

#include <QComboBox>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <utility>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/map_choice.h"
#include "ui/panels/term_controls.h"
#include "ui/views/mark_drags.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

QVBoxLayout* column_on(QWidget* widget) {
  auto* column = new QVBoxLayout(widget);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpace);
  return column;
}

// By the time of a change an undo may have brought other terms.
bool is_at(const solver::SpeedSetting& setting, std::size_t place, const solver::SpeedKind& kind) {
  return place < setting.terms.size() && setting.terms[place].function == kind.name;
}

}  // namespace

FunctionControls::FunctionControls(QWidget* parent) : CaseWidget(parent) {
  QVBoxLayout* column = column_on(this);
  auto* head = new QWidget;
  Form(head).heading(tr("Speed"));
  column->addWidget(head);
  auto* list = new QWidget;
  list_ = column_on(list);
  column->addWidget(list);
  problem_ = make_note({});
  problem_->hide();
  column->addWidget(problem_);
  add_map_choice(*column);
  add_joining(*column);
}

void FunctionControls::add_map_choice(QVBoxLayout& column) {
  map_ = new MapChoice;
  map_->hide();
  column.addWidget(map_);
  connect(map_, &MapChoice::chosen, this, &FunctionControls::take_map);
  connect(map_, &MapChoice::failed, this, &FunctionControls::say);
}

void FunctionControls::add_joining(QVBoxLayout& column) {
  joining_ = new QWidget;
  Form form(joining_);
  combine_ =
      form.choice(tr("Joined by"), tr("Least: the surface grows where all functions let it. Product: their "
                                      "probabilities are multiplied, so that each doubt counts."));
  combine_->addItem(tr("Least"), static_cast<int>(solver::Combine::least));
  combine_->addItem(tr("Product"), static_cast<int>(solver::Combine::product));
  connect(combine_, &QComboBox::activated, this, [this] {
    const auto combine = static_cast<solver::Combine>(combine_->currentData().toInt());
    change([=](solver::SpeedSetting& setting) { setting.combine = combine; });
  });
  joining_->hide();
  column.addWidget(joining_);
  add_ = new QPushButton(icon(u"add"), tr("And also…"));
  add_->setToolTip(tr("A further speed function drives the surface together with this one."));
  connect(add_, &QPushButton::clicked, this, &FunctionControls::add_term);
  column.addWidget(add_, 0, Qt::AlignLeft);
}

void FunctionControls::attach() {
  place_of_map_.reset();
  say({});
  map_->set_proxy(proxy());
}

void FunctionControls::say(const QString& problem) {
  problem_->setText(problem);
  problem_->setVisible(!problem.isEmpty());
}

void FunctionControls::refresh() {
  const solver::SpeedSetting& setting = proxy()->drive().setting;
  const auto shown = [](const TermControls* controls, const solver::SpeedTerm& term) {
    return controls->kind().name == term.function;
  };
  if (!std::ranges::equal(terms_, setting.terms, shown)) show_terms(setting);
  for (std::size_t place = 0; place < terms_.size(); ++place)
    terms_[place]->set_values(setting.terms[place].values);
  joining_->setVisible(terms_.size() > 1);
  combine_->setCurrentIndex(combine_->findData(static_cast<int>(setting.combine)));
  const bool needs_map =
      std::ranges::any_of(terms_, [](const TermControls* controls) { return controls->kind().needs_map; });
  map_->setVisible(needs_map || place_of_map_);
  add_->setEnabled(terms_.size() < solver::speed_kinds().size());
}

void FunctionControls::show_terms(const solver::SpeedSetting& setting) {
  // One of them may be what calls this.
  for (TermControls* controls : terms_) {
    controls->hide();
    controls->deleteLater();
  }
  terms_.clear();
  place_of_map_.reset();
  say({});
  for (std::size_t place = 0; place < setting.terms.size(); ++place) {
    const solver::SpeedKind* kind = solver::speed_kind(setting.terms[place].function);
    if (!kind) continue;  // none that came from a file is unknown
    auto* controls =
        new TermControls(place == 0 ? tr("Driven by") : tr("And also"), *kind, setting.terms.size() > 1);
    connect(controls, &TermControls::function_chosen, this,
            [this, place](const QString& function) { choose(place, function); });
    connect(controls, &TermControls::number_edited, this,
            [this, place, kind](const QString& name, double value, std::uint64_t gesture) {
              change(
                  [place, kind, name = name.toStdString(), value](solver::SpeedSetting& s) {
                    if (is_at(s, place, *kind)) s.terms[place].values[name] = value;
                  },
                  gesture);
            });
    connect(controls, &TermControls::remove_wanted, this, [this, place, kind] {
      change([place, kind](solver::SpeedSetting& s) {
        if (s.terms.size() > 1 && is_at(s, place, *kind))
          s.terms.erase(s.terms.begin() + static_cast<std::ptrdiff_t>(place));
      });
    });
    list_->addWidget(controls);
    terms_.push_back(controls);
  }
}

QString FunctionControls::obstacle(const solver::SpeedKind& kind) const {
  const document::Drive& drive = proxy()->drive();
  if (kind.needs_strokes) return missing_examples(drive.strokes.get());
  if (kind.needs_map && !drive.map) return tr("It needs a map: choose a file first.");
  return {};
}

void FunctionControls::choose(std::size_t place, const QString& function) {
  const solver::SpeedKind* kind = solver::speed_kind(function.toStdString());
  if (!proxy() || !kind) return;
  const QString missing = obstacle(*kind);
  say(missing);
  place_of_map_.reset();
  if (!missing.isEmpty()) {
    if (kind->needs_map) place_of_map_ = place;
    refresh();
    // The surface is driven by it from the first strokes of both kinds on.
    if (kind->needs_strokes) proxy()->display().choose_tool(engine::Tool::examples);
    return;
  }
  change([place, kind](solver::SpeedSetting& setting) {
    if (place < setting.terms.size()) {
      setting.terms[place] = {kind->name, {}};
    } else {
      setting.terms.push_back({kind->name, {}});
    }
  });
}

// The function that waits for it drives the surface then.
void FunctionControls::take_map(const std::shared_ptr<const document::SpeedMap>& map) {
  if (!proxy()) return;
  say({});
  const auto take = [map, place = std::exchange(place_of_map_, std::nullopt)](document::Drive& drive) {
    drive.map = map;
    auto& terms = drive.setting.terms;
    if (place && *place < terms.size()) terms[*place] = {"image", {}};
  };
  proxy()->change_drive(take, engine::CaseProxy::new_gesture());
}

// The first that is not there yet and lacks nothing.
void FunctionControls::add_term() {
  if (!proxy()) return;
  const auto& terms = proxy()->drive().setting.terms;
  for (const solver::SpeedKind& kind : solver::speed_kinds()) {
    const bool is_there =
        std::ranges::any_of(terms, [&](const solver::SpeedTerm& term) { return term.function == kind.name; });
    if (is_there || !obstacle(kind).isEmpty()) continue;
    return choose(terms.size(), QString::fromLatin1(kind.name));
  }
}

void FunctionControls::change(const std::function<void(solver::SpeedSetting&)>& apply,
                              std::uint64_t gesture) {
  if (!proxy()) return;
  proxy()->change_drive([apply](document::Drive& drive) { apply(drive.setting); },
                        gesture != 0 ? gesture : engine::CaseProxy::new_gesture());
}

}  // namespace tidemark::ui
