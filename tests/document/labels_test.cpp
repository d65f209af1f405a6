// Labels: what is given to whom, what locks keep, and the way back.
#include <random>
#include <set>

#include "cases.h"
#include "document/label_segments.h"
#include "document/region_statistics.h"
#include "solver/distance_transform.h"
#include "solver/model.h"
#include "tests/support/test_program.h"

namespace tidemark::test::labels_test {

namespace {

Region box(Index3 first, Index3 last) {
  return whole({first, last + Index3(1)});
}

Geometry small_grid() {
  return lumpy_volume({12, 11, 10})->geometry;
}

solver::Field surface_of(const Mask& mask) {
  return solver::distance_transform(mask, solver::default_band(mask.geometry));
}

}  // namespace

class LabelsTest : public QObject {
  Q_OBJECT

 private slots:
  void a_stroke_that_changes_nothing_leaves_redo() {
    document::History history;
    document::Labels labels(small_grid(), &history);
    const std::uint8_t liver = labels.add("Liver").value();
    const Region liver_region = box({0, 0, 0}, {3, 3, 3});
    QCOMPARE(failure(labels.accept(liver_region, liver)), QString());
    const std::uint64_t accepted = history.position();
    const std::uint64_t revision = labels.revision();
    QCOMPARE(failure(labels.accept(liver_region, liver)), QString());
    QCOMPARE(history.position(), accepted);
    QCOMPARE(labels.revision(), revision);
    QCOMPARE(failure(history.undo()), QString());
    const std::uint64_t before = history.position();
    QCOMPARE(failure(labels.brush({liver, {}, box({6, 6, 6}, {7, 7, 7})}, document::Labels::Stroke::erases)),
             QString());
    QCOMPARE(history.position(), before);
    QVERIFY(history.redo_description());
  }

  void labels_become_segments_and_come_back() {
    document::Labels labels(small_grid());
    const std::uint8_t liver = labels.add("Liver").value();
    const std::uint8_t tumour = labels.add("Tumour").value();
    QCOMPARE(failure(labels.accept(box({0, 0, 0}, {5, 5, 5}), liver)), QString());
    QCOMPARE(failure(labels.accept(box({4, 0, 0}, {9, 5, 5}), tumour, document::Take::others_too)),
             QString());
    document::Label chosen = *labels.find(tumour);
    chosen.meaning = imaging::find_segment_meaning("cyst").value();
    QCOMPARE(failure(labels.set(chosen)), QString());
    const imaging::Segments segments = document::segments_of(labels);
    QCOMPARE(segments.list.size(), std::size_t{2});
    QVERIFY(segments.list[0].meaning == imaging::find_segment_meaning("liver").value());  // as its name says
    QVERIFY(segments.list[1].meaning == chosen.meaning);
    QCOMPARE(segments.list[1].count(), labels.region(tumour).count());

    document::Labels read(small_grid());
    const std::uint8_t bone = read.add("Bone").value();
    QCOMPARE(failure(read.accept(box({0, 0, 0}, {0, 0, 0}), bone)), QString());
    document::Label locked = *read.find(bone);
    locked.locked = true;
    QCOMPARE(failure(read.set(locked)), QString());
    QCOMPARE(failure(document::add_segments(read, segments)), QString());
    QCOMPARE(read.list().size(), std::size_t{3});
    QCOMPARE(read.list()[1].name, std::string("Liver"));
    QVERIFY(read.list()[2].colour == labels.find(tumour)->colour);
    QCOMPARE(read.region(read.list()[1].id).count(),
             labels.region(liver).count() - 1);  // one voxel is locked
    QVERIFY(read.region(read.list()[2].id) == labels.region(tumour));
    QVERIFY(read.list()[2].meaning == chosen.meaning);

    Geometry larger = small_grid();
    larger.size.x += 1;
    document::Labels elsewhere(larger);
    QCOMPARE(document::add_segments(elsewhere, segments).error().kind, ErrorKind::usage);
    QVERIFY(elsewhere.list().empty());
  }

