#include "ui/panels/measure_controls.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <algorithm>
#include <utility>

#include "document/label_tool.h"
#include "ui/panels/figure_table.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {
namespace {

QString times(const QStringList& numbers) {
  return numbers.join(QStringLiteral(" × "));
}

engine::Measurement line_of(const imaging::Chord& chord) {
  return {engine::Measurement::Kind::distance, {chord.from_mm, chord.to_mm}};
}

}  // namespace

MeasureControls::MeasureControls(QWidget* parent) : CaseWidget(parent) {
  Form form(this);
  form.heading(tr("Diameters and values"));
  region_ = form.choice(tr("Of"), tr("What is measured."));
  connect(region_, &QComboBox::activated, this, [this] {
    if (meter()) meter()->clear();
  });
  measure_ = new QPushButton(tr("Measure"));
  measure_->setToolTip(tr("Diameters, form, and the values of all images inside."));
  form.wide(measure_);
  connect(measure_, &QPushButton::clicked, this, &MeasureControls::measure);
  work_ = new WorkLine;
  form.wide(work_);
  connect(work_, &WorkLine::cancelled, this, [this] {
    if (meter()) meter()->cancel();
  });
  results_ = new QWidget;
  Form figures(results_);
  in_slice_ =
      figures.figure(tr("In a slice"), tr("The longest diameter in an axial slice, and the longest at right "
                                          "angles to it: the two of RECIST."));
  longest_ = figures.figure(tr("Longest"), tr("The longest diameter in any direction."));
  reach_ = figures.figure(tr("Reach"), tr("How far it reaches along its three main axes."));
  area_ = figures.figure(tr("Surface area"),
                         tr("The area of its surface, and of the faces where the study ends."));
  sphericity_ = figures.figure(tr("Sphericity"), tr("1 for a ball, less for any other form."));
  image_ = figures.choice(tr("Values of"), tr("The image whose values inside are listed."));
  connect(image_, &QComboBox::activated, this, &MeasureControls::fill_values);
  values_ = new FigureTable({tr("Values inside"), tr("Value")}, tr("Values inside"));
  figures.wide(values_);
  lines_ = new QPushButton(tr("Draw diameters"));
  lines_->setToolTip(tr("As lines in the slices, whose ends can be moved with the tool Distance."));
  figures.wide(lines_);
  connect(lines_, &QPushButton::clicked, this, &MeasureControls::draw_lines);
  result_rows_ = figures.layout();
  form.wide(results_);
  rows_ = form.layout();
  end_work({});
  show_measures();
}

engine::RegionMeter* MeasureControls::meter() const {
  return proxy() ? &proxy()->region_meter() : nullptr;
}

const document::Measures* MeasureControls::measures() const {
  return meter() ? meter()->measures().get() : nullptr;
}

void MeasureControls::measure() {
  if (!meter()) return;
  meter()->begin(static_cast<std::uint8_t>(region_->currentData().toInt()));
  show_work();
}

void MeasureControls::show_measures() {
  const document::Measures* const measures = this->measures();
  show_row(*rows_, results_, measures != nullptr);
  image_->clear();
  if (measures) {
    const imaging::Diameters& d = measures->diameters;
    const auto mm = [](double value) { return size_text(value, 1, tr("mm")); };
    const auto number = [](double value) { return size_text(value, 1); };
    in_slice_->setText(times({number(d.in_slice.length_mm()), mm(d.across.length_mm())}));
    longest_->setText(mm(d.longest.length_mm()));
    reach_->setText(times({number(d.reach_mm.x), number(d.reach_mm.y), mm(d.reach_mm.z)}));
    area_->setText(size_text(measures->area_mm2, 0, tr("mm²")));
    sphericity_->setText(number_text(measures->sphericity, 3));
    for (const document::ImageValues& image : measures->images)
      image_->addItem(QString::fromStdString(image.image));
  }
  show_row(*result_rows_, image_, image_->count() > 1);
  fill_values();
  show_buttons();
}

