#include "ui/panels/example_controls.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

#include "engine/stroke_painting.h"
#include "solver/speed/speed_registry.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/views/mark_drags.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/slider_number.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

constexpr double kSmallestVoxels = 0.5;  // voxels
constexpr double kLargestVoxels = 50.0;
constexpr std::int64_t kStrokeSteps[] = {0, 30, 60, 120, 250};
constexpr std::size_t kMostToCount = 20000;  // strokes from files can be whole organs

QString text_of(const Geometry& geometry, const std::vector<std::int64_t>& voxels) {
  if (voxels.empty()) return ExampleControls::tr("none");
  const auto size = static_cast<qint64>(voxels.size());
  const QString count = ExampleControls::tr("%1 voxels", nullptr, form_of(size)).arg(count_text(size));
  if (voxels.size() > kMostToCount) return count;
  const std::int64_t strokes = engine::count_strokes(geometry, voxels);
  return ExampleControls::tr("%1 × %2").arg(count_text(strokes), count);
}

QString text_of(std::int64_t steps) {
  if (steps == 0) return ExampleControls::tr("as it plays");
  return ExampleControls::tr("%n steps, then pause", nullptr, static_cast<int>(steps));
}

// A session may have other steps than those that are offered.
int index_of(QComboBox& motion, std::int64_t steps) {
  if (motion.findData(QVariant::fromValue<qint64>(steps)) < 0)
    motion.addItem(text_of(steps), QVariant::fromValue<qint64>(steps));
  return motion.findData(QVariant::fromValue<qint64>(steps));
}

}  // namespace

ExampleControls::ExampleControls(QWidget* parent) : CaseWidget(parent), content_(new QWidget) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(content_);
  Form form(content_);
  form.heading(tr("Examples"));
  missing_ = form.note({});
  inside_ = form.figure(tr("Inside"), tr("Strokes and voxels of what is to be found, orange and filled."));
  outside_ = form.figure(tr("Outside"), tr("Strokes and voxels of all else, blue and hatched."));
  radius_ = form.slider(tr("Brush"), tr("Radius of a stroke in its slice. In a view: Shift and the wheel."));
  radius_->set_decimals(1);
  radius_->set_range(kSmallestVoxels, kLargestVoxels, SliderNumber::Scale::logarithmic);
  radius_->set_unit(tr("voxels"));
  connect(radius_, &SliderNumber::edited, this, [this](double value) {
    change_display([=](engine::DisplaySettings& settings) { settings.stroke_voxels = value; });
  });
  motion_ =
      form.choice(tr("After a stroke"),
                  tr("With a number of steps, a stroke moves the surface by so many, and pauses it: a leak "
                     "is seen while it is small. A stroke inside joins the surface."));
  for (const std::int64_t steps : kStrokeSteps) index_of(*motion_, steps);
  connect(motion_, &QComboBox::activated, this, [this] {
    const qint64 steps = motion_->currentData().toLongLong();
    change_display([=](engine::DisplaySettings& settings) { settings.stroke_steps = steps; });
  });
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpace);
  tool_ = new QToolButton;
  tool_->setText(tr("Paint examples"));
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
  clear_ = new QPushButton(tr("Clear strokes"));
  clear_->setToolTip(tr("Takes all examples away; Undo brings them back."));
  connect(clear_, &QPushButton::clicked, this, [this] {
    if (!proxy()) return;
    proxy()->change_drive([](document::Drive& drive) { drive = taught(drive, nullptr); },
                          engine::CaseProxy::new_gesture());
  });
  row->addWidget(tool_);
  row->addWidget(clear_);
  row->addStretch(1);
  form.wide(row);
}

void ExampleControls::attach() {
  counted_.reset();
  count();
}

void ExampleControls::count() {
  static const std::vector<std::int64_t> kNone;
  const Geometry geometry = proxy() ? proxy()->volume().geometry : Geometry();
  inside_->setText(text_of(geometry, counted_ ? counted_->inside : kNone));
  outside_->setText(text_of(geometry, counted_ ? counted_->outside : kNone));
  clear_->setEnabled(counted_ != nullptr);
}

void ExampleControls::refresh() {
  const engine::DisplaySettings& settings = proxy()->display().settings();
  const document::Drive& drive = proxy()->drive();
  const bool learns = solver::any_has(drive.setting, &solver::SpeedKind::needs_strokes);
  content_->setVisible(learns || drive.strokes || settings.tool == engine::Tool::examples);
  tool_->setChecked(settings.tool == engine::Tool::examples);
  radius_->set_value(settings.stroke_voxels);
  motion_->setCurrentIndex(index_of(*motion_, settings.stroke_steps));
  const QString missing = missing_examples(drive.strokes.get());
  missing_->setText(missing);
  missing_->setVisible(!missing.isEmpty());
  if (drive.strokes == counted_) return;
  counted_ = drive.strokes;
  count();
}

}  // namespace tidemark::ui
