// The patient is named on the screen, in a report as long as that is so, and nowhere else.
#include <QAction>
#include <QApplication>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>
#include <QTimer>
#include <array>
#include <glm/geometric.hpp>

#include "document/label_tool.h"
#include "document/session_file.h"
#include "document/zip_archive.h"
#include "engine/case_autosave.h"
#include "imaging/dicom/dicom.h"
#include "imaging/regions/diameters.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/case_exports.h"
#include "ui/main/case_files.h"
#include "ui/main/session_writer.h"
#include "ui/widgets/number_text.h"

namespace tidemark::test::privacy_story_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kName = "ZZYX^QVODIAN";
constexpr const char* kNumber = "PID4711XQ";

// A bright ball in the dark, of a patient with a name.
void write_study(const fs::path& folder) {
  Volume volume;
  volume.geometry.size = {40, 40, 20};
  volume.geometry.spacing_mm = {1.0, 1.0, 2.0};
  std::vector<std::int16_t> voxels;
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
    const glm::dvec3 away = (glm::dvec3(volume.geometry.voxel_at(offset)) - glm::dvec3(20.0, 20.0, 10.0)) *
                            glm::dvec3(1.0, 1.0, 2.0);
    voxels.push_back(static_cast<std::int16_t>(glm::dot(away, away) < 144.0 ? 100 : 0));
  }
  volume.voxels = std::move(voxels);
  imaging::DicomSeriesHeader header;
  header.modality = "CT";
  header.patient_name = kName;
  header.patient_id = kNumber;
  header.series_description = "Ball";
  const Status written = imaging::write_dicom_series(volume, header, folder);
  if (!written) qFatal("%s", written.error().message.c_str());
}

bool tells_the_patient(const std::string& text) {
  return text.find("ZZYX") != std::string::npos || text.find("QVODIAN") != std::string::npos ||
         text.find(kNumber) != std::string::npos;
}

// The first file below the folder whose name or contents tell it; empty: none does.
QString telling_file(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    if (tells_the_patient(entry.path().string()) || tells_the_patient(bytes_of(entry.path()).toStdString()))
      return QString::fromStdString(entry.path().string());
  }
  return {};
}

// Sessions are compressed.
std::string texts_of_session(const fs::path& file) {
  auto archive = document::ZipReader::open(file, document::session_entry_names());
  if (!archive) qFatal("%s", archive.error().message.c_str());
  std::string texts;
  for (const std::string_view name : {"session.json", "history.json"}) {
    const auto json = archive->read(name, archive->size(name));
    if (!json) qFatal("%s", json.error().message.c_str());
    texts.append(reinterpret_cast<const char*>(json->data()), json->size());
  }
  return texts;
}

}  // namespace

class PrivacyStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void cleanup() { desktop_.reset(); }
  void a_key_hides_who_the_patient_is();
  void titles_name_the_patient_unless_that_is_hidden();
  void names_of_files_do_not_name_the_patient();
  void the_patient_is_in_no_file_that_is_written();
  void a_report_names_the_patient_while_the_views_do();

 private:
  [[nodiscard]] fs::path written() const { return folder_ / "written"; }
  void write_everything();

  TemporaryFolder home_;
  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  ui::CaseWindow* window_ = nullptr;
  ui::SliceViewWidget* slice_ = nullptr;
};

// The study is open, and its surface has begun.
void PrivacyStoryTest::init() {
  qputenv("HOME", QByteArray::fromStdString(home_.path().string()));
  if (!fs::exists(folder_ / "study")) write_study(folder_ / "study");
  fs::create_directories(written());
  desktop_ = std::make_unique<Desktop>(solver::ExecutorKind::host, QSize(1000, 700));
  window_ = desktop_->open(QString::fromStdString((folder_ / "study").string()));
  QVERIFY(window_);
  QCOMPARE(desktop_->proxy().study().patient.name, std::string("ZZYX, QVODIAN"));
  QCOMPARE(desktop_->proxy().study().patient.id, std::string(kNumber));
  document::Start start;
  start.seeds.push_back({desktop_->proxy().display().settings().cursor_mm, 8.0});
  desktop_->proxy().begin(start);
  desktop_->proxy().add_label("Ball");
  desktop_->proxy().step(3);
  desktop_->wait_until_idle();
  slice_ = desktop_->view<ui::SliceViewWidget>("Axial");
  QVERIFY(slice_);
}

