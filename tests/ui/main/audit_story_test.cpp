// Two patients' studies beside each other: what is opened and written is audited under the right name.
#include <QAction>
#include <QFile>
#include <QLineEdit>
#include <QPushButton>
#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>

#include "app/desktop/audit.h"
#include "core/atomic_file.h"
#include "imaging/audit/event.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/results_desktop.h"
#include "ui/main/case_exports.h"
#include "ui/main/case_files.h"
#include "ui/results/write_result_dialog.h"

namespace tidemark::test::audit_story_test {
namespace {

namespace fs = std::filesystem;
using Kind = imaging::AuditEvent::Kind;

// Keeps the events.
class Recorder final : public imaging::AuditSink {
 public:
  void take(const imaging::AuditEvent& event) override {
    const std::lock_guard lock(mutex_);
    events_.push_back(event);
  }
  // "P1 mask.nrrd" of each event of that kind, sorted.
  QStringList all(Kind kind) {
    const std::lock_guard lock(mutex_);
    QStringList told;
    for (const imaging::AuditEvent& event : events_) {
      if (event.kind != kind) continue;
      QString line = QString::fromStdString(event.study.patient_id);
      for (const fs::path& file : event.files) line += ' ' + QString::fromStdString(file.filename().string());
      if (!event.failure.empty()) line += " failed";
      told << line;
    }
    told.sort();
    return told;
  }
  [[nodiscard]] imaging::AuditedStudy first_study() {
    const std::lock_guard lock(mutex_);
    return events_.front().study;
  }

 private:
  std::mutex mutex_;
  std::vector<imaging::AuditEvent> events_;
};

}  // namespace

class AuditStoryTest : public QObject, private ResultsDesktop {
  Q_OBJECT

 private slots:
  void init() {
    recorder_ = std::make_shared<Recorder>();
    imaging::set_audit_sink(recorder_);
    open();
  }
  void cleanup() {
    close();
    imaging::set_audit_sink(nullptr);
  }
  void each_file_is_of_the_case_that_it_was_written_of();
  void what_is_being_written_at_the_end_is_audited();

 private:
  std::shared_ptr<Recorder> recorder_;
};

void AuditStoryTest::each_file_is_of_the_case_that_it_was_written_of() {
  QCOMPARE(recorder_->all(Kind::accessed), QStringList({"P1"}));
  const imaging::AuditedStudy study = recorder_->first_study();
  QCOMPARE(study.patient_name, std::string("Phantom, Paula"));
  QVERIFY(!study.study_uid.empty());
  QCOMPARE(study.objects.begin()->second, std::int64_t{16});

  write_balls(folder_ / "other");
  for (const auto& file : fs::directory_iterator(folder_ / "other"))
    set_text(file.path(), 0x0010, 0x0020, "P2");
  ui::CaseWindow* other = desktop_->open(path("other"));
  QVERIFY(other && other != window_);
  QCOMPARE(recorder_->all(Kind::accessed), QStringList({"P1", "P2"}));

  // The case that is not active, and the one that is.
  QCOMPARE(desktop_->window().active_case(), other);
  document::Start start;
  start.seeds.push_back({kLeft, 5.0});
  for (ui::CaseWindow* window : {window_, other}) window->proxy().begin(start);
  desktop_->wait_until_idle();
  ui::CaseExports& exports = desktop_->window().exports();
  exports.write_mask(*window_, path("one.nrrd"));
  exports.write_mask(*other, path("two.nrrd"));
  exports.write_picture(*window_, path("one.png"));
  exports.write_statistics(*other, path("two.csv"));
  exports.write_report(*window_, path("one.html"));
  exports.write_surface(*other, path("missing/two.stl"));
  const QStringList expected{"P1 one.html", "P1 one.nrrd", "P1 one.png",
                             "P2 two.csv",  "P2 two.nrrd", "P2 two.stl failed"};
  QVERIFY(Desktop::wait_for([&] { return recorder_->all(Kind::exported).size() == 6; }, kPatience));
  QCOMPARE(recorder_->all(Kind::exported), expected);

  // By the dialog for other systems, of the active case.
  desktop_->window().actions().export_segmentation->trigger();
  const QPointer<ui::WriteResultDialog> dialog = other->findChild<ui::WriteResultDialog*>();
  QVERIFY(dialog);
  dialog->findChild<QLineEdit*>()->setText(path("two.dcm"));
  QTest::mouseClick(button(*dialog, "Write"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return dialog.isNull(); }, kPatience));
  QVERIFY(recorder_->all(Kind::exported).contains("P2 two.dcm"));
}

void AuditStoryTest::what_is_being_written_at_the_end_is_audited() {
  const Variable state("XDG_STATE_HOME", path("state").toUtf8());
  const fs::path configuration = folder_ / "config" / "tidemark" / "audit.json";
  fs::create_directories(configuration.parent_path());
  QVERIFY(write_file(configuration, R"({"file": "audit.log"})"));
  std::optional<desktop::Audit> audit(std::in_place, [](const Error&) {});
  QCOMPARE(failure(audit->begin()), QString());
  desktop_->window().files().write(*window_, path("slow.txt"), [file = folder_ / "slow.txt"] {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    return write_file(file, "whole");
  });
  audit.reset();
  fs::remove(configuration);
  const QByteArray log = bytes_of(configuration.parent_path() / "audit.log");
  QVERIFY2(log.contains("slow.txt"), log.constData());
  QCOMPARE(bytes_of(folder_ / "slow.txt"), QByteArray("whole"));
}

TIDEMARK_TEST(AuditStoryTest)

}  // namespace tidemark::test::audit_story_test

#include "audit_story_test.moc"
