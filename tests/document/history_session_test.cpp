// The history in session files: every state comes back, and bad files are refused.
#include <QTest>
#include <algorithm>
#include <cstring>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "document/history_file.h"
#include "document/label_segments.h"
#include "document/session_file.h"
#include "tests/document/archives.h"
#include "tests/document/cases.h"
#include "tests/document/recipes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::history_session_test {

using Json = nlohmann::json;

namespace {

void must(const Status& status) {
  if (!status) qFatal("%s", status.error().message.c_str());
}

// As begun_case(), of a study that a session can name.
std::unique_ptr<document::Case> named_case(solver::ExecutorKind kind = solver::ExecutorKind::host) {
  solver::ExecutorOptions options;
  options.threads = 1;
  document::StudyOrigin origin;
  origin.phantom = "lumpy";
  auto made = document::Case::create(lumpy_volume(), origin, lumpy_parameters(), kind, options);
  if (!made) qFatal("%s", made.error().message.c_str());
  must((*made)->level_set().begin(seed_in(*(*made)->volume())));
  return std::move(*made);
}

// Two branches from step 8, the case in the first one: with strokes, walls, labels, another start and source.
std::unique_ptr<document::Case> branched_case(solver::ExecutorKind kind = solver::ExecutorKind::host) {
  auto document = named_case(kind);
  document::LevelSet& level_set = document->level_set();
  run(level_set, 8);
  level_set.note({8, 1.0, 2.0, 3.0});
  must(level_set.end_run());
  const std::uint64_t fork = document->history().position();
  must(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), solver::Brush::add));
  const auto label = document->labels().add("kept");
  if (!label || !document->accept_surface(*label, document::Take::free_voxels)) qFatal("no label");
  run(level_set, 7);
  level_set.note({15, 1.5, 2.5, 3.5});
  must(level_set.end_run());
  must(document->smooth_source(0.6));
  const std::uint64_t first = document->history().position();
  must(document->history().go_to(fork));
  document::Drive drive = level_set.drive();
  auto walls = std::make_shared<solver::Constraints>(document->volume()->geometry.size);
  walls->set(document->volume()->geometry, ball_at(*document->volume(), {-6, 0, 0}, 3.0),
             solver::Constraint::wall);
  drive.constraints = std::move(walls);
  must(level_set.set_drive(drive));
  run(level_set, 5);
  document::Start other;
  other.from =
      document::MaskStart{std::make_shared<const BitMask>(level_set.checkpoint().value()->mask()), "m"};
  must(level_set.begin(other));
  run(level_set, 6);
  must(document->history().close());
  must(document->history().go_to(first));
  return document;
}

// The states that files keep: those of labels are none.
std::vector<document::HistoryState> states_of(const document::Case& document) {
  std::vector<document::HistoryState> states = document.history().states();
  std::erase_if(states, [](const document::HistoryState& state) {
    return state.change.kind == document::ChangeKind::new_label ||
           state.change.kind == document::ChangeKind::accept;
  });
  return states;
}

std::unique_ptr<document::Case> restored(const std::filesystem::path& file, const document::Case& document,
                                         solver::ExecutorKind kind = solver::ExecutorKind::host) {
  solver::ExecutorOptions options;
  options.threads = 1;
  const auto contents = document::load_session(file);
  if (!contents) qFatal("%s", contents.error().message.c_str());
  auto made = document::restore_case(*contents, document.volume(), kind, options);
  if (!made) qFatal("%s", made.error().message.c_str());
  return std::move(*made);
}

// Ends as an entry of its own.
void paint_strokes(document::LevelSet& level_set, std::vector<std::int64_t> inside) {
  document::Drive drive = level_set.drive();
  drive.strokes = std::make_shared<const solver::Strokes>(solver::Strokes{std::move(inside), {}});
  must(level_set.set_drive(drive));
}

void put_history(Entries& entries, const document::HistoryEntries& history) {
  for (const document::ZipEntry& entry : history.entries()) {
    std::string& bytes = entries[std::string(entry.name)];
    bytes.clear();
    for (std::size_t n = 0;; ++n) {
      const auto piece = entry.piece(n);
      if (piece.empty()) break;
      bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
    }
  }
}

