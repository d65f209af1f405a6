#include "ui/results/case_report.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QDateTime>
#include <QLocale>
#include <QStringList>

#include "core/atomic_file.h"
#include "document/label_tool.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/pdf_file.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

constexpr QSize kPicture(250, 280);  // px at 96 dots per inch: two beside each other on a page

// A region of the case with its measures.
struct Reported {
  QString name;
  QString colour;  // "#rrggbb"
  document::Measures measures;
};

QString text(const std::string& words) {
  return QString::fromStdString(words).toHtmlEscaped();
}

QString cells(const QStringList& all, const char* tag) {
  QString line = QStringLiteral("<tr>");
  for (const QString& cell : all)
    line += QStringLiteral("<%1 align='left'>%2</%1>").arg(QLatin1String(tag), cell);
  return line + QStringLiteral("</tr>");
}

QString table(const QStringList& heads, const QList<QStringList>& rows) {
  QString whole = QStringLiteral("<table border='1' cellspacing='0' cellpadding='4'>");
  if (!heads.isEmpty()) whole += cells(heads, "th");
  for (const QStringList& row : rows) whole += cells(row, "td");
  return whole + QStringLiteral("</table>");
}

QString heading(const QString& words) {
  return QStringLiteral("<h2>%1</h2>").arg(words);
}

QString mm(double value) {
  return size_text(value, 1, tr("mm"));
}

Result<std::vector<Reported>> measure_all(const ReportSource& source,
                                          const document::SessionContents& contents) {
  const document::LabelVoxels regions{contents.geometry, contents.labels, contents.label_voxels,
                                      contents.phi};
  const auto images =
      document::images_on(contents.geometry, {source.study.toStdString(), source.volume}, contents.images);
  if (!images) return pass_on(images);
  std::vector<Reported> all;
  const auto add = [&](const QString& name, const QString& colour, std::uint8_t label) -> Status {
    const Region region = regions.region(label);
    if (region.empty()) return {};
    auto measures = document::measure(region, contents.geometry, *images,
                                      label == document::kTheSurface ? contents.phi.get() : nullptr);
    if (!measures) return pass_on(measures);
    all.push_back({name, colour, std::move(*measures)});
    return {};
  };
  if (contents.phi) TIDEMARK_TRY(add(tr("Surface"), QStringLiteral("#edb873"), document::kTheSurface));
  for (const document::Label& label : contents.labels) {
    const auto [red, green, blue] = label.colour;
    const QString colour =
        QStringLiteral("#%1").arg((red << 16) | (green << 8) | blue, 6, 16, QLatin1Char('0'));
    TIDEMARK_TRY(add(text(label.name), colour, label.id));
  }
  return all;
}

QString head(const ReportSource& source) {
  QList<QStringList> rows;
  if (source.patient) {
    rows << QStringList{tr("Patient"), text(source.patient->name)}
         << QStringList{tr("ID"), text(source.patient->id)};
    const QString sex_age =
        QStringList{text(source.patient->sex), text(source.patient->age)}.join(u' ').trimmed();
    if (!sex_age.isEmpty()) rows << QStringList{tr("Sex, age"), sex_age};
  }
  rows << QStringList{tr("Study"), source.study.toHtmlEscaped()};
  if (!source.date.isEmpty()) rows << QStringList{tr("Date of the study"), source.date.toHtmlEscaped()};
  rows << QStringList{tr("Date of the report"),
                      QLocale().toString(QDateTime::currentDateTime(), QLocale::ShortFormat).toHtmlEscaped()};
  return QStringLiteral("<h1>%1</h1>").arg(tr("Segmentation report")) + table({}, rows);
}

QString sizes(const std::vector<Reported>& regions) {
  QList<QStringList> rows;
  for (const Reported& region : regions) {
    const document::Measures& all = region.measures;
    const imaging::Diameters& d = all.diameters;
    rows << QStringList{QStringLiteral("<span style='color:%1'>■</span> %2").arg(region.colour, region.name),
                        size_text(all.volume_ml, 2, tr("ml")),
                        tr("%1 × %2").arg(size_text(d.in_slice.length_mm(), 1), mm(d.across.length_mm())),
                        mm(d.longest.length_mm()),
                        size_text(all.area_mm2, 0, tr("mm²")),
                        number_text(all.sphericity, 3)};
  }
  return table({tr("Region"), tr("Volume"), tr("In a slice"), tr("Longest"), tr("Area"), tr("Sphericity")},
               rows);
}