void MeasureControls::fill_values() {
  std::vector<QStringList> lines;
  if (measures() && image_->currentIndex() >= 0) {
    const document::ImageValues& image = measures()->images[static_cast<std::size_t>(image_->currentIndex())];
    const imaging::InsideValues& inside = image.values;
    const QString unit = QString::fromStdString(image.unit);
    const int decimals = inside.uptake ? 2 : value_decimals(image.span);
    const auto add = [&](const QString& name, double value) {
      lines.push_back({name, number_text(value, decimals, unit)});
    };
    if (image.covered < 1.0) lines.push_back({tr("Part that is covered"), share_text(image.covered)});
    add(tr("Mean"), inside.mean);
    add(tr("SD"), inside.standard_deviation);
    add(tr("Smallest"), inside.smallest);
    for (std::size_t n = 0; n < inside.percentiles.size(); ++n) {
      const double percent = imaging::kPercentiles[n];
      add(percent == 50.0 ? tr("Median") : tr("%1 % are below").arg(number_text(percent, 0)),
          inside.percentiles[n]);
    }
    add(tr("Largest"), inside.largest);
    if (inside.uptake) {
      add(tr("Peak (1 ml)"), inside.uptake->peak);
      lines.push_back({tr("Total lesion glycolysis"), number_text(inside.uptake->total_glycolysis, 1)});
    }
  }
  values_->fill(lines);
}

// The slices go to the diameter that one of them shows.
void MeasureControls::draw_lines() {
  if (!measures()) return;
  const imaging::Diameters& d = measures()->diameters;
  change_display([&](engine::DisplaySettings& settings) {
    for (const imaging::Chord* chord : {&d.longest, &d.in_slice, &d.across}) {
      const engine::Measurement line = line_of(*chord);
      const auto& all = settings.measurements;
      if (std::find(all.begin(), all.end(), line) == all.end()) settings.measurements.push_back(line);
    }
    settings.cursor_mm = 0.5 * (d.in_slice.from_mm + d.in_slice.to_mm);
  });
}

void MeasureControls::show_buttons() {
  measure_->setEnabled(region_->count() > 0 && meter() && !meter()->busy());
}

void MeasureControls::show_work() {
  work_->begin(tr("Measuring"));
  show_row(*rows_, work_, true);
  show_buttons();
}

void MeasureControls::end_work(const QString& said) {
  work_->end(said);
  show_row(*rows_, work_, !said.isEmpty());
  show_buttons();
}

void MeasureControls::attach() {
  if (shown_) disconnect(shown_, nullptr, this, nullptr);
  shown_ = meter();
  region_->clear();
  end_work({});
  show_measures();
  if (!shown_) return;
  connect(shown_, &engine::RegionMeter::changed, this, [this] {
    end_work({});
    show_measures();
  });
  connect(shown_, &engine::RegionMeter::failed, this, &MeasureControls::end_work);
  connect(shown_, &engine::RegionMeter::cancelled, this, [this] { end_work({}); });
  connect(shown_, &engine::RegionMeter::progressed, work_, &WorkLine::set_progress);
  if (shown_->busy()) show_work();
}

void MeasureControls::refresh() {
  const engine::CaseState& state = proxy()->state();
  std::vector<std::pair<QString, std::uint8_t>> regions;
  if (state.begun) regions.emplace_back(tr("Surface"), document::kTheSurface);
  for (const document::Label& label : state.labels)
    regions.emplace_back(QString::fromStdString(label.name), label.id);
  fill_regions(regions);
  show_buttons();
}

// A list that is open stays so while nothing in it changes.
void MeasureControls::fill_regions(const std::vector<std::pair<QString, std::uint8_t>>& regions) {
  bool same = region_->count() == static_cast<int>(regions.size());
  for (int n = 0; same && n < region_->count(); ++n) {
    const auto& [name, id] = regions[static_cast<std::size_t>(n)];
    same = region_->itemText(n) == name && region_->itemData(n).toInt() == id;
  }
  if (same) return;
  const bool is_new = region_->count() == 0;
  const int was = is_new ? meter()->label() : region_->currentData().toInt();
  region_->clear();
  for (const auto& [name, id] : regions) region_->addItem(name, id);
  region_->setCurrentIndex(std::max(region_->findData(was), 0));
}

}  // namespace tidemark::ui
