// Session files: a case comes back as it was, and bad files are refused.
#include <zip.h>

#include <QFile>
#include <cstring>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "cases.h"
#include "document/checksum.h"
#include "document/session_file.h"
#include "tests/document/archives.h"
#include "tests/support/child_process.h"
#include "tests/support/test_program.h"

namespace tidemark::test::session_test {

using Json = nlohmann::json;

namespace {

void write_bytes(const std::filesystem::path& file, const QByteArray& bytes) {
  QFile opened(QString::fromStdString(file.string()));
  if (!opened.open(QIODevice::WriteOnly) || opened.write(bytes) != bytes.size()) qFatal("cannot write");
}

void must(const Status& status) {
  if (!status) qFatal("%s", status.error().message.c_str());
}

std::unique_ptr<document::Case> labelled_case(solver::ExecutorKind kind = solver::ExecutorKind::host) {
  solver::ExecutorOptions options;
  options.threads = 1;
  document::StudyOrigin origin;
  origin.phantom = "lumpy";
  origin.series_uid = "1.2.3";
  origin.policy = {imaging::GridPolicy::Tilt::keep, imaging::GridPolicy::Gaps::fill};
  auto document =
      std::move(document::Case::create(lumpy_volume(), origin, lumpy_parameters(), kind, options).value());
  document::LevelSet& level_set = document->level_set();
  must(level_set.begin(seed_in(*document->volume())));
  level_set.note({0, 1.5, 300.0, 0.25});
  run(level_set, 12);
  const auto accepted =
      document->accept_surface(document->labels().add("Lümp, \"one\"").value(), document::Take::free_voxels);
  if (!accepted) qFatal("%s", accepted.error().message.c_str());
  document::Label label = document->labels().list()[0];
  label.locked = true;
  label.colour = {1, 2, 3};
  label.meaning = imaging::find_segment_meaning("tumour").value();
  must(document->labels().set(label));
  document->labels().add("empty").value();
  must(level_set.paint(ball_at(*document->volume(), {5, 0, 0}, 4.0), solver::Brush::add));
  run(level_set, 9);
  must(document->smooth_source(0.7));
  run(level_set, 9);
  level_set.note({30, 1.0 / 3.0, 310.5, 1e-5});
  document->view_state = "{\"slice\": 12}";
  return document;
}

}  // namespace

class SessionTest : public QObject {
  Q_OBJECT

 private slots:
  void a_case_comes_back_as_it_was_data() { add_executors(); }
  void a_case_comes_back_as_it_was() {
    const TemporaryFolder folder;
    const auto document = labelled_case(this_executor());
    QVERIFY(document->changed_since_save());
    QCOMPARE(failure(document::save_session(*document, folder / "one.tidemark")), QString());
    QVERIFY(!document->changed_since_save());
    const auto contents = document::load_session(folder / "one.tidemark");
    QCOMPARE(failure(contents), QString());
    QCOMPARE(contents->origin, document->origin());
    QCOMPARE(contents->origin.checksum, document::checksum_of(*document->volume()));
    QCOMPARE(contents->recipe.source.checksum, contents->origin.checksum);
    QVERIFY(contents->recipe.source.policy == document->origin().policy);
    QVERIFY(document::match(*contents, *document->volume()) == document::VolumeMatch::same);
    solver::ExecutorOptions options;
    options.threads = 1;
    const auto restored = document::restore_case(*contents, document->volume(), this_executor(), options);
    QCOMPARE(failure(restored), QString());
    document::LevelSet& before = document->level_set();
    document::LevelSet& after = (*restored)->level_set();
    QVERIFY(values_of(after) == values_of(before));
    QCOMPARE(after.step(), std::int64_t{30});
    QVERIFY(after.parameters() == before.parameters());
    QVERIFY(after.recipe().events == before.recipe().events);
    QCOMPARE(after.smoothed_mm(), 0.7);
    QVERIFY((*restored)->labels().list() == document->labels().list());
    QVERIFY((*restored)->labels().region(1) == document->labels().region(1));
    QVERIFY(*after.curve().points() == *before.curve().points());
    QCOMPARE((*restored)->view_state, document->view_state);
    QVERIFY(!(*restored)->changed_since_save());
    // Steps that were computed before it was saved can be taken back, too.
    run(after, 3);
    QVERIFY((*restored)->changed_since_save());
    QCOMPARE(failure(after.step_back(13)), QString());
    QCOMPARE(failure(before.step_back(10)), QString());
    QVERIFY(values_of(after) == values_of(before));
    QCOMPARE(failure(after.restart()), QString());
    QCOMPARE(failure(before.restart()), QString());
    QVERIFY(values_of(after) == values_of(before));
  }