  void an_import_is_one_entry_of_the_history() {
    document::History history;
    document::Labels labels(small_grid(), &history);
    const std::uint8_t bone = labels.add("Bone").value();
    QCOMPARE(failure(labels.accept(box({0, 0, 0}, {3, 3, 3}), bone)), QString());
    const std::vector<std::uint8_t> before = labels.voxels().voxels();
    imaging::Segments two =
        imaging::segments_of(mask_of(box({2, 2, 2}, {5, 5, 5}), labels.geometry()), "Left kidney");
    two.list.push_back(
        imaging::segments_of(mask_of(box({5, 5, 5}, {7, 7, 7}), labels.geometry()), "Cyst").list.front());
    QCOMPARE(failure(document::add_segments(labels, two)), QString());
    QCOMPARE(labels.list().size(), std::size_t{3});
    QCOMPARE(labels.region(2).count(), std::int64_t{63});  // the later one has what both hold
    const std::vector<std::uint8_t> after = labels.voxels().voxels();
    QCOMPARE(document::describe(*history.undo_description()), std::string("import of Left kidney, Cyst"));
    QCOMPARE(failure(history.undo()), QString());
    QCOMPARE(labels.list().size(), std::size_t{1});
    QVERIFY(labels.voxels().voxels() == before);
    QCOMPARE(failure(history.redo()), QString());
    QCOMPARE(labels.list().size(), std::size_t{3});
    QVERIFY(labels.voxels().voxels() == after);
  }

  // They come out of files of others, and go into session files and files for others.
  void names_and_codes_that_nobody_could_write_again_are_cut_or_left_out() {
    document::Labels labels(small_grid());
    imaging::Segments segments = imaging::segments_of(mask_of(box({2, 2, 2}, {5, 5, 5}), labels.geometry()),
                                                      std::string(63, 'x') + "ä");
    segments.list.front().meaning.type = {std::string(300, '1'), "SCT", "Liver"};
    QCOMPARE(failure(document::add_segments(labels, segments)), QString());
    QCOMPARE(labels.list().front().name, std::string(63, 'x'));
    QVERIFY(!labels.list().front().meaning);
  }

  void voxels_of_locked_labels_stay() {
    document::Labels labels(small_grid());
    const std::uint8_t liver = labels.add("Liver").value();
    const std::uint8_t tumour = labels.add("Tumour").value();
    const Region left = box({0, 0, 0}, {5, 5, 5});
    const Region right = box({4, 0, 0}, {9, 5, 5});
    QCOMPARE(failure(labels.accept(left, liver)), QString());
    QCOMPARE(labels.region(liver).count(), std::int64_t{216});
    document::Label locked = *labels.find(liver);
    locked.locked = true;
    QCOMPARE(failure(labels.set(locked)), QString());
    QCOMPARE(failure(labels.accept(right, tumour, document::Take::others_too)), QString());
    QCOMPARE(labels.region(liver).count(), std::int64_t{216});
    QCOMPARE(labels.region(tumour).count(), std::int64_t{144});
    QCOMPARE(labels.accept(right, liver).error().kind, ErrorKind::usage);
    QCOMPARE(labels.remove(liver).error().kind, ErrorKind::usage);
    locked.locked = false;
    QCOMPARE(failure(labels.set(locked)), QString());
    QCOMPARE(failure(labels.accept(right, tumour, document::Take::others_too)), QString());
    QCOMPARE(labels.region(liver).count(), std::int64_t{144});
    QCOMPARE(labels.region(tumour).count(), std::int64_t{216});
  }