// Changes of a good file that make it a bad one.
using Spoil = std::function<void(Json&, Entries&)>;
struct Bad {
  const char* name;
  const char* told;  // in the error
  Spoil spoil;
};

template <class Number>
void put(std::string& bytes, std::size_t index, Number number) {
  std::memcpy(bytes.data() + index * sizeof(Number), &number, sizeof(Number));
}

std::vector<Bad> bad_files() {
  return {
      {"no json", "history.json", [](Json&, Entries& e) { e["history.json"] = "{"; }},
      {"format", "format", [](Json& j, Entries&) { j["format"] = "other"; }},
      {"version", "version", [](Json& j, Entries&) { j["version"] = 2; }},
      {"no states", "states", [](Json& j, Entries&) { j["states"] = Json::array(); }},
      {"present", "present", [](Json& j, Entries&) { j["present"] = j["states"].size(); }},
      {"present elsewhere", "present state", [](Json& j, Entries&) { j["present"] = 0; }},
      {"its own parent", "states[2].parent", [](Json& j, Entries&) { j["states"][2]["parent"] = 2; }},
      {"no parent", "states[1].parent", [](Json& j, Entries&) { j["states"][1].erase("parent"); }},
      {"kind", "states[1].change.kind", [](Json& j, Entries&) { j["states"][1]["change"]["kind"] = "x"; }},
      {"steps", "states[1].change.steps", [](Json& j, Entries&) { j["states"][1]["change"]["steps"] = -1; }},
      {"name", "states[1].change.name",
       [](Json& j, Entries&) { j["states"][1]["change"]["name"] = std::string((1 << 20) + 1, 'x'); }},
      {"events of nobody", "common_events", [](Json& j, Entries&) { j["states"][3]["common_events"] = 99; }},
      {"events backwards", "common_events", [](Json& j, Entries&) { j["states"][4]["recipe"]["steps"] = 1; }},
      {"points of nobody", "common_points", [](Json& j, Entries&) { j["states"][3]["common_points"] = 99; }},
      {"grid", "is of another grid",
       [](Json& j, Entries&) {
         j["states"][3]["recipe"]["source"]["size"] = {3, 3, 3};
       }},
      {"alpha", "alpha", [](Json& j, Entries&) { j["states"][3]["recipe"]["parameters"]["alpha"] = "x"; }},
      {"phi of nobody", "states[3].phi", [](Json& j, Entries&) { j["states"][3]["phi"] = 99; }},
      {"other pages", "page_shape",
       [](Json& j, Entries&) {
         j["page_shape"] = {16, 16, 1};
       }},
      {"no tables", "history.tables", [](Json&, Entries& e) { e.erase("history.tables"); }},
      {"short tables", "history.tables", [](Json&, Entries& e) { e["history.tables"].resize(40); }},
      {"table", "is not there",
       [](Json&, Entries& e) { put<std::int32_t>(e["history.tables"], 3, 1 << 20); }},
      {"negative table", "is not there",
       [](Json&, Entries& e) { put<std::int32_t>(e["history.tables"], 3, -3); }},
      {"half a page", "pages", [](Json&, Entries& e) { e["history.pages"].resize(100); }},
      {"wanted drive", "states[2].wanted_drive",
       [](Json& j, Entries&) { j["states"][2]["wanted_drive"] = 5; }},
      {"nan", "phi is", [](Json&, Entries& e) { put(e["history.pages"], 700, std::nanf("")); }},
      {"beyond the band", "phi is", [](Json&, Entries& e) { put(e["history.pages"], 700, 9.0F); }},
  };
}

}  // namespace

class HistorySessionTest : public QObject {
  Q_OBJECT

