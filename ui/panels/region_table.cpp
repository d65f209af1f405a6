#include "ui/panels/region_table.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>
#include <algorithm>

#include "core/csv.h"
#include "document/result_files.h"
#include "engine/case_proxy.h"
#include "ui/panels/value_unit.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

QString text(const char* words) {
  return QCoreApplication::translate("RegionTable", words);
}

// How a table writes its numbers: for programs with a point and all digits that tell, or for people.
struct Notation {
  bool for_programs = false;
  int of_values = 3;  // digits behind the point, of the study's values

  [[nodiscard]] QString size(double number, int decimals) const {
    return for_programs ? exact(number) : size_text(number, decimals);
  }
  [[nodiscard]] QString value(double number) const {
    return for_programs ? exact(number) : number_text(number, of_values);
  }
  [[nodiscard]] QString count(std::int64_t number) const {
    return for_programs ? QString::number(number) : count_text(number);
  }

 private:
  static QString exact(double number) { return QString::number(number + 0.0, 'g', 10); }
};

constexpr int kFigures = 6;  // volume, area, voxels, mean, SD, length or angle

QStringList cells(const RegionRow& row, const Notation& notation) {
  return {row.name,
          notation.size(row.volume_ml, 3),
          row.area_mm2 ? notation.size(*row.area_mm2, 1) : QString(),
          notation.count(row.voxels),
          row.values ? notation.value(row.values->mean) : QString(),
          row.values ? notation.value(row.values->standard_deviation) : QString(),
          QString()};
}

QStringList cells(const engine::Measurement& measurement, const QString& name, const Notation& notation) {
  QStringList row(kFigures + 1);
  row.first() = name;
  row.last() = notation.size(measurement.value(), 2);
  return row;
}

// The name and the unit of the values may come from files of others; the rest is numbers, and words of ours.
std::string csv_row(const QStringList& cells) {
  std::vector<std::string> fields;
  for (const QString& cell : cells) {
    const bool is_text = fields.empty() || fields.size() == kFigures;
    fields.push_back(is_text ? csv_text(cell.toStdString()) : cell.toStdString());
  }
  return csv_line(fields);
}

QString with_unit(const QString& name, const QString& unit) {
  return unit.isEmpty() ? name : QStringLiteral("%1 (%2)").arg(name, unit);
}

}  // namespace

QString kind_text(engine::Measurement::Kind kind) {
  return kind == engine::Measurement::Kind::distance ? text(QT_TRANSLATE_NOOP("RegionTable", "Distance"))
                                                     : text(QT_TRANSLATE_NOOP("RegionTable", "Angle"));
}

QString unit_text(engine::Measurement::Kind kind) {
  return kind == engine::Measurement::Kind::distance ? text(QT_TRANSLATE_NOOP("RegionTable", "mm"))
                                                     : QStringLiteral("°");
}

std::vector<RegionRow> region_rows(const engine::CaseState& state) {
  std::vector<RegionRow> rows;
  if (state.begun) {
    RegionRow row{text(QT_TRANSLATE_NOOP("RegionTable", "Surface")), state.surface.volume_ml,
                  state.surface.surface_mm2, state.surface.voxels_inside, std::nullopt};
    // Values are measured when the surface is still; those of another surface would mislead.
    if (row.voxels > 0 && state.inside.voxels == row.voxels) row.values = state.inside;
    rows.push_back(std::move(row));
  }
  for (std::size_t index = 0; index < state.labels.size(); ++index) {
    RegionRow row;
    row.name = QString::fromStdString(state.labels[index].name);
    if (index < state.label_statistics.size()) {
      const document::RegionStatistics& values = state.label_statistics[index];
      row.volume_ml = values.volume_ml;
      row.voxels = values.voxels;
      if (values.voxels > 0) row.values = values;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

// Names of columns and of the surface do not depend on the language: programs read them.
std::string to_csv(engine::CaseProxy& proxy) {
  const QString unit = value_unit(proxy.volume());
  const Notation notation{true};
  std::string csv =
      csv_row({QStringLiteral("name"), QStringLiteral("volume_ml"), QStringLiteral("area_mm2"),
               QStringLiteral("voxels"), QStringLiteral("mean"), QStringLiteral("sd"),
               QStringLiteral("value_unit"), QStringLiteral("measured"), QStringLiteral("measured_unit")});
  for (const RegionRow& row : region_rows(proxy.state())) {
    QStringList line = cells(row, notation);
    if (row.area_mm2) line.first() = QString::fromLatin1(document::kSurfaceSegment);
    line.insert(kFigures, row.values ? unit : QString());
    csv += csv_row(line << QString());
  }
  for (const engine::Measurement& measurement : proxy.display().settings().measurements) {
    if (!measurement.complete()) continue;
    const bool distance = measurement.kind == engine::Measurement::Kind::distance;
    QStringList line =
        cells(measurement, distance ? QStringLiteral("distance") : QStringLiteral("angle"), notation);
    line.insert(kFigures, QString());
    csv += csv_row(line << (distance ? QStringLiteral("mm") : QStringLiteral("degrees")));
  }
  return csv;
}

QString to_text(engine::CaseProxy& proxy) {
  const QString unit = value_unit(proxy.volume());
  const double span = span_between(proxy.summary().low, proxy.summary().high);
  const Notation notation{false, std::max(3, value_decimals(span))};
  QStringList lines;
  lines << QStringList{text(QT_TRANSLATE_NOOP("RegionTable", "Region")),
                       text(QT_TRANSLATE_NOOP("RegionTable", "Volume (ml)")),
                       text(QT_TRANSLATE_NOOP("RegionTable", "Area (mm²)")),
                       text(QT_TRANSLATE_NOOP("RegionTable", "Voxels")),
                       with_unit(text(QT_TRANSLATE_NOOP("RegionTable", "Mean")), unit),
                       with_unit(text(QT_TRANSLATE_NOOP("RegionTable", "SD")), unit),
                       text(QT_TRANSLATE_NOOP("RegionTable", "Measured"))}
               .join(u'\t');
  for (const RegionRow& row : region_rows(proxy.state())) lines << cells(row, notation).join(u'\t');
  for (const engine::Measurement& measurement : proxy.display().settings().measurements) {
    if (!measurement.complete()) continue;
    const QString name = with_unit(kind_text(measurement.kind), unit_text(measurement.kind));
    lines << cells(measurement, name, notation).join(u'\t');
  }
  return lines.join(u'\n') + u'\n';
}

}  // namespace tidemark::ui