QString values(const std::vector<Reported>& regions) {
  QList<QStringList> rows;
  bool has_uptake = false;
  for (const Reported& region : regions) {
    for (const document::ImageValues& image : region.measures.images) {
      const imaging::InsideValues& inside = image.values;
      const int decimals = inside.uptake ? 2 : value_decimals(image.span);
      const QString unit = text(image.unit);
      const QString name = text(image.image);
      rows << QStringList{
          region.name,
          image.covered < 1.0 ? tr("%1 (covers %2 of the region)").arg(name, share_text(image.covered))
                              : name,
          tr("%1 ± %2").arg(number_text(inside.mean, decimals),
                            number_text(inside.standard_deviation, decimals, unit)),
          number_text(inside.percentiles[imaging::kPercentiles.size() / 2], decimals, unit),
          tr("%1 to %2")
              .arg(number_text(inside.smallest, decimals), number_text(inside.largest, decimals, unit))};
      has_uptake |= inside.uptake.has_value();
      rows.back() << (inside.uptake
                          ? tr("%1; %2").arg(number_text(inside.uptake->peak, 2),
                                             number_text(inside.uptake->total_glycolysis, 1, tr("g")))
                          : QString());
    }
  }
  QStringList heads{tr("Region"), tr("Image"), tr("Mean ± SD"), tr("Median"), tr("Range")};
  if (has_uptake) {
    heads << tr("Peak (1 ml); total lesion glycolysis");
  } else {
    for (QStringList& row : rows) row.removeLast();
  }
  return table(heads, rows);
}

QString measured_lines(const std::vector<engine::Measurement>& measurements) {
  QList<QStringList> rows;
  for (const engine::Measurement& one : measurements) {
    const bool distance = one.kind == engine::Measurement::Kind::distance;
    rows << QStringList{distance ? tr("Distance") : tr("Angle"),
                        distance ? mm(one.value()) : number_text(one.value(), 1, QStringLiteral("°"))};
  }
  return table({}, rows);
}

QString picture(const QImage& image) {
  QByteArray png;
  QBuffer buffer(&png);
  buffer.open(QIODevice::WriteOnly);
  image.save(&buffer, "PNG");
  const QSize size = image.size().scaled(kPicture, Qt::KeepAspectRatio);
  return QStringLiteral("<img width='%1' height='%2' src='data:image/png;base64,%3'/>")
      .arg(size.width())
      .arg(size.height())
      .arg(QString::fromLatin1(png.toBase64()));
}

// Two beside each other.
QString pictures(const std::vector<std::pair<QString, QImage>>& all) {
  QString whole = QStringLiteral("<table cellpadding='4'>");
  for (std::size_t n = 0; n < all.size(); n += 2) {
    whole += QStringLiteral("<tr>");
    for (std::size_t m = n; m < std::min(n + 2, all.size()); ++m)
      whole += QStringLiteral("<td valign='top'>%1<br/>%2</td>")
                   .arg(picture(all[m].second), all[m].first.toHtmlEscaped());
    whole += QStringLiteral("</tr>");
  }
  return whole + QStringLiteral("</table>");
}

}  // namespace

Result<QString> report_page(const ReportSource& source, const document::SessionContents& contents) {
  const auto regions = measure_all(source, contents);
  if (!regions) return pass_on(regions);
  QString page = head(source);
  if (!regions->empty())
    page += heading(tr("Regions")) + sizes(*regions) + heading(tr("Values inside")) + values(*regions);
  if (!source.measurements.empty()) page += heading(tr("Measurements")) + measured_lines(source.measurements);
  if (!source.parameters.empty()) {
    QList<QStringList> rows;
    for (const auto& [name, value] : source.parameters)
      rows << QStringList{name.toHtmlEscaped(), value.toHtmlEscaped()};
    page += heading(tr("How the surface was made")) + table({}, rows);
  }
  if (!source.pictures.empty())
    page += QStringLiteral("<h2 style='page-break-before:always'>%1</h2>").arg(tr("Pictures")) +
            pictures(source.pictures);
  page +=
      QStringLiteral("<p>%1</p>")
          .arg(
              tr("Made with Tidemark %1. In a slice: the longest diameter in an axial slice, and the longest "
                 "at right angles to it. Nobody has verified this report.")
                  .arg(QCoreApplication::applicationVersion()));
  return page;
}

Status write_report(const ReportSource& source, const document::SessionContents& contents,
                    const std::filesystem::path& file) {
  const auto page = report_page(source, contents);
  if (!page) return pass_on(page);
  const QString title = tr("Segmentation report");
  if (is_pdf_name(file)) return write_pdf_file(*page, title, file);
  const QString whole = QStringLiteral(
                            "<!DOCTYPE html>\n<html><head><meta charset='utf-8'><title>%1</title>"
                            "<style>body{font-family:sans-serif;max-width:60em;margin:2em auto}"
                            "table{border-collapse:collapse}</style></head><body>%2</body></html>\n")
                            .arg(title, *page);
  return write_file(file, whole.toStdString());
}

}  // namespace tidemark::ui