 private slots:
  void every_state_comes_back_data() { add_executors(); }
  void every_state_comes_back() {
    const TemporaryFolder folder;
    const auto document = branched_case(this_executor());
    QCOMPARE(failure(document::save_session(*document, folder / "one.tidemark")), QString());
    // Once more from what was read: nothing is lost on the way.
    auto read = restored(folder / "one.tidemark", *document, this_executor());
    QVERIFY(!read->changed_since_save());
    QCOMPARE(failure(document::save_session(*read, folder / "two.tidemark")), QString());
    read = restored(folder / "two.tidemark", *document, this_executor());

    const std::vector<document::HistoryState> before = states_of(*document);
    const std::vector<document::HistoryState> after = read->history().states();
    QCOMPARE(after.size(), before.size());
    QVERIFY(before.size() >= 8);
    for (std::size_t i = 0; i < before.size(); ++i) {
      QVERIFY(after[i].change == before[i].change);
      document::Steering steering = after[i].steering;
      QVERIFY(steering.phi->dense() == before[i].steering.phi->dense());
      steering.phi = before[i].steering.phi;
      QVERIFY(steering == before[i].steering);
      QCOMPARE(after[i].parent.has_value(), before[i].parent.has_value());
      QCOMPARE(failure(document->history().go_to(before[i].id)), QString());
      QCOMPARE(failure(read->history().go_to(after[i].id)), QString());
      QVERIFY(Seen(read->level_set()) == Seen(document->level_set()));
      QVERIFY(*read->level_set().curve().points() == *document->level_set().curve().points());
      // And goes on as there.
      if (!read->level_set().begun()) continue;
      QVERIFY(replayed(again(read->level_set().recipe()), document->volume()) ==
              values_of(read->level_set()));
      for (document::Case* one : {document.get(), read.get()}) {
        run(one->level_set(), 3);
        QCOMPARE(failure(one->level_set().end_run()), QString());
      }
      QVERIFY(values_of(read->level_set()) == values_of(document->level_set()));
    }
    // Labels are as they were saved, in every state.
    QCOMPARE(read->labels().list().size(), std::size_t{1});
  }

  void every_state_has_its_strokes_also_where_they_drive_nothing() {
    const TemporaryFolder folder;
    const auto document = named_case();
    document::LevelSet& level_set = document->level_set();
    const std::uint64_t without = document->history().position();
    paint_strokes(level_set, {3, 5, 8});
    run(level_set, 4);
    must(level_set.end_run());
    paint_strokes(level_set, {3, 5, 8, 13});
    run(level_set, 2);
    must(level_set.end_run());
    must(document->history().go_to(without));
    must(document::save_session(*document, folder / "one.tidemark"));
    // Once for the states that share them.
    const Json json = Json::parse(entries_of(folder / "one.tidemark")["history.json"]);
    const auto count = [&](const char* name) {
      return std::count_if(json["states"].begin(), json["states"].end(),
                           [&](const Json& state) { return state.contains(name); });
    };
    QCOMPARE(count("wanted_drive"), std::ptrdiff_t{2});
    QCOMPARE(count("same_wanted_drive"), std::ptrdiff_t{2});
    const auto read = restored(folder / "one.tidemark", *document);
    QVERIFY(!read->level_set().drive().strokes);
    const std::vector<document::HistoryState> before = document->history().states();
    const std::vector<document::HistoryState> after = read->history().states();
    QCOMPARE(after.size(), before.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      must(document->history().go_to(before[i].id));
      must(read->history().go_to(after[i].id));
      const auto& then = level_set.drive().strokes;
      const auto& now = read->level_set().drive().strokes;
      QCOMPARE(now != nullptr, then != nullptr);
      if (then) QVERIFY(*now == *then);
    }
  }

  void a_start_in_levels_stays_apart_from_the_same_one_without() {
    const TemporaryFolder folder;
    const auto document = named_case();
    document::Start coarse = seed_in(*document->volume());
    coarse.levels = 2;
    must(document->level_set().begin(coarse));
    must(document->undo());
    must(document::save_session(*document, folder / "one.tidemark"));
    const auto read = restored(folder / "one.tidemark", *document);
    QCOMPARE(read->level_set().recipe().start.levels, 1);
    must(read->history().go_to(read->history().states().back().id));
    QCOMPARE(read->level_set().recipe().start.levels, 2);
  }