  void sides_that_nobody_knows_stay_unknown() {
    const TemporaryFolder folder;
    const auto document = labelled_case();
    auto contents = document::snapshot_of(*document);
    QCOMPARE(failure(contents), QString());
    contents->geometry.oriented = false;
    QCOMPARE(failure(document::write_session(*contents, folder / "one.tidemark")), QString());
    const auto again = document::load_session(folder / "one.tidemark");
    QCOMPARE(failure(again), QString());
    QVERIFY(!again->geometry.oriented && !again->phi->geometry.oriented);
  }

  // They wait for strokes outside, or for the function that learns from them.
  void strokes_that_drive_nothing_yet_come_back_data() {
    QTest::addColumn<bool>("learns");
    QTest::newRow("tent") << false;
    QTest::newRow("examples") << true;
  }
  void strokes_that_drive_nothing_yet_come_back() {
    QFETCH(bool, learns);
    const TemporaryFolder folder;
    const auto document = labelled_case();
    document::Drive drive = document->level_set().drive();
    drive.strokes = std::make_shared<const solver::Strokes>(solver::Strokes{{11, 12, 500}, {}});
    if (learns) drive.setting.terms = {{"examples", {{"trees", 12.0}}}};
    auto walls = std::make_shared<solver::Constraints>(document->volume()->geometry.size);
    walls->set(document->volume()->geometry, ball_at(*document->volume(), {9, 0, 0}, 3.0),
               solver::Constraint::wall);
    drive.constraints = std::move(walls);
    must(document->level_set().set_drive(drive));
    must(document::save_session(*document, folder / "one.tidemark"));
    const auto contents = document::load_session(folder / "one.tidemark");
    QCOMPARE(failure(contents), QString());
    QVERIFY(!contents->recipe.final_drive()->strokes);
    const auto restored =
        document::restore_case(*contents, document->volume(), solver::ExecutorKind::host, {});
    QCOMPARE(failure(restored), QString());
    document::LevelSet& after = (*restored)->level_set();
    QVERIFY(after.drive().strokes);
    QVERIFY(*after.drive().strokes == *drive.strokes);
    QVERIFY(after.drive().setting == drive.setting);
    QVERIFY(!(*restored)->changed_since_save());
    // Until there is a function the tent goes on, and walls hold at once: they are the recipe's.
    QVERIFY(!after.lacks_speed());
    QVERIFY(after.drive().constraints);
    QCOMPARE(after.drive().constraints, after.recipe().final_drive()->constraints);
    // Saved again, nothing is lost.
    must(document::save_session(**restored, folder / "two.tidemark"));
    const auto again = document::load_session(folder / "two.tidemark");
    QCOMPARE(failure(again), QString());
    QVERIFY(again->wanted_drive);
    QVERIFY(*again->wanted_drive->strokes == *drive.strokes);
  }

