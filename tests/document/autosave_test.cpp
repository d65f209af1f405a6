// Autosave: two generations, of which the newest whole one is offered after a crash.
#include <sys/stat.h>

#include <QFile>
#include <thread>

#include "cases.h"
#include "document/autosave.h"
#include "document/recovery_folder.h"
#include "document/session_file.h"
#include "tests/support/test_program.h"

namespace tidemark::test::autosave_test {

namespace {

std::unique_ptr<document::Case> phantom_case() {
  document::StudyOrigin origin;
  origin.phantom = "lumpy";
  origin.name = "Lümp <one>";
  origin.date = "2004-07-31";
  auto made =
      document::Case::create(lumpy_volume(), origin, lumpy_parameters(), solver::ExecutorKind::host, {});
  if (!made || !(*made)->level_set().begin(seed_in(*(*made)->volume()))) qFatal("no case");
  return std::move(*made);
}

// Runs on and writes the next generation.
void go_on(document::Case& document, document::Autosave& autosave) {
  run(document.level_set(), 10);
  QCOMPARE(failure(autosave.write(document::snapshot_of(document).value())), QString());
}

std::int64_t steps_in(const document::Recoverable& copy) {
  const auto contents = document::load_session(copy.file);
  return contents ? contents->recipe.steps : -1;
}

void spoil(const std::filesystem::path& file, bool truncate) {
  QFile opened(QString::fromStdString(file.string()));
  QVERIFY(opened.open(QIODevice::ReadWrite));
  if (truncate) {
    QVERIFY(opened.resize(opened.size() / 2));
  } else {
    QVERIFY(opened.seek(opened.size() / 2));
    QCOMPARE(opened.write("spoilt"), qint64{6});
  }
}

}  // namespace

class AutosaveTest : public QObject {
  Q_OBJECT

 private slots:
  void what_a_crash_leaves_is_found() {
    const TemporaryFolder folder;
    const auto document = phantom_case();
    const std::string id = document::new_copy_id();
    {
      auto autosave = document::Autosave::create(folder / "recovery", id).value();
      QVERIFY(document::find_recoverable(folder / "recovery").empty());
      for (int i = 0; i < 3; ++i) go_on(*document, autosave);
      QVERIFY(document::find_recoverable(folder / "recovery").empty());  // it is still running
      struct stat found {};
      QCOMPARE(::stat((folder / "recovery").c_str(), &found), 0);
      QCOMPARE(found.st_mode & 0777U, 0700U);
    }  // without finish()
    const auto copies = document::find_recoverable(folder / "recovery");
    QCOMPARE(copies.size(), std::size_t{1});
    QCOMPARE(copies[0].case_id, id);
    QCOMPARE(copies[0].generation, std::uint64_t{3});
    QCOMPARE(copies[0].study.name, std::string("Lümp <one>"));
    QCOMPARE(copies[0].study.date, std::string("2004-07-31"));
    const auto contents = document::load_session(copies[0].file);
    QCOMPARE(failure(contents), QString());
    const auto restored = document::restore_case(*contents, lumpy_volume(), solver::ExecutorKind::host, {});
    QCOMPARE(failure(restored), QString());
    QVERIFY(values_of((*restored)->level_set()) == values_of(document->level_set()));
    document::discard(folder / "recovery", id);
    QVERIFY(document::find_recoverable(folder / "recovery").empty());
    QVERIFY(std::filesystem::is_empty(folder / "recovery"));
  }

  void a_copy_has_strokes_that_drive_nothing_yet() {
    const TemporaryFolder folder;
    const auto document = phantom_case();
    document::Drive drive;
    drive.strokes = std::make_shared<const solver::Strokes>(solver::Strokes{{11, 12, 500}, {}});
    QCOMPARE(failure(document->level_set().set_drive(drive)), QString());
    {
      auto autosave = document::Autosave::create(folder.path(), "case-1").value();
      go_on(*document, autosave);
    }  // without finish()
    const auto copies = document::find_recoverable(folder.path());
    QCOMPARE(copies.size(), std::size_t{1});
    const auto contents = document::load_session(copies[0].file);
    QCOMPARE(failure(contents), QString());
    const auto restored = document::restore_case(*contents, lumpy_volume(), solver::ExecutorKind::host, {});
    QCOMPARE(failure(restored), QString());
    QVERIFY((*restored)->level_set().drive().strokes);
    QVERIFY(*(*restored)->level_set().drive().strokes == *drive.strokes);
  }

  void the_older_generation_is_offered_when_the_newest_is_damaged_data() {
    QTest::addColumn<int>("damage");
    QTest::newRow("cut") << 0;
    QTest::newRow("other bytes") << 1;
    QTest::newRow("no checksum") << 2;
    QTest::newRow("checksum cut") << 3;
    QTest::newRow("new file with the old checksum") << 4;
    QTest::newRow("gone") << 5;
  }
  void the_older_generation_is_offered_when_the_newest_is_damaged() {
    QFETCH(int, damage);
    const TemporaryFolder folder;
    const auto document = phantom_case();
    auto autosave =
        std::make_unique<document::Autosave>(document::Autosave::create(folder.path(), "case-1").value());
    for (int i = 0; i < 4; ++i) go_on(*document, *autosave);
    autosave.reset();
    const document::Recoverable newest = document::find_recoverable(folder.path()).at(0);
    QCOMPARE(steps_in(newest), std::int64_t{40});
    const std::filesystem::path seal = newest.file.string() + ".sha256";
    if (damage <= 1) spoil(newest.file, damage == 0);
    if (damage == 2) std::filesystem::remove(seal);
    if (damage == 3) spoil(seal, true);
    if (damage == 4) {
      run(document->level_set(), 10);
      QCOMPARE(failure(document::write_session(document::snapshot_of(*document).value(), newest.file)),
               QString());
    }
    if (damage == 5) std::filesystem::remove(newest.file);
    const auto copies = document::find_recoverable(folder.path());
    QCOMPARE(copies.size(), std::size_t{1});
    QCOMPARE(copies[0].generation, std::uint64_t{3});
    QCOMPARE(steps_in(copies[0]), std::int64_t{30});
    spoil(copies[0].file, true);
    QVERIFY(document::find_recoverable(folder.path()).empty());
  }