  void a_label_takes_free_voxels_unless_it_is_to_take_all() {
    document::Labels labels(small_grid());
    const std::uint8_t liver = labels.add("Liver").value();
    const std::uint8_t tumour = labels.add("Tumour").value();
    QCOMPARE(labels.accept(box({0, 0, 0}, {5, 5, 5}), liver).value().taken, std::int64_t{216});
    const Region right = box({4, 0, 0}, {9, 5, 5});
    const document::Acceptance careful = labels.accept(right, tumour).value();
    QCOMPARE(labels.region(liver).count(), std::int64_t{216});
    QCOMPARE(labels.region(tumour).count(), std::int64_t{144});
    QCOMPARE(careful.label, std::string("Tumour"));
    QCOMPARE(careful.taken, std::int64_t{144});
    QCOMPARE(careful.from_others, std::int64_t{0});
    QCOMPARE(careful.left, std::int64_t{72});
    const document::Acceptance all = labels.accept(right, tumour, document::Take::others_too).value();
    QCOMPARE(labels.region(liver).count(), std::int64_t{144});
    QCOMPARE(all.taken, std::int64_t{216});
    QCOMPARE(all.from_others, std::int64_t{72});
    QCOMPARE(all.left, std::int64_t{0});
  }

  void accepting_replaces_or_adds() {
    document::Labels labels(small_grid());
    const std::uint8_t id = labels.add("one").value();
    QCOMPARE(failure(labels.accept(box({0, 0, 0}, {1, 1, 1}), id)), QString());
    QCOMPARE(failure(labels.accept(box({2, 0, 0}, {3, 1, 1}), id, document::Take::free_voxels, false)),
             QString());
    QCOMPARE(labels.region(id).count(), std::int64_t{16});
    QCOMPARE(failure(labels.accept(box({2, 0, 0}, {3, 1, 1}), id)), QString());
    QCOMPARE(labels.region(id).count(), std::int64_t{8});
  }

  void what_cannot_be_done_is_refused() {
    document::Labels labels(small_grid());
    QCOMPARE(labels.accept(box({0, 0, 0}, {1, 1, 1}), 3).error().kind, ErrorKind::usage);
    QCOMPARE(labels.remove(3).error().kind, ErrorKind::usage);
    QCOMPARE(labels.set({}).error().kind, ErrorKind::usage);
    const std::uint8_t id = labels.add("one").value();
    QCOMPARE(labels.accept(box({10, 0, 0}, {12, 1, 1}), id).error().kind, ErrorKind::usage);
    QVERIFY(labels.voxels().empty());
  }

  void there_is_room_for_255_with_colours_of_their_own() {
    document::Labels labels(small_grid());
    std::set<std::array<std::uint8_t, 3>> colours;
    for (int i = 1; i <= 255; ++i) {
      const std::uint8_t id = labels.add(std::to_string(i)).value();
      QCOMPARE(int(id), i);
      colours.insert(labels.find(id)->colour);
    }
    QCOMPARE(labels.add("one more").error().kind, ErrorKind::usage);
    QCOMPARE(colours.size(), std::size_t{255});
    QCOMPARE(failure(labels.remove(17)), QString());
    QCOMPARE(int(labels.add("again").value()), 17);
  }