  void strokes_whose_function_is_not_learnt_yet_come_back() {
    const TemporaryFolder folder;
    const auto document = labelled_case();
    document::LevelSet& level_set = document->level_set();
    const Volume& volume = *document->volume();
    solver::Strokes strokes;
    for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); offset += 17) {
      if (volume.value(offset) > 800.0F) strokes.inside.push_back(offset);
      if (volume.value(offset) < 650.0F) strokes.outside.push_back(offset);
    }
    document::Drive drive;
    drive.setting.terms = {{"examples", {{"trees", 12.0}}}};
    drive.strokes = std::make_shared<const solver::Strokes>(strokes);
    must(level_set.set_drive(drive));
    const auto speed = document::make_speed(drive, level_set.source(), level_set.parameters());
    QCOMPARE(failure(speed), QString());
    must(level_set.set_speed(*speed));
    run(level_set, 5);
    must(level_set.end_run());
    // One more, of which nothing is learnt before it is saved.
    strokes.inside.pop_back();
    drive.strokes = std::make_shared<const solver::Strokes>(strokes);
    must(level_set.set_drive(drive));
    must(document::save_session(*document, folder / "one.tidemark"));
    const auto contents = document::load_session(folder / "one.tidemark");
    QCOMPARE(failure(contents), QString());
    const auto restored =
        document::restore_case(*contents, document->volume(), solver::ExecutorKind::host, {});
    QCOMPARE(failure(restored), QString());
    document::LevelSet& after = (*restored)->level_set();
    QVERIFY(*after.drive().strokes == strokes);
    QVERIFY(after.lacks_speed());
    // The function that the restored case has learnt is that of the new strokes.
    const auto learnt = document::make_speed(after.drive(), after.source(), after.parameters());
    QCOMPARE(failure(learnt), QString());
    must(after.set_speed(*learnt));
    QVERIFY(!after.lacks_speed());
    QVERIFY(*after.recipe().final_drive()->strokes == strokes);
    QVERIFY(!after.wanted_drive());
  }

  void a_truth_from_a_file_comes_back() {
    const TemporaryFolder folder;
    const auto document = labelled_case();
    document::SessionContents contents = document::snapshot_of(*document).value();
    QVERIFY(!contents.truth);
    must(document::write_session(contents, folder / "none.tidemark"));
    QVERIFY(!document::load_session(folder / "none.tidemark").value().truth);
    const document::Labels& labels = document->labels();
    contents.truth = std::make_shared<const BitMask>(labels.geometry(), labels.region(1));
    QVERIFY(contents.truth->count() > 0);
    must(document::write_session(contents, folder / "one.tidemark"));
    const document::SessionContents again = document::load_session(folder / "one.tidemark").value();
    QVERIFY(again.truth);
    QVERIFY(Region(*again.truth) == labels.region(1));
    QCOMPARE(again.truth->geometry().size, document->volume()->geometry.size);
    Entries entries = entries_of(folder / "one.tidemark");
    entries["truth"].resize(5);
    write_entries(folder / "cut.tidemark", entries);
    const QString why = failure(document::load_session(folder / "cut.tidemark"));
    QVERIFY2(why.contains("truth has 5 bytes"), qPrintable(why));
  }

  void a_session_from_before_there_were_curves_is_read() {
    const TemporaryFolder folder;
    must(document::save_session(*labelled_case(), folder / "new.tidemark"));
    Entries entries = entries_of(folder / "new.tidemark");
    Json json = Json::parse(entries["session.json"]);
    json.erase("curve");
    entries["session.json"] = json.dump();
    write_entries(folder / "old.tidemark", entries);
    const auto contents = document::load_session(folder / "old.tidemark");
    QCOMPARE(failure(contents), QString());
    QVERIFY(contents->curve.points()->empty());
  }

  void a_case_without_a_surface_comes_back() {
    const TemporaryFolder folder;
    document::StudyOrigin origin;
    origin.path = folder / "study.nii";
    write_bytes(origin.path, "study");
    const auto document = std::move(
        document::Case::create(lumpy_volume(), origin, lumpy_parameters(), solver::ExecutorKind::host, {})
            .value());
    QCOMPARE(failure(document::save_session(*document, folder / "one.tidemark")), QString());
    const auto contents = document::load_session(folder / "one.tidemark");
    QCOMPARE(failure(contents), QString());
    const auto restored =
        document::restore_case(*contents, document->volume(), solver::ExecutorKind::host, {});
    QCOMPARE(failure(restored), QString());
    QVERIFY(!(*restored)->level_set().begun());
  }

  // 32-bit counts end at 2,147,483,648 voxels.
  void a_grid_of_more_voxels_than_32_bits_count_comes_back() {
    const TemporaryFolder folder;
    document::SessionContents contents = document::snapshot_of(*labelled_case()).value();
    contents.history = {};
    contents.labels.clear();
    contents.label_voxels.reset();
    contents.geometry.size = contents.recipe.source.size = {1100, 1100, 1800};
    contents.phi = std::make_shared<const solver::Field>(
        solver::Field::empty(contents.geometry, contents.phi->band, contents.phi->layout.page_shape()));
    document::Drive drive;
    const solver::Strokes strokes{{std::int64_t{1} << 31}, {}};
    drive.strokes = std::make_shared<const solver::Strokes>(strokes);
    contents.wanted_drive = std::make_shared<const document::Drive>(drive);
    must(document::write_session(contents, folder / "one.tidemark"));
    const auto read = document::load_session(folder / "one.tidemark");
    QCOMPARE(failure(read), QString());
    QCOMPARE(read->geometry.size, contents.geometry.size);
    QVERIFY(same_pages(*read->phi, *contents.phi));
    QVERIFY(*read->wanted_drive->strokes == strokes);
  }

  void the_study_is_found_again_when_both_have_moved() {
    const TemporaryFolder folder;
    std::filesystem::create_directories(folder / "a/sessions");
    document::StudyOrigin origin;
    origin.path = folder / "a/study.nii";
    write_bytes(origin.path, "study");
    const auto document = std::move(
        document::Case::create(lumpy_volume(), origin, lumpy_parameters(), solver::ExecutorKind::host, {})
            .value());
    QCOMPARE(failure(document::save_session(*document, folder / "a/sessions/one.tidemark")), QString());
    QCOMPARE(document::load_session(folder / "a/sessions/one.tidemark")->origin.path, folder / "a/study.nii");
    std::filesystem::rename(folder / "a", folder / "b");
    QCOMPARE(document::load_session(folder / "b/sessions/one.tidemark")->origin.path, folder / "b/study.nii");
    std::filesystem::rename(folder / "b/sessions", folder / "elsewhere");
    QCOMPARE(document::load_session(folder / "elsewhere/one.tidemark")->origin.path, folder / "a/study.nii");
  }

  void another_volume_is_noticed() {
    const auto document = labelled_case();
    const auto contents = document::snapshot_of(*document).value();
    Volume other = *document->volume();
    std::get<std::vector<std::int16_t>>(other.voxels)[77] += 1;
    QVERIFY(document::match(contents, other) == document::VolumeMatch::other_voxels);
    const auto shared = std::make_shared<const Volume>(other);
    QVERIFY(document::restore_case(contents, shared, solver::ExecutorKind::host, {}));
    const auto small = lumpy_volume({20, 20, 20});
    QVERIFY(document::match(contents, *small) == document::VolumeMatch::other_grid);
    QCOMPARE(document::restore_case(contents, small, solver::ExecutorKind::host, {}).error().kind,
             ErrorKind::input);
  }

  void a_session_that_cannot_be_written_leaves_the_old_one() {
    const auto document = labelled_case();
    QCOMPARE(document::save_session(*document, "/nowhere/one.tidemark").error().kind, ErrorKind::write);
    QVERIFY(document->changed_since_save());
  }

  // Names of one letter deflate to nearly nothing: what counts is what the reader will have to read.
  void a_session_with_more_text_than_is_read_is_not_written() {
    const TemporaryFolder folder;
    auto contents = document::snapshot_of(*labelled_case()).value();
    document::CaseImage image;
    image.name = std::string(std::size_t{1} << 20, 'a');
    contents.images.assign(40, std::make_shared<const document::CaseImage>(image));
    const Status written = document::write_session(contents, folder / "one.tidemark");
    QVERIFY(!written);
    QCOMPARE(written.error().kind, ErrorKind::write);
    QVERIFY2(failure(written).contains("one.tidemark: session.json has "), qPrintable(failure(written)));
    QVERIFY(std::filesystem::is_empty(folder.path()));
    contents.images.resize(10);
    QCOMPARE(failure(document::write_session(contents, folder / "one.tidemark")), QString());
    QCOMPARE(failure(document::load_session(folder / "one.tidemark")), QString());
  }

  void a_study_at_a_map_s_coordinates_comes_back() {
    const TemporaryFolder folder;
    auto contents = document::snapshot_of(*labelled_case()).value();
    contents.geometry.origin_mm = {4.5e9, -2e7, 0.0};
    QCOMPARE(failure(document::write_session(contents, folder / "one.tidemark")), QString());
    const auto read = document::load_session(folder / "one.tidemark");
    QCOMPARE(failure(read), QString());
    QCOMPARE(read->geometry, contents.geometry);
  }

  void a_bad_session_is_refused_data() {
    QTest::addColumn<int>("spoiler");
    QTest::addColumn<QString>("says");
    for (std::size_t i = 0; i < spoilers().size(); ++i) {
      QTest::newRow(spoilers()[i].name) << int(i) << QString(spoilers()[i].says);
    }
  }
  void a_bad_session_is_refused() {
    QFETCH(int, spoiler);
    QFETCH(QString, says);
    const TemporaryFolder folder;
    static const Entries good = [] {
      const TemporaryFolder other;
      must(document::save_session(*labelled_case(), other / "good.tidemark"));
      return entries_of(other / "good.tidemark");
    }();
    Entries entries = good;
    spoilers()[static_cast<std::size_t>(spoiler)].spoil(entries);
    write_entries(folder / "bad.tidemark", entries);
    expect_refusal(folder / "bad.tidemark", says);
  }

  void a_session_cut_anywhere_is_refused() {
    const TemporaryFolder folder;
    must(document::save_session(*labelled_case(), folder / "good.tidemark"));
    const QByteArray good = bytes_of(folder / "good.tidemark");
    for (qsizetype length = 0; length < good.size(); length += 1 + good.size() / 40) {
      write_bytes(folder / "cut.tidemark", good.left(length));
      expect_refusal(folder / "cut.tidemark", "cut.tidemark: ");
    }
  }

  void what_is_no_session_is_called_so_in_plain_words() {
    const TemporaryFolder folder;
    write_bytes(folder / "letter.tidemark", "Dear colleague,");
    expect_refusal(folder / "letter.tidemark", "is damaged, or was not written by Tidemark");
    expect_refusal(folder / "nowhere.tidemark", "cannot be read");
  }

  // In 60 KB or less: what they inflate to is bounded by the size of the file and 64 MiB.
  void a_small_session_takes_little_memory_data() {
    QTest::addColumn<int>("bytes");
    QTest::addColumn<QString>("says");
    QTest::newRow("too long") << 60'000'000 << "session.json has 60000003 bytes";
    QTest::newRow("too many values") << 30'000'000 << "more than 2097152 values";
  }
  void a_small_session_takes_little_memory() {
    QFETCH(int, bytes);
    QFETCH(QString, says);
    const TemporaryFolder folder;
    std::string list = "[";
    while (list.size() < static_cast<std::size_t>(bytes)) list += "1,";
    Entries entries;
    entries["session.json"] = list + "1]";
    write_entries(folder / "small.tidemark", entries);
    list = {};
    entries.clear();
    QVERIFY(std::filesystem::file_size(folder / "small.tidemark") < 300'000);
    const Ended ended = run_in_child(
        [&]() -> Status {
          const auto contents = document::load_session(folder / "small.tidemark");
          if (!contents) return pass_on(contents);
          return {};
        },
        {.more_memory = std::int64_t{64} << 20});
    QVERIFY(!ended.was_killed);
    QVERIFY2(QString::fromStdString(ended.failure).contains(says), ended.failure.c_str());
  }

  void a_session_with_changed_bytes_is_refused_or_read() {
    const TemporaryFolder folder;
    must(document::save_session(*labelled_case(), folder / "good.tidemark"));
    const QByteArray good = bytes_of(folder / "good.tidemark");
    int refused = 0;
    for (int i = 0; i < 60; ++i) {
      QByteArray bad = good;
      const qsizetype at = i * (good.size() / 60);
      bad[at] = static_cast<char>(bad[at] ^ 0x55);
      write_bytes(folder / "bad.tidemark", bad);
      if (const auto contents = document::load_session(folder / "bad.tidemark"); !contents) {
        QCOMPARE(contents.error().kind, ErrorKind::input);
        ++refused;
      }
    }
    QVERIFY(refused > 40);  // a date may be another
  }

 private:
  struct Spoiler {
    const char* name;
    std::function<void(Entries&)> spoil;
    const char* says;
  };

  static void expect_refusal(const std::filesystem::path& file, const QString& says) {
    const auto contents = document::load_session(file);
    QVERIFY(!contents);
    QCOMPARE(contents.error().kind, ErrorKind::input);
    const QString message = QString::fromStdString(contents.error().message);
    QVERIFY2(message.contains(says) && message.contains(QString::fromStdString(file.filename().string())),
             qPrintable(message));
  }

  static const std::vector<Spoiler>& spoilers() {
    const auto json = [](const std::function<void(Json&)>& change) {
      return [change](Entries& entries) {
        Json parsed = Json::parse(entries["session.json"]);
        change(parsed);
        entries["session.json"] = parsed.dump();
      };
    };
    const auto number = [](const char* entry, std::size_t index, auto value) {
      return [=](Entries& entries) {
        std::memcpy(entries[entry].data() + index * sizeof(value), &value, sizeof(value));
      };
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    static const std::vector<Spoiler> all{
        {"no json", [](Entries& e) { e.erase("session.json"); }, "session.json is missing"},
        {"no table", [](Entries& e) { e.erase("phi.table"); }, "phi.table is missing"},
        {"no pages", [](Entries& e) { e.erase("phi.pages"); }, "phi.pages is missing"},
        {"another entry", [](Entries& e) { e["extra"] = "1"; }, "entries that do not belong"},
        {"an entry that climbs", [](Entries& e) { e["../phi.table"] = "1"; }, "entries that do not belong"},
        {"json cut", [](Entries& e) { e["session.json"].resize(99); }, "not JSON"},
        {"json empty", [](Entries& e) { e["session.json"].clear(); }, "not JSON"},
        {"json deep", [](Entries& e) { e["session.json"] = std::string(99999, '['); },
         "nested more than 32 deep"},
        {"version", json([](Json& j) { j["version"] = 99; }), "version: this version"},
        {"format", json([](Json& j) { j["format"] = "tidemark recipe"; }), "format: "},
        {"recipe version", json([](Json& j) { j["recipe"]["version"] = 7; }), "recipe.version: "},
        {"recipe of another grid", json([](Json& j) { j["recipe"]["source"]["size"][0] = 5; }),
         "recipe: is of"},
        {"no study", json([](Json& j) {
           j["study"] = {
               {"series_uid", ""}, {"phantom", ""}, {"sha256", ""}, {"path", ""}, {"relative_path", ""}};
         }),
         "study: names no study"},
        {"study path 0", json([](Json& j) { j["study"]["path"] = std::string("a\0b", 3); }),
         "study: names no path"},
        {"study path long", json([](Json& j) { j["study"]["path"] = std::string(5000, 'a'); }),
         "study.path: more than 4096 bytes"},
        {"grid size", json([](Json& j) { j["grid"]["size"][2] = -4; }), "grid.size[2]: -4"},
        {"grid huge", json([](Json& j) {
           j["grid"]["size"] = {1000000, 1000000, 1000000};
         }),
         "grid.size: more voxels"},
        {"grid of more than the file holds", json([](Json& j) {
           j["grid"]["size"] = j["recipe"]["source"]["size"] = {10000, 10000, 10000};
         }),
         "phi.table has"},
        {"grid spacing", json([](Json& j) { j["grid"]["spacing_mm"][0] = "1"; }),
         "grid.spacing_mm[0]: not a number"},
        {"band", json([](Json& j) { j["phi"]["band"] = 0.5; }), "phi.band: 0.5"},
        {"page shape", json([](Json& j) {
           j["phi"]["page_shape"] = {8, 8, 7};
         }),
         "phi.page_shape: "},
        {"page shape 16", json([](Json& j) {
           j["phi"]["page_shape"] = {16, 16, 1};
         }),
         "phi.table has"},
        {"resident pages", json([](Json& j) { j["phi"]["resident_pages"] = 1 << 30; }),
         "phi.resident_pages: "},
        {"fewer pages", json([](Json& j) { j["phi"]["resident_pages"] = 1; }),
         "phi: the page table names page 1, which is not there"},
        {"table long", [](Entries& e) { e["phi.table"] += "1234"; }, "phi.table has"},
        {"table cut", [](Entries& e) { e["phi.table"].resize(8); }, "phi.table has 8 bytes"},
        {"table page", number("phi.table", 3, std::int32_t{999999}), "phi: the page table names page 999999"},
        {"table constant", number("phi.table", 3, std::int32_t{-3}), "phi: the page table names page -3"},
        {"phi NaN", number("phi.pages", 700, nan), "phi: phi is nan"},
        {"phi infinite", number("phi.pages", 700, std::numeric_limits<float>::infinity()), "phi: phi is inf"},
        {"phi beyond the band", number("phi.pages", 700, 77.0F), "phi: phi is 77"},
        {"labels cut", [](Entries& e) { e["labels"].resize(5); }, "labels has 5 bytes"},
        {"label unknown", number("labels", 9, std::uint8_t{200}), "labels: a voxel has label 200"},
        {"label twice", json([](Json& j) { j["labels"][1]["id"] = 1; }),
         "labels: label 1 is in the list twice"},
        {"label 0", json([](Json& j) { j["labels"][0]["id"] = 0; }), "labels[0].id: 0"},
        {"label colour", json([](Json& j) { j["labels"][0]["colour"][1] = 256; }),
         "labels[0].colour[1]: 256"},
        {"label meaning", json([](Json& j) { j["labels"][0]["meaning"]["type"] = 7; }),
         "labels[0].meaning.type"},
        {"label code",
         json([](Json& j) { j["labels"][0]["meaning"]["type"]["value"] = std::string(300, '1'); }),
         "labels[0].meaning.type.value: more than 256"},
        {"label name", json([](Json& j) { j["labels"][0]["name"] = std::string(300, 'n'); }),
         "labels[0].name: more than 256"},
        {"curve short", json([](Json& j) { j["curve"]["volume_ml"].erase(1); }), "curve.volume_ml: has not"},
        {"curve backwards", json([](Json& j) { j["curve"]["step"][0] = 40; }), "curve.step[1]: 30"},
        {"curve negative", json([](Json& j) { j["curve"]["surface_mm2"][1] = -1; }),
         "curve.surface_mm2[1]: -1"},
        {"curve long", json([](Json& j) { j["curve"]["step"] = std::vector<int>(5000, 1); }),
         "curve.step: more than 2000"},
        {"view state", json([](Json& j) { j["view_state"] = 5; }), "view_state: not a text"},
    };
    return all;
  }
};

TIDEMARK_TEST(SessionTest)

}  // namespace tidemark::test::session_test

#include "session_test.moc"