  void a_clean_end_leaves_nothing() {
    const TemporaryFolder folder;
    const auto document = phantom_case();
    auto autosave = document::Autosave::create(folder.path(), "case-1").value();
    go_on(*document, autosave);
    go_on(*document, autosave);
    autosave.finish();
    QVERIFY(std::filesystem::is_empty(folder.path()));
  }

  void cases_are_told_apart_and_a_running_one_is_let_alone() {
    const TemporaryFolder folder;
    const auto document = phantom_case();
    for (const char* id : {"a", "b", "c"}) {
      auto autosave = document::Autosave::create(folder.path(), id).value();
      go_on(*document, autosave);
    }
    const auto running = document::Autosave::create(folder.path(), "b").value();
    QCOMPARE(document::Autosave::create(folder.path(), "b").error().kind, ErrorKind::write);
    const auto copies = document::find_recoverable(folder.path());
    QCOMPARE(copies.size(), std::size_t{2});
    for (const document::Recoverable& copy : copies) QVERIFY(copy.case_id != "b");
  }

  void what_a_killed_program_was_writing_is_swept() {
    const TemporaryFolder folder;
    const auto document = phantom_case();
    {
      auto dead = document::Autosave::create(folder.path(), "dead").value();
      go_on(*document, dead);
    }
    auto alive = document::Autosave::create(folder.path(), "alive").value();
    go_on(*document, alive);
    const auto touch = [&](const std::string& name) {
      QFile file(QString::fromStdString((folder / name).string()));
      QVERIFY(file.open(QIODevice::WriteOnly));
    };
    // As AtomicFile names them; the last of the first three is what is packed into it.
    const std::vector<std::string> unwanted{".tidemark-a1B2c3-dead.1.tidemark",
                                            ".tidemark-XyZ123-dead.0.tidemark.sha256",
                                            ".tidemark-q2W3e4-gone.0.tidemark.Ab1Cd2"};
    const std::vector<std::string> wanted{".tidemark-a1B2c3-alive.1.tidemark", "notes.txt",
                                          ".tidemark-notes.txt", ".tidemark-a1B2c3-.tidemark",
                                          "dead.2.tidemark"};
    for (const std::string& name : unwanted) touch(name);
    for (const std::string& name : wanted) touch(name);
    std::filesystem::create_directory(folder / ".tidemark-f0F0f0-dead.folder");
    document::sweep_unfinished(folder.path());
    for (const std::string& name : unwanted) QVERIFY2(!std::filesystem::exists(folder / name), name.c_str());
    for (const std::string& name : wanted) QVERIFY2(std::filesystem::exists(folder / name), name.c_str());
    QVERIFY(std::filesystem::exists(folder / ".tidemark-f0F0f0-dead.folder"));
    QCOMPARE(document::find_recoverable(folder.path()).size(),
             std::size_t{1});  // what is whole is still offered
    go_on(*document, alive);
    document::sweep_unfinished(folder / "none");
  }

  void copies_are_written_on_another_thread_while_the_case_goes_on() {
    const TemporaryFolder folder;
    const auto document = phantom_case();
    auto autosave = document::Autosave::create(folder.path(), "case-1").value();
    run(document->level_set(), 10);
    const document::SessionContents contents = document::snapshot_of(*document).value();
    const std::vector<float> then = values_of(document->level_set());
    Status written;
    std::jthread writer([&] { written = autosave.write(contents); });
    run(document->level_set(), 40);
    QCOMPARE(failure(document->undo()), QString());
    writer.join();
    QCOMPARE(failure(written), QString());
    const auto read = document::load_session(folder / "case-1.1.tidemark");
    QCOMPARE(failure(read), QString());
    QVERIFY(read->phi->dense() == then);
  }

  void what_is_not_a_folder_of_ones_own_is_refused() {
    const TemporaryFolder folder;
    QFile file(QString::fromStdString((folder / "file").string()));
    QVERIFY(file.open(QIODevice::WriteOnly));
    QCOMPARE(document::Autosave::create(folder / "file", "a").error().kind, ErrorKind::write);
    std::filesystem::create_directory(folder / "real");
    std::filesystem::create_directory_symlink(folder / "real", folder / "link");
    QCOMPARE(document::Autosave::create(folder / "link", "a").error().kind, ErrorKind::write);
    QCOMPARE(document::Autosave::create(folder.path(), "../a").error().kind, ErrorKind::usage);
    QCOMPARE(document::Autosave::create(folder.path(), "").error().kind, ErrorKind::usage);
    QVERIFY(document::find_recoverable(folder / "none").empty());
  }
};

TIDEMARK_TEST(AutosaveTest)

}  // namespace tidemark::test::autosave_test

#include "autosave_test.moc"
