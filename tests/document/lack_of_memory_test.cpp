// The lack of memory, at each place that asks for some: what a user did fails with a reason, and the case
// goes on. As in the desktop, whoever catches the exception has the level set rebuilt.
#include <QTemporaryDir>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <new>

#include "cases.h"
#include "core/without_exceptions.h"
#include "document/segment_meshes.h"
#include "document/session_contents.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace {

std::atomic<bool> counting = false;
std::atomic<std::int64_t> left = 0;     // what is asked for after so many times is refused, once
std::atomic<std::size_t> smallest = 0;  // bytes that count

void* allocate(std::size_t bytes, std::size_t alignment) {
  if (counting && bytes >= smallest && left.fetch_sub(1) == 0) throw std::bad_alloc();
  // A multiple of the alignment, and never nothing.
  const std::size_t size = (bytes / alignment + 1) * alignment;
  void* const memory = std::aligned_alloc(alignment, size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

void* allocate_or_null(std::size_t bytes) noexcept {
  try {
    return allocate(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

}  // namespace

void* operator new(std::size_t bytes) {
  return allocate(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new[](std::size_t bytes) {
  return allocate(bytes, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocate(bytes, static_cast<std::size_t>(alignment));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocate_or_null(bytes);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocate_or_null(bytes);
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace tidemark::test::lack_of_memory_test {

namespace {

using document::Case;

solver::ExecutorOptions one_thread() {
  solver::ExecutorOptions options;
  options.threads = 1;
  return options;
}

Status steps_of(Case& document, std::int64_t steps) {
  const auto report = document.level_set().advance({.steps = steps});
  if (!report) return pass_on(report);
  return {};
}

Status painted(Case& document) {
  return document.level_set().paint(ball_at(*document.volume(), {3, 1, 0}, 3.0), solver::Brush::add);
}

Status begun_by_threshold(Case& document) {
  document::Start start;
  start.from = document::ThresholdStart{880.0, 2000.0};
  return document.level_set().begin(start);
}

// What comes before the operation, and the operation.
struct Row {
  std::function<Status(Case&)> before;
  std::function<Status(Case&)> work;
  std::size_t smallest = 0;  // bytes that are refused
};

// Libraries do not outlive every refusal: a JSON value asks for a little in its destructor, and trees of
// OpenVDB are torn down that were not whole. Where memory is lacking it lacks for large pieces first.
constexpr std::size_t kOfFiles = 2048;
constexpr std::size_t kOfMeshes = 16384;

Status twenty_steps(Case& document) {
  TIDEMARK_TRY(steps_of(document, 20));
  return document.level_set().end_run();
}

std::map<std::string, Row> rows() {
  static const QTemporaryDir folder;
  const auto nothing = [](Case&) { return Status(); };
  const auto two_entries = [](Case& document) -> Status {
    TIDEMARK_TRY(begun_by_threshold(document));
    return twenty_steps(document);
  };
  const auto add_label = [two_entries](Case& document) -> Status {
    TIDEMARK_TRY(two_entries(document));
    const auto added = document.labels().add("part");
    if (!added) return pass_on(added);
    return {};
  };
  std::map<std::string, Row> all;
  all["start"] = {nothing, begun_by_threshold};
  all["steps"] = {begun_by_threshold, twenty_steps};
  all["undo"] = {two_entries, [](Case& document) { return document.undo(); }};
  all["paint"] = {two_entries, painted};
  all["paint in a run"] = {[](Case& document) -> Status {
                             TIDEMARK_TRY(begun_by_threshold(document));
                             return steps_of(document, 10);
                           },
                           painted};
  all["label"] = {add_label, [](Case& document) -> Status {
                    const auto accepted = document.accept_surface(1, document::Take::others_too);
                    if (!accepted) return pass_on(accepted);
                    return {};
                  }};
  all["mesh"] = {two_entries,
                 [](Case& document) -> Status {
                   const auto phi = document.level_set().checkpoint();
                   if (!phi) return pass_on(phi);
                   const auto mesh = document::mesh_of(**phi);
                   if (!mesh) return pass_on(mesh);
                   return {};
                 },
                 kOfMeshes};
  all["save"] = {two_entries,
                 [](Case& document) {
                   const auto file = std::filesystem::path(folder.path().toStdString()) / "case.tidemark";
                   return document::save_session(document, file);
                 },
                 kOfFiles};
  return all;
}

std::unique_ptr<Case> small_case() {
  document::StudyOrigin origin;
  origin.phantom = "lumpy";  // a session names its study
  solver::ExecutorOptions options;
  options.threads = 1;
  auto made = std::move(document::Case::create(lumpy_volume({20, 18, 15}), origin, lumpy_parameters(),
                                               solver::ExecutorKind::host, options)
                            .value());
  (void)made->origin();  // its checksum is then known, and no thread computes it
  return made;
}

// All that a user may do next, there and back.
void check_usable(Case& document) {
  QCOMPARE(failure(document.level_set().executor().validate()), QString());
  if (!document.level_set().begun()) {
    QCOMPARE(failure(begun_by_threshold(document)), QString());
  }
  QCOMPARE(failure(painted(document)), QString());
  QCOMPARE(failure(steps_of(document, 3)), QString());
  QCOMPARE(failure(document.level_set().end_run()), QString());
  const std::vector<float> there = values_of(document.level_set());
  int undone = 0;
  for (; document.history().undo_description(); ++undone) {
    QCOMPARE(failure(document.undo()), QString());
    QCOMPARE(failure(document.level_set().executor().validate()), QString());
  }
  QVERIFY(undone >= 2);
  QVERIFY(!document.level_set().begun());
  for (; undone > 0; --undone) QCOMPARE(failure(document.redo()), QString());
  QVERIFY(values_of(document.level_set()) == there);
  QCOMPARE(failure(document.level_set().executor().validate()), QString());
}

}  // namespace

class LackOfMemoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_case_goes_on_wherever_memory_was_lacking_data() {
    QTest::addColumn<QString>("name");
    for (const auto& [name, row] : rows()) QTest::newRow(name.c_str()) << QString::fromStdString(name);
  }
  void a_case_goes_on_wherever_memory_was_lacking() {
    QFETCH(const QString, name);
    const Row row = rows().at(name.toStdString());
    smallest = row.smallest;
    int failures = 0;
    for (std::int64_t place = 0;; ++place) {
      const auto document = small_case();
      QCOMPARE(failure(row.before(*document)), QString());
      const auto labels_of = [&] {
        return std::pair(document->labels().list(), document->labels().voxels().voxels());
      };
      const auto labels = labels_of();
      left = place;
      counting = true;
      const Status done = without_exceptions([&] { return row.work(*document); });
      counting = false;
      if (left >= 0) {
        QCOMPARE(failure(done), QString());
        check_usable(*document);
        break;
      }
      const QByteArray where = QByteArray::number(qlonglong(place)) + ": " + failure(done).toUtf8();
      if (!done) {
        ++failures;
        QVERIFY2(done.error().kind == ErrorKind::capability, where);
        QVERIFY2(done.error().message.find("memory") != std::string::npos, where);
        QVERIFY2(document->level_set().rebuild(one_thread()), where);
        QVERIFY2(labels_of() == labels, where);
      }
      check_usable(*document);
      if (QTest::currentTestFailed()) QFAIL(where);
    }
    qInfo("refused at %d places", failures);
    QVERIFY(failures > 2);
  }

  void the_error_says_how_much_was_asked_for() {
    const Status failed = without_exceptions([]() -> Status {
      asking_for(std::int64_t{3} << 20, [] { throw std::bad_alloc(); });
      return {};
    });
    QCOMPARE(failure(failed), QString("there is not enough memory: 3 MB more were asked for"));
  }
};

TIDEMARK_TEST(LackOfMemoryTest)

}  // namespace tidemark::test::lack_of_memory_test

#include "lack_of_memory_test.moc"