  void dice_of_a_former_answer_is_not_saved() {
    const TemporaryFolder folder;
    const auto document = named_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 8);
    level_set.note({8, 1.0, 2.0, 3.0, 0.9});
    must(level_set.end_run());
    level_set.forget_dice();
    run(level_set, 7);
    level_set.note({15, 1.5, 2.5, 3.5, 0.1});
    must(level_set.end_run());
    must(document::save_session(*document, folder / "one.tidemark"));
    const auto contents = document::load_session(folder / "one.tidemark");
    QCOMPARE(failure(contents), QString());
    bool has_present_one = false;
    for (const document::SavedState& state : contents->history.states) {
      for (const document::CurvePoint& point : *state.curve.points()) {
        QCOMPARE(point.dice.has_value(), point.step == 15);
        has_present_one |= point.dice == 0.1;
      }
    }
    QVERIFY(has_present_one);
  }

  void a_restart_from_a_branch_leads_to_its_start() {
    const TemporaryFolder folder;
    const auto document = branched_case();
    QCOMPARE(failure(document::save_session(*document, folder / "one.tidemark")), QString());
    const auto read = restored(folder / "one.tidemark", *document);
    const std::vector<document::HistoryState> before = states_of(*document);
    const std::vector<document::HistoryState> after = read->history().states();
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (before[i].steering.step == 0) continue;
      must(document->history().go_to(before[i].id));
      must(read->history().go_to(after[i].id));
      must(document->level_set().restart());
      must(read->level_set().restart());
      QVERIFY(values_of(read->level_set()) == values_of(document->level_set()));
    }
  }

  // An import is no state of a file, unless it led to the oldest one.
  void an_import_of_many_labels_may_have_led_to_the_oldest_state() {
    const TemporaryFolder folder;
    const auto document = named_case();
    imaging::Segments segments{document->volume()->geometry, {}, {}};
    for (int n = 10; n < 50; ++n) {
      imaging::Segment segment;
      segment.name = "Segment " + std::to_string(n);
      segments.list.push_back(std::move(segment));
    }
    must(document::add_segments(document->labels(), segments));
    const std::uint64_t with_labels = document->history().position();
    document->history().set_limit(1);
    run(document->level_set(), 3);
    must(document->level_set().end_run());
    const document::HistoryState oldest = document->history().states().front();
    QCOMPARE(oldest.id, with_labels);
    QVERIFY(oldest.change == document::ChangeDescription());
    must(document::save_session(*document, folder / "one.tidemark"));
    const auto read = restored(folder / "one.tidemark", *document);
    QCOMPARE(read->history().states().size(), std::size_t{2});
    must(read->undo());
    QCOMPARE(read->level_set().step(), std::int64_t{0});

    // Files exist that name all of them.
    Entries entries = entries_of(folder / "one.tidemark");
    Json json = Json::parse(entries["history.json"]);
    json["states"][0]["change"]["kind"] = "import labels";
    json["states"][0]["change"]["name"] = std::string(255 * 66, 'n');
    entries["history.json"] = json.dump();
    write_entries(folder / "named.tidemark", entries);
    QCOMPARE(failure(document::load_session(folder / "named.tidemark")), QString());
  }

  void a_session_without_a_history_is_read() {
    const TemporaryFolder folder;
    const auto document = branched_case();
    QCOMPARE(failure(document::save_session(*document, folder / "one.tidemark")), QString());
    Entries entries = entries_of(folder / "one.tidemark");
    QCOMPARE(entries.count("history.json"), std::size_t{1});
    for (const char* name : {"history.json", "history.tables", "history.pages"}) entries.erase(name);
    write_entries(folder / "old.tidemark", entries);
    const auto read = restored(folder / "old.tidemark", *document);
    QVERIFY(Seen(read->level_set()) == Seen(document->level_set()));
    QCOMPARE(read->history().states().size(), std::size_t{1});
    QCOMPARE(read->undo().error().kind, ErrorKind::usage);
  }

  void copies_that_are_made_in_passing_have_none() {
    const TemporaryFolder folder;
    const auto document = branched_case();
    const auto contents = document::snapshot_of(*document);
    QCOMPARE(failure(contents), QString());
    QCOMPARE(
        failure(document::write_session(*contents, folder / "copy.tidemark", document::InFile::no_history)),
        QString());
    QCOMPARE(entries_of(folder / "copy.tidemark").count("history.json"), std::size_t{0});
  }

  // The nearest states are kept, and what is written is read.
  void more_states_than_a_file_has_room_for_are_the_nearest() {
    const TemporaryFolder folder;
    const auto document = named_case();
    document::LevelSet& level_set = document->level_set();
    const int made = static_cast<int>(document::SavedHistory::kMostStates) + 20;
    for (int i = 0; i < made; ++i)
      must(level_set.set_parameters(with_target(level_set.parameters(), 800.0 + i)));
    QCOMPARE(failure(document::save_session(*document, folder / "long.tidemark")), QString());
    const auto read = restored(folder / "long.tidemark", *document);
    QCOMPARE(read->history().states().size(), document::SavedHistory::kMostStates);
    QCOMPARE(read->level_set().parameters().target, 800.0 + made - 1);
    const std::uint64_t oldest = read->history().states().front().id;
    QCOMPARE(failure(read->history().go_to(oldest)), QString());
    QCOMPARE(read->level_set().parameters().target,
             800.0 + made - static_cast<int>(document::SavedHistory::kMostStates));
  }

  // Where each state has many strokes of its own, the text of all of them would be too long to be read again.
  void states_that_the_reader_has_no_room_for_are_the_farthest() {
    const TemporaryFolder folder;
    const auto document = named_case();
    constexpr std::size_t kEntries = 24;
    for (std::size_t i = 0; i < kEntries; ++i) {
      std::vector<std::int64_t> inside;
      const std::int64_t voxels = document->volume()->geometry.voxel_count();
      for (auto offset = static_cast<std::int64_t>(i); offset < voxels; offset += 11)
        inside.push_back(offset);
      paint_strokes(document->level_set(), std::move(inside));
    }
    const auto contents = document::snapshot_of(*document);
    QCOMPARE(failure(contents), QString());
    const document::HistoryEntries whole = document::history_entries(*contents);
    const auto parsed = JsonDocument::parse(whole.json, "whole");
    QCOMPARE(failure(parsed), QString());
    must(document::save_session(*document, folder / "one.tidemark"));
    Entries entries = entries_of(folder / "one.tidemark");
    QCOMPARE(entries["history.json"], whole.json);

    const JsonLimits half_the_bytes{.bytes = whole.json.size() / 2};
    const JsonLimits half_the_values{.values = std::size_t{parsed->end(0)} / 2};
    for (const JsonLimits& limits : {half_the_bytes, half_the_values}) {
      const document::HistoryEntries part = document::history_entries(*contents, limits);
      QCOMPARE(failure(JsonDocument::parse(part.json, "part", limits)), QString());
      const Json json = Json::parse(part.json);
      const std::size_t kept = json["states"].size();
      QVERIFY2(kept > kEntries / 4 && kept < kEntries, qPrintable(QString::number(kept)));
      QCOMPARE(json["present"].get<std::size_t>(), kept - 1);
      put_history(entries, part);
      write_entries(folder / "part.tidemark", entries);
      const auto read = restored(folder / "part.tidemark", *document);
      const std::vector<document::HistoryState> states = read->history().states();
      QCOMPARE(states.size(), kept);
      must(read->history().go_to(states.front().id));
      const auto oldest = static_cast<std::int64_t>(kEntries - kept);
      QCOMPARE(read->level_set().drive().strokes->inside.front(), oldest);
    }
  }

  void a_bad_history_is_refused_data() {
    QTest::addColumn<int>("row");
    const std::vector<Bad> all = bad_files();
    for (std::size_t i = 0; i < all.size(); ++i) QTest::newRow(all[i].name) << static_cast<int>(i);
  }
  void a_bad_history_is_refused() {
    QFETCH(int, row);
    const Bad bad = bad_files()[static_cast<std::size_t>(row)];
    const TemporaryFolder folder;
    QCOMPARE(failure(document::save_session(*branched_case(), folder / "good.tidemark")), QString());
    Entries entries = entries_of(folder / "good.tidemark");
    Json json = Json::parse(entries["history.json"]);
    const std::string text = entries["history.json"];
    bad.spoil(json, entries);
    if (entries["history.json"] == text) entries["history.json"] = json.dump();
    write_entries(folder / "bad.tidemark", entries);
    const auto read = document::load_session(folder / "bad.tidemark");
    QVERIFY(!read);
    QCOMPARE(read.error().kind, ErrorKind::input);
    QVERIFY2(read.error().message.find("bad.tidemark") != std::string::npos, read.error().message.c_str());
    QVERIFY2(read.error().message.find(bad.told) != std::string::npos, read.error().message.c_str());
  }
};

TIDEMARK_TEST(HistorySessionTest)

}  // namespace tidemark::test::history_session_test

#include "history_session_test.moc"
