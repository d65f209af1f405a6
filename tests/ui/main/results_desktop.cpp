#include "tests/ui/main/results_desktop.h"

#include <QAbstractSpinBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <algorithm>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom.h"
#include "ui/look/theme.h"
#include "ui/main/panel_docks.h"

namespace tidemark::test {

namespace fs = std::filesystem;

void write_balls(const fs::path& folder) {
  Volume volume;
  volume.geometry.size = {48, 40, 16};
  volume.geometry.spacing_mm = {1.0, 1.0, 2.0};
  std::vector<std::int16_t> voxels;
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
    const glm::dvec3 point = glm::dvec3(volume.geometry.voxel_at(offset)) * glm::dvec3(1.0, 1.0, 2.0);
    const bool inside = glm::distance(point, kLeft) < 9.0 || glm::distance(point, kRight) < 8.0;
    voxels.push_back(inside ? 100 : 0);
  }
  volume.voxels = std::move(voxels);
  imaging::DicomSeriesHeader header;
  header.modality = "CT";
  header.patient_name = "Phantom^Paula";
  header.patient_id = "P1";
  header.series_description = "Two balls: 1/2";
  const Status written = imaging::write_dicom_series(volume, header, folder);
  if (!written) qFatal("%s", written.error().message.c_str());
}

QPushButton* button(QWidget& in, const QString& text) {
  for (QPushButton* one : in.findChildren<QPushButton*>()) {
    if (QString(one->text()).remove('&') == text) return one;
  }
  qFatal("there is no button %s", qPrintable(text));
}

bool says(QWidget& dialog, const QString& text) {
  const auto labels = dialog.findChildren<QLabel*>();
  return std::any_of(labels.begin(), labels.end(),
                     [&](const QLabel* label) { return label->text().contains(text); });
}

bool is_explained(QWidget& dialog) {
  for (const QWidget* widget : dialog.findChildren<QWidget*>()) {
    const auto* button = qobject_cast<const QAbstractButton*>(widget);
    const bool is_control =
        button || qobject_cast<const QComboBox*>(widget) || qobject_cast<const QLineEdit*>(widget);
    const bool is_of_number =
        qobject_cast<const QAbstractSpinBox*>(widget->parentWidget());  // which has a tip
    if (!is_control || is_of_number || widget->inherits("QTableCornerButton") ||
        (button && button->text().endsWith("Close")))
      continue;
    if (!widget->toolTip().isEmpty() && (button || !widget->accessibleName().isEmpty())) continue;
    qWarning("%s “%s”", widget->metaObject()->className(), button ? qPrintable(button->text()) : "");
    return false;
  }
  return true;
}

void picture(QWidget& widget, const QString& name) {
  const QString folder = qEnvironmentVariable("TIDEMARK_SCREENSHOTS");
  if (folder.isEmpty()) return;
  for (const ui::Theme theme : {ui::Theme::dark, ui::Theme::light}) {
    ui::apply_theme(*qApp, theme);
    QTest::qWait(30);
    const char* end = theme == ui::Theme::light ? "light" : "dark";
    QVERIFY(widget.grab().save(QStringLiteral("%1/%2-%3.png").arg(folder, name, end)));
  }
}

void ResultsDesktop::open() {
  qputenv("XDG_CONFIG_HOME", QByteArray::fromStdString((folder_ / "config").string()));
  if (!fs::exists(folder_ / "study")) write_balls(folder_ / "study");
  desktop_ = std::make_unique<Desktop>(solver::ExecutorKind::host, QSize(900, 620));
  window_ = desktop_->open(path("study"));
  QVERIFY(window_);
  window_->set_layout(ui::ViewLayout::single);  // no story about pictures
  desktop_->window().panels().show("labels");
  desktop_->wait_until_idle();
}

}  // namespace tidemark::test