void PrivacyStoryTest::a_key_hides_who_the_patient_is() {
  desktop_->screenshot("patient-text");
  const auto is_shown = [this] { return desktop_->proxy().display().settings().patient_text; };
  QAction& action = *desktop_->window().actions().patient_text;
  QVERIFY(is_shown() && action.isChecked());
  const QImage named = slice_->grab_picture();
  desktop_->press(Qt::Key_I);
  QVERIFY(!is_shown() && !action.isChecked());
  const QImage nameless = slice_->grab_picture();
  QVERIFY(named != nameless);
  desktop_->press(Qt::Key_I);
  QVERIFY(is_shown() && action.isChecked());

  // Pictures for others have no name either way.
  const QString file = QString::fromStdString((written() / "slice.png").string());
  slice_->setFocus();
  desktop_->window().exports().write_picture(*window_, file);
  QVERIFY(Desktop::wait_for([&] { return QFile::exists(file); }));
  QVERIFY(is_shown());
  const QImage saved(file);
  QCOMPARE(saved.size(), nameless.size());
  QCOMPARE(difference(saved, nameless), 0.0);
  QVERIFY(difference(saved, named) > 0.0);
}

void PrivacyStoryTest::titles_name_the_patient_unless_that_is_hidden() {
  QCOMPARE(window_->windowTitle(), QStringLiteral("ZZYX, QVODIAN \u2013 Ball[*]"));
  QVERIFY(tells_the_patient(desktop_->window().windowTitle().toStdString()));  // the case fills it
  desktop_->press(Qt::Key_I);
  QCOMPARE(window_->windowTitle(), QStringLiteral("Ball[*]"));
  QVERIFY(!tells_the_patient(desktop_->window().windowTitle().toStdString()));
  desktop_->press(Qt::Key_I);
  QVERIFY(tells_the_patient(window_->windowTitle().toStdString()));
}

// What the dialog for a file offers, which is closed again.
void PrivacyStoryTest::names_of_files_do_not_name_the_patient() {
  QString offered;
  QTimer user;
  connect(&user, &QTimer::timeout, this, [&offered] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (!dialog) return;
    offered = QFileInfo(dialog->selectedFiles().value(0)).fileName();
    dialog->reject();
  });
  user.start(20);
  for (const bool session : {false, true}) {
    offered.clear();
    if (session) {
      desktop_->press(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
    } else {
      desktop_->press(Qt::Key_P, Qt::ControlModifier);
    }
    QVERIFY(Desktop::wait_for([&] { return !offered.isEmpty(); }));
    QVERIFY2(offered.startsWith("Ball"), qPrintable(offered));
    QVERIFY2(!tells_the_patient(offered.toStdString()), qPrintable(offered));
  }
}

// All that can be written, and a copy for the case of a crash.
void PrivacyStoryTest::write_everything() {
  ui::CaseExports& files = desktop_->window().exports();
  QStringList done;
  QObject scope;
  connect(&desktop_->window().files(), &ui::CaseFiles::written, &scope,
          [&](const QString& file) { done << file; });
  const auto name = [&](const char* file) { return QString::fromStdString((written() / file).string()); };
  files.write_picture(*window_, name("picture.png"));
  files.write_mask(*window_, name("mask.nrrd"));
  files.write_labels(*window_, name("labels.nii"));
  files.write_surface(*window_, name("surface.ply"));
  window_->session_file = name("case.tidemark");
  desktop_->window().session_writer().save(*window_);
  files.write_statistics(*window_, name("figures.csv"));
  QVERIFY(Desktop::wait_for([&] { return done.size() == 6; }));
  bool copied = false;
  connect(&window_->autosave(), &engine::CaseAutosave::saved, &scope, [&] { copied = true; });
  desktop_->proxy().step();
  desktop_->wait_until_idle();
  window_->autosave().save_now();
  QVERIFY(Desktop::wait_for([&] { return copied; }));
}