  void random_changes_are_taken_back_one_by_one() {
    document::History history;
    document::Labels labels(small_grid(), &history);
    std::mt19937 random(3);
    struct SeenLabels {
      std::vector<document::Label> list;
      std::vector<std::uint8_t> masks;  // of label 1 and 2
    };
    const auto seen = [&] {
      SeenLabels now{labels.list(), mask_of(labels.region(1), labels.geometry()).voxels};
      const Mask second = mask_of(labels.region(2), labels.geometry());
      now.masks.insert(now.masks.end(), second.voxels.begin(), second.voxels.end());
      return now;
    };
    std::vector<SeenLabels> states{seen()};
    for (int round = 0; round < 50; ++round) {
      const auto id = static_cast<std::uint8_t>(1 + random() % 2);
      const Index3 first{random() % 8, random() % 8, random() % 8};
      Status done;
      if (labels.find(id) == nullptr) {
        if (auto added = labels.add("label"); !added) done = pass_on(added);
      } else if (random() % 8 == 0) {
        done = labels.remove(id);
      } else if (random() % 6 == 0) {
        document::Label other = *labels.find(id);
        other.name += "'";
        other.visible = !other.visible;
        done = labels.set(other);
      } else {
        const document::Take take =
            random() % 2 == 0 ? document::Take::free_voxels : document::Take::others_too;
        auto accepted = labels.accept(box(first, first + Index3(2)), id, take, random() % 2 == 0);
        done = accepted ? Status() : pass_on(accepted);
      }
      QCOMPARE(failure(done), QString());
      states.push_back(seen());
    }
    for (std::size_t i = states.size() - 1; i-- > 0;) {
      QCOMPARE(failure(history.undo()), QString());
      QVERIFY(seen().list == states[i].list);
      QVERIFY(seen().masks == states[i].masks);
    }
    for (std::size_t i = 1; i < states.size(); ++i) {
      QCOMPARE(failure(history.redo()), QString());
      QVERIFY(seen().list == states[i].list);
      QVERIFY(seen().masks == states[i].masks);
    }
  }

  void statistics_are_of_the_volumes_values() {
    auto volume = *lumpy_volume({12, 11, 10});
    volume.slope = -2.0;
    volume.intercept = 500.0;
    document::Labels labels(volume.geometry);
    const std::uint8_t id = labels.add("one").value();
    const Region region = box({2, 3, 4}, {6, 7, 8});
    const Mask mask = mask_of(region, volume.geometry);
    QCOMPARE(failure(labels.accept(region, id)), QString());
    double sum = 0.0;
    double squares = 0.0;
    const std::vector<float> values = volume.values();
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (mask.voxels[i] == 0) continue;
      sum += values[i];
      squares += static_cast<double>(values[i]) * values[i];
    }
    const double mean = sum / 125.0;
    const double deviation = std::sqrt(squares / 125.0 - mean * mean);
    const auto shared = std::make_shared<const Volume>(volume);
    // Of other labels first, too.
    document::Labels others(volume.geometry);
    const std::uint8_t other = others.add("other").value();
    QCOMPARE(failure(others.accept(box({0, 0, 0}, {9, 9, 6}), other)), QString());
    const std::uint8_t third = others.add("third").value();
    QCOMPARE(failure(others.accept(box({0, 0, 7}, {9, 9, 9}), third)), QString());
    document::LabelStatistics of_labels;
    QCOMPARE(of_labels.measure(shared, others.voxels())[other].voxels, std::int64_t{700});
    const std::vector<document::RegionStatistics> all = of_labels.measure(shared, labels.voxels());
    QCOMPARE(all.size(), std::size_t{256});
    QCOMPARE(all[third].voxels, std::int64_t{0});
    document::InsideStatistics inside;
    // Of another surface first: what it does not share with the mask's is taken away again.
    inside.measure(shared, surface_of(mask_of(box({0, 0, 0}, {9, 9, 9}), volume.geometry)));
    for (const document::RegionStatistics& found : {inside.measure(shared, surface_of(mask)), all[id]}) {
      QCOMPARE(found.voxels, std::int64_t{125});
      QVERIFY(std::abs(found.volume_ml - 125.0 * 1.3 / 1000.0) < 1e-12);
      QVERIFY(std::abs(found.mean - mean) < 1e-6 * std::abs(mean));
      QVERIFY(std::abs(found.standard_deviation - deviation) < 1e-4);
    }
    QCOMPARE(all[0].voxels, std::int64_t{0});
  }

