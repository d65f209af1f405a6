// The events that reading studies causes, and to whom they are told.
#include <QTest>
#include <mutex>

#include "imaging/audit/event.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::audit_events_test {

using imaging::AuditEvent;

namespace {

// Keeps the events while it lives.
class Recorder {
 public:
  Recorder() : sink_(std::make_shared<Sink>()) { imaging::set_audit_sink(sink_); }
  ~Recorder() { imaging::set_audit_sink(nullptr); }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;
  [[nodiscard]] const std::vector<AuditEvent>& events() const { return sink_->events; }

 private:
  struct Sink final : imaging::AuditSink {
    void take(const AuditEvent& event) override {
      const std::lock_guard lock(mutex);
      events.push_back(event);
    }
    std::mutex mutex;
    std::vector<AuditEvent> events;
  };
  std::shared_ptr<Sink> sink_;
};

}  // namespace

class AuditEventsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_study_is_opened_once_and_under_its_own_name() {
    const TemporaryFolder folder;
    for (const auto& file : write_series(sample_volume({8, 8, 3}), folder / "study")) {
      set_text(file, 0x0010, 0x0010, "Doe^Jane");
      set_text(file, 0x0010, 0x0020, "P-1");
      set_text(file, 0x0020, 0x000D, "1.2.3");
    }
    const Recorder recorder;
    QCOMPARE(failure(imaging::load_volume(folder / "study")), QString());
    QCOMPARE(recorder.events().size(), std::size_t{1});
    const AuditEvent& event = recorder.events().front();
    QVERIFY(event.kind == AuditEvent::Kind::accessed && event.failure.empty());
    QCOMPARE(event.study.patient_name, std::string("Doe, Jane"));
    QCOMPARE(event.study.patient_id, std::string("P-1"));
    QCOMPARE(event.study.study_uid, std::string("1.2.3"));
    QCOMPARE(event.study.objects.at("1.2.840.10008.5.1.4.1.1.2"), std::int64_t{3});
  }

  void a_study_that_cannot_be_loaded_is_a_failure() {
    const TemporaryFolder folder;
    const auto files = write_series(sample_volume({8, 8, 3}), folder / "study");
    const imaging::Series series = only_series(folder / "study");
    std::filesystem::remove(files[1]);
    const Recorder recorder;
    const auto loaded = imaging::load_series(series);
    QVERIFY(!loaded);
    QCOMPARE(recorder.events().size(), std::size_t{1});
    QCOMPARE(recorder.events().front().failure, loaded.error().message);
  }

  void neither_looking_around_nor_volume_files_are_events() {
    const TemporaryFolder folder;
    write_series(sample_volume({8, 8, 3}), folder / "study");
    const auto file = folder / "volume.nii.gz";
    QVERIFY(imaging::write_volume_file(sample_volume({8, 8, 3}), file).has_value());
    const Recorder recorder;
    QVERIFY(imaging::find_series(folder / "study").has_value());
    QVERIFY(imaging::load_volume(file).has_value());
    QVERIFY(recorder.events().empty());
  }

  void objects_of_one_study_are_counted_together() {
    std::vector<imaging::AuditedStudy> studies;
    for (const char* sop_class : {"1.1", "1.1", "1.2"}) add_study(studies, {"P", "N", "1", {{sop_class, 1}}});
    add_study(studies, {"P", "N", "2", {{"1.1", 1}}});
    QCOMPARE(studies.size(), std::size_t{2});
    QCOMPARE(studies[0].objects.at("1.1"), std::int64_t{2});
    QCOMPARE(studies[0].objects.at("1.2"), std::int64_t{1});
  }

  void files_are_results_and_not_the_images_of_their_study() {
    const Recorder recorder;
    const Status written = imaging::exported({}, {"P", "N", "1", {{"1.1", 3}}}, {"/a.nii"});
    QVERIFY(written.has_value());
    const Status failed =
        imaging::exported(fail(ErrorKind::write, "/b.nii: cannot write"), {"P", "N", "1", {}}, {"/b.nii"});
    QVERIFY(!failed);
    QCOMPARE(recorder.events().size(), std::size_t{2});
    QVERIFY(recorder.events()[0].study.objects.empty() && recorder.events()[0].failure.empty());
    QCOMPARE(recorder.events()[1].failure, std::string("/b.nii: cannot write"));
  }
};

TIDEMARK_TEST(AuditEventsTest)

}  // namespace tidemark::test::audit_events_test

#include "audit_events_test.moc"
