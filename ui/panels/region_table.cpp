#include "ui/panels/region_table.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>

#include "core/csv.h"
#include "engine/case_proxy.h"
#include "ui/panels/value_unit.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

QString text(const char* words) {
  return QCoreApplication::translate("RegionTable", words);
}

// How a table writes its numbers.
struct Notation {
  QLocale locale;
  [[nodiscard]] QString number(double value, int decimals) const {
    return locale.toString(rounded(value, decimals), 'f', decimals);
  }
  [[nodiscard]] QString count(std::int64_t value) const {
    return locale.toString(static_cast<qlonglong>(value));
  }
};

constexpr int kFigures = 6;  // volume, area, voxels, mean, SD, length or angle

QStringList cells(const RegionRow& row, const Notation& notation) {
  return {row.name,
          notation.number(row.volume_ml, 3),
          row.area_mm2 ? notation.number(*row.area_mm2, 1) : QString(),
          notation.count(row.voxels),
          row.values ? notation.number(row.values->mean, 3) : QString(),
          row.values ? notation.number(row.values->standard_deviation, 3) : QString(),
          QString()};
}

QStringList cells(const engine::Measurement& measurement, const QString& name, const Notation& notation) {
  QStringList row(kFigures + 1);
  row.first() = name;
  row.last() = notation.number(measurement.value(), 2);
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

// Names of columns do not depend on the language: programs read them.
std::string to_csv(engine::CaseProxy& proxy) {
  const QString unit = value_unit(proxy.volume());
  QLocale plain = QLocale::c();
  plain.setNumberOptions(QLocale::OmitGroupSeparator);
  const Notation notation{plain};
  std::string csv =
      csv_row({QStringLiteral("name"), QStringLiteral("volume_ml"), QStringLiteral("area_mm2"),
               QStringLiteral("voxels"), QStringLiteral("mean"), QStringLiteral("sd"),
               QStringLiteral("value_unit"), QStringLiteral("measured"), QStringLiteral("measured_unit")});
  for (const RegionRow& row : region_rows(proxy.state())) {
    QStringList line = cells(row, notation);
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
  const Notation notation{number_locale()};
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