  void a_surface_elsewhere_becomes_a_label_of_its_own() {
    const auto document = begun_case();
    const Geometry& grid = document->volume()->geometry;
    const double spacing = grid.spacing_mm.x;
    const auto begin_at = [&](Index3 voxel) {
      document::Start start;
      start.seeds.push_back({grid.to_patient(glm::dvec3(voxel)), 2.5 * spacing});
      QCOMPARE(failure(document->level_set().begin(start)), QString());
    };
    const Index3 far = grid.size - Index3(4);
    begin_at({4, 4, 4});
    const std::uint8_t liver = document->labels().add("Liver").value();
    const auto first = document->accept_surface(liver, document::Take::free_voxels, "Label 2");
    QVERIFY(first && first->kept.empty());
    QVERIFY(first->added > 20 && first->added == first->taken && first->given_up == 0);
    const Region before = document->labels().region(liver);
    // The same once more: nothing is new.
    QCOMPARE(document->accept_surface(liver, document::Take::free_voxels, "Label 2")->added, std::int64_t{0});

    begin_at(far);
    const auto second = document->accept_surface(liver, document::Take::free_voxels, "Label 2");
    QVERIFY(second);
    QCOMPARE(second->label, std::string("Label 2"));
    QCOMPARE(second->kept, std::string("Liver"));
    QCOMPARE(document->labels().list().size(), std::size_t{2});
    QVERIFY(document->labels().region(liver) == before);
    QCOMPARE(document->labels().region(document->labels().list().back().id).count(), second->added);
    QCOMPARE(failure(document->undo()), QString());  // both at once
    QCOMPARE(document->labels().list().size(), std::size_t{1});
    // Who names no other label means this one, whatever it had.
    const auto replaced = document->accept_surface(liver, document::Take::free_voxels);
    QVERIFY(replaced && replaced->added == second->added);
    QCOMPARE(replaced->given_up, before.count());
    // A part of it in common: the surface was moved on.
    begin_at(far - Index3(1));
    QVERIFY(document->accept_surface(liver, document::Take::free_voxels, "Label 2")->kept.empty());
    QCOMPARE(document->labels().list().size(), std::size_t{1});
  }

  void a_surface_without_an_inside_is_not_accepted() {
    const auto document = begun_case();
    const Geometry& grid = document->volume()->geometry;
    const std::uint8_t liver = document->labels().add("Liver").value();
    QVERIFY(document->accept_surface(liver, document::Take::free_voxels));
    const Region before = document->labels().region(liver);
    const solver::Sphere all{grid.to_patient(0.5 * glm::dvec3(grid.size)), 1000.0};
    QCOMPARE(failure(document->level_set().paint(all, solver::Brush::erase)), QString());
    for (const std::uint8_t label : {liver, std::uint8_t{0}}) {
      const auto accepted = document->accept_surface(label, document::Take::free_voxels, "Label 2");
      QVERIFY(!accepted && accepted.error().kind == ErrorKind::usage);
      QVERIFY(QString::fromStdString(accepted.error().message).contains("no inside"));
    }
    QVERIFY(document->labels().region(liver) == before);
    QCOMPARE(document->labels().list().size(), std::size_t{1});
  }

  void a_surface_becomes_a_label_and_a_label_a_surface() {
    const auto document = begun_case();
    run(document->level_set(), 12);
    const Mask surface = document->level_set().executor().snapshot().value().mask();
    const std::uint8_t id = document->labels().add("Liver").value();
    QCOMPARE(failure(document->accept_surface(id, document::Take::free_voxels)), QString());
    QVERIFY(document->labels().region(id) == Region(surface));
    QCOMPARE(document::describe(*document->history().undo_description()), std::string("accept into Liver"));
    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(document->labels().region(id).count(), std::int64_t{0});
    QCOMPARE(failure(document->redo()), QString());
    run(document->level_set(), 5);
    QCOMPARE(failure(document->begin_from_label(id)), QString());
    QVERIFY(document->level_set().executor().snapshot().value().mask().voxels == surface.voxels);
    QCOMPARE(document->level_set().recipe().start.describe(), std::string("mask label Liver"));
    QCOMPARE(document->level_set().step(), std::int64_t{0});
  }
};

TIDEMARK_TEST(LabelsTest)

}  // namespace tidemark::test::labels_test

#include "labels_test.moc"