void PrivacyStoryTest::the_patient_is_in_no_file_that_is_written() {
  write_everything();
  QCOMPARE(telling_file(written()), QString());
  QCOMPARE(telling_file(home_.path()), QString());
  const std::string json = texts_of_session(written() / "case.tidemark");
  QVERIFY(json.find("patient_text") != std::string::npos);  // whether it is shown
  QVERIFY(!tells_the_patient(json));                        // with the recipe
  QSettings settings;                                       // with the list of recent studies
  settings.sync();
  QVERIFY(QFile::exists(settings.fileName()));
  QVERIFY(!tells_the_patient(bytes_of(settings.fileName().toStdString()).toStdString()));
  // The test would have noticed.
  QVERIFY(!telling_file(folder_ / "study").isEmpty());
}

void PrivacyStoryTest::a_report_names_the_patient_while_the_views_do() {
  desktop_->proxy().accept_surface(desktop_->state().labels.front().id);
  desktop_->proxy().display().change([](engine::DisplaySettings& settings) {
    settings.measurements = {{engine::Measurement::Kind::distance, {{0.0, 0.0, 0.0}, {3.0, 4.0, 0.0}}}};
  });
  desktop_->wait_until_idle();
  const auto report = [&](const char* name) {
    const fs::path file = written() / name;
    bool done = false;
    QObject scope;
    connect(&desktop_->window().files(), &ui::CaseFiles::written, &scope, [&] { done = true; });
    desktop_->window().exports().write_report(*window_, QString::fromStdString(file.string()));
    return Desktop::wait_for([&] { return done; }) ? bytes_of(file) : QByteArray();
  };
  const QByteArray named = report("named.html");
  QVERIFY(tells_the_patient(named.toStdString()));
  // The surface and the label, what drove it, the distance, and each view that is seen.
  for (const char* words : {"Surface", "Ball", "Values inside", "Driven by"})
    QVERIFY2(named.contains(words), words);
  const auto has_row = [&](const QStringList& cells) {
    return named.contains((cells.join("</td><td align='left'>") + "</td>").toUtf8());
  };
  const auto mm = [](double value) { return ui::number_text(value, 1, "mm"); };
  const engine::CaseState& state = desktop_->state();
  const Geometry& grid = desktop_->proxy().volume().geometry;
  const document::LabelVoxels labels{grid, state.labels, state.label_voxels, nullptr};
  const auto ball = imaging::diameters_of(labels.region(state.labels.front().id), grid);
  QVERIFY(ball);
  const QString in_slice = QStringLiteral("%1 × %2").arg(ui::number_text(ball->in_slice.length_mm(), 1),
                                                         mm(ball->across.length_mm()));
  const QString volume = ui::number_text(state.label_statistics.front().volume_ml, 2, "ml");
  QVERIFY(has_row({"</span> Ball", volume, in_slice, mm(ball->longest.length_mm())}));
  QVERIFY(has_row({">Distance", mm(5.0)}));
  const auto views = desktop_->window().active_case()->views();
  const auto seen = std::count_if(views.begin(), views.end(),
                                  [](const ui::PictureView* view) { return view->isVisible(); });
  QCOMPARE(named.count("data:image/png;base64,"), static_cast<qsizetype>(seen));
  const QByteArray page = report("named.pdf");
  QVERIFY(page.startsWith("%PDF") && page.size() > 10'000);
  desktop_->press(Qt::Key_I);
  const QByteArray nameless = report("nameless.html");
  QVERIFY(nameless.contains("Values inside") && !tells_the_patient(nameless.toStdString()));
  if (const QString kept = qEnvironmentVariable("TIDEMARK_SCREENSHOTS"); !kept.isEmpty()) {
    for (const char* name : {"named.html", "named.pdf"})
      QFile::copy(QString::fromStdString((written() / name).string()), kept + "/report-" + name);
  }
}

TIDEMARK_TEST(PrivacyStoryTest)

}  // namespace tidemark::test::privacy_story_test

#include "privacy_story_test.moc"
