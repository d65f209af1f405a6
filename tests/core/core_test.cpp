// core: checked sizes, geometry, files that appear whole or not at all, the thread pool.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fstream>
#include <limits>
#include <memory>
#include <new>
#include <numeric>
#include <random>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "core/atomic_file.h"
#include "core/checked.h"
#include "core/file_lock.h"
#include "core/geometry.h"
#include "core/machine_memory.h"
#include "core/number_from.h"
#include "core/thread_pool.h"
#include "core/volume.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::core_test {

using tidemark::test::failure;
using tidemark::test::TemporaryFolder;

namespace {

std::string contents(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

int files_in(const std::filesystem::path& folder) {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

}  // namespace

class CoreTest : public QObject {
  Q_OBJECT

 private slots:
  void the_lowest_limit_of_control_groups_counts() {
    const TemporaryFolder folder;
    const auto write = [&](const std::string& name, const std::string& text) {
      std::filesystem::create_directories((folder / name).parent_path());
      std::ofstream(folder / name) << text;
    };
    const auto limit = [&] { return control_group_limit(folder / "groups", folder / "root"); };
    constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();
    QCOMPARE(limit(), kNone);
    write("groups", "0::/user/session\n");
    write("root/user/session/memory.max", "max\n");
    QCOMPARE(limit(), kNone);
    write("root/user/memory.max", "3000\n");
    QCOMPARE(limit(), std::int64_t{3000});
    write("root/user/session/memory.max", "2000\n");
    QCOMPARE(limit(), std::int64_t{2000});
    // Version 1; the path is that of the host, and what is seen is the container's own group.
    write("groups", "7:cpu,memory:/docker/abc\n6:pids:/docker/abc\n");
    write("root/memory/memory.limit_in_bytes", "1000\n");
    QCOMPARE(limit(), std::int64_t{1000});
    QVERIFY(machine_memory() > 0);
  }

  void what_is_unfinished_is_removed_at_once() {
    const TemporaryFolder folder;
    auto file = AtomicFile::create(folder / "result.txt");
    auto series = AtomicFolder::create(folder / "series");
    auto done = AtomicFile::create(folder / "done.txt");
    QVERIFY(file && series && done);
    std::ofstream(series->temporary_path() / "slice.dcm") << "half";
    QCOMPARE(failure(done->commit()), QString());
    const AtomicFile moved = std::move(*file);
    QCOMPARE(files_in(folder / "."), 3);
    remove_unfinished();
    QCOMPARE(files_in(folder / "."), 1);
    QVERIFY(std::filesystem::exists(folder / "done.txt"));
  }

  void a_product_of_sizes_that_overflows_is_refused() {
    QCOMPARE(checked_product(512, 512, 400).value(), std::int64_t{104857600});
    QVERIFY(!checked_product(std::int64_t{1} << 40, std::int64_t{1} << 30));
    QVERIFY(!checked_product(16, -1));
    QCOMPARE(checked_product(std::numeric_limits<std::int64_t>::max(), 0).value(), std::int64_t{0});
  }

  void a_number_has_at_most_one_sign() {
    QCOMPARE(number_from<double>("+0.5"), std::optional(0.5));
    QCOMPARE(number_from<double>("-1e-3"), std::optional(-1e-3));
    QCOMPARE(number_from<int>("+7"), std::optional(7));
    for (const char* bad :
         {"", "+", "-", "+-1", "-+1", "++1", "--1", " 1", "1 ", "1,5", "0x10", "nan", "inf"}) {
      QVERIFY2(!number_from<double>(bad) && !number_from<int>(bad), bad);
    }
    QVERIFY(!number_from<int>("1.5") && !number_from<int>("3000000000") && !number_from<double>("1e999"));
  }

  void voxel_and_patient_coordinates_are_inverse() {
    Geometry geometry;
    geometry.size = {10, 20, 30};
    geometry.spacing_mm = {0.5, 0.75, 3.0};
    geometry.direction = glm::dmat3(0, 0, 1, 1, 0, 0, 0, 1, 0);
    geometry.origin_mm = {-100, 20, 7};
    const glm::dvec3 voxel(1.5, 2.25, 9.0);
    const glm::dvec3 back = geometry.to_voxel(geometry.to_patient(voxel));
    for (int axis = 0; axis < 3; ++axis) QVERIFY(std::abs(back[axis] - voxel[axis]) < 1e-12);
    // Axis i points along patient z here.
    QCOMPARE(geometry.to_patient({2, 0, 0}).z, 8.0);
  }

  void a_voxel_and_its_place_in_memory_are_inverse() {
    Geometry geometry;
    geometry.size = {5, 3, 4};
    std::int64_t offset = 0;
    for (std::int64_t k = 0; k < geometry.size.z; ++k) {
      for (std::int64_t j = 0; j < geometry.size.y; ++j) {
        for (std::int64_t i = 0; i < geometry.size.x; ++i, ++offset) {
          QCOMPARE(geometry.offset({i, j, k}), offset);
          QVERIFY(geometry.voxel_at(offset) == Index3(i, j, k));
        }
      }
    }
  }

  void grids_that_differ_in_one_corner_are_not_the_same() {
    Geometry a;
    a.size = {100, 100, 100};
    Geometry b = a;
    b.spacing_mm.z = 1.001;
    QVERIFY(same_grid(a, b, 0.2));
    QVERIFY(!same_grid(a, b, 0.05));
  }

  void a_file_is_written_whole() {
    const TemporaryFolder folder;
    const auto target = folder / "result.txt";
    QCOMPARE(failure(write_file(target, "first")), QString());
    QCOMPARE(failure(write_file(target, "second")), QString());
    QCOMPARE(contents(target), std::string("second"));
    QCOMPARE(files_in(folder.path()), 1);
  }

  void a_file_without_commit_leaves_the_target_alone() {
    const TemporaryFolder folder;
    const auto target = folder / "result.txt";
    QVERIFY(write_file(target, "kept"));
    {
      auto file = AtomicFile::create(target);
      QVERIFY(file);
      std::ofstream(file->temporary_path()) << "half";
      QCOMPARE(AtomicFile::target_of(file->temporary_path()), std::string("result.txt"));
      QCOMPARE(AtomicFile::target_of(target), std::string());
    }
    QCOMPARE(contents(target), std::string("kept"));
    QCOMPARE(files_in(folder.path()), 1);
  }

  void files_that_belong_together_appear_all_or_none() {
    const TemporaryFolder folder;
    const auto one = folder / "one.txt";
    const auto other = folder / "other.txt";
    QVERIFY(write_file(one, "old") && write_file(other, "old"));
    const auto stage = [&] {
      std::vector<AtomicFile> files;
      for (const auto& target : {one, other}) {
        auto file = AtomicFile::create(target);
        if (!file) qFatal("a file cannot be made");
        std::ofstream(file->temporary_path()) << "new";
        files.push_back(std::move(*file));
      }
      return files;
    };
    {
      auto lost = stage();
      std::filesystem::remove(lost.back().temporary_path());
      const Status failed = AtomicFile::commit_all(lost);
      QVERIFY(!failed);
      QCOMPARE(failed.error().kind, ErrorKind::write);
      QVERIFY(failed.error().message.find(other.string()) != std::string::npos);
      auto stopped = stage();
      std::stop_source source;
      source.request_stop();
      const Status cancelled = AtomicFile::commit_all(stopped, {nullptr, source.get_token()});
      QVERIFY(!cancelled);
      QCOMPARE(cancelled.error().kind, ErrorKind::cancelled);
    }
    QCOMPARE(files_in(folder.path()), 2);
    for (const auto& target : {one, other}) QCOMPARE(contents(target), std::string("old"));
    auto whole = stage();
    QCOMPARE(failure(AtomicFile::commit_all(whole)), QString());
    QCOMPARE(files_in(folder.path()), 2);
    for (const auto& target : {one, other}) QCOMPARE(contents(target), std::string("new"));
  }

  void a_folder_that_is_not_there_is_a_write_error_that_names_the_file() {
    const auto status = write_file("/nonexistent/folder/result.txt", "x");
    QVERIFY(!status);
    QCOMPARE(status.error().kind, ErrorKind::write);
    QVERIFY(status.error().message.find("/nonexistent/folder/result.txt") != std::string::npos);
  }

  void names_as_long_as_a_folder_takes_are_written_and_longer_ones_refused_at_once() {
    const TemporaryFolder folder;
    std::string umlauts = "x";
    for (int n = 0; n < 124; ++n) umlauts += "\u00e4";
    for (const std::string& stem :
         {std::string(222, 'n'), std::string(245, 'n'), std::string(250, 'n'), umlauts}) {
      const auto target = folder / (stem + ".nrrd");
      auto staged = AtomicFile::create(target);
      QCOMPARE(failure(staged), QString());
      const QString name = QString::fromStdString(staged->temporary_path().filename().string());
      QVERIFY2(name.endsWith(".nrrd") && !name.contains(QChar::ReplacementCharacter), qPrintable(name));
      QCOMPARE(failure(write_file(staged->temporary_path(), "whole")), QString());
      QCOMPARE(failure(staged->commit()), QString());
      QCOMPARE(contents(target), std::string("whole"));
    }
    QVERIFY(!AtomicFile::create(folder / std::string(256, 'n')));
    // What a killed program left is known by as much as it holds of the name.
    const std::string series(250, 's');
    const auto left = folder / (".tidemark-0a1b2c-" + series.substr(18));
    std::filesystem::create_directory(left);
    auto filled = AtomicFolder::create(folder / series);
    QCOMPARE(failure(filled), QString());
    QVERIFY(!std::filesystem::exists(left));
    QCOMPARE(failure(filled->commit()), QString());
  }

  void a_link_stays_one_and_what_it_leads_to_is_replaced() {
    const TemporaryFolder folder;
    const auto link = folder / "link.txt";
    std::filesystem::create_directory(folder / "elsewhere");
    QVERIFY(write_file(folder / "elsewhere/result.txt", "first"));
    std::filesystem::create_symlink("elsewhere/result.txt", link);
    QCOMPARE(failure(write_file(link, "second")), QString());
    QVERIFY(std::filesystem::is_symlink(link));
    QCOMPARE(contents(folder / "elsewhere/result.txt"), std::string("second"));
    QCOMPARE(files_in(folder / "elsewhere"), 1);
    QCOMPARE(files_in(folder.path()), 2);
  }

  void a_file_has_the_permissions_of_the_one_that_it_replaces() {
    using std::filesystem::perms;
    const TemporaryFolder folder;
    const auto target = folder / "result.txt";
    QVERIFY(write_file(target, "first"));
    std::filesystem::permissions(target, perms::owner_read | perms::owner_write);
    QCOMPARE(failure(write_file(target, "second")), QString());
    QCOMPARE(contents(target), std::string("second"));
    QVERIFY(std::filesystem::status(target).permissions() == (perms::owner_read | perms::owner_write));
  }

  void a_folder_whose_place_cannot_be_taken_is_refused_at_once() {
    const TemporaryFolder folder;
    const auto here = std::filesystem::current_path();
    std::filesystem::current_path(folder.path());
    for (const auto& [target, why] : {std::pair{std::filesystem::path("."), "it is the current folder"},
                                      {folder.path(), "it is the current folder"},
                                      {"/proc", "a disk is mounted there"},
                                      {"/proc/version", "it is a file"}}) {
      const auto refused = AtomicFolder::create(target);
      QVERIFY2(!refused, target.c_str());
      QCOMPARE(refused.error().kind, ErrorKind::write);
      QVERIFY2(refused.error().message.find(why) != std::string::npos, refused.error().message.c_str());
    }
    std::filesystem::current_path(here);
    QCOMPARE(files_in(folder.path()), 0);
  }

  void a_folder_that_is_given_up_is_not_there() {
    const TemporaryFolder folder;
    for (const char* name : {"series", "series/"}) {
      const auto above = folder / "new";
      QVERIFY(AtomicFolder::create(above / name));  // and let go
      QCOMPARE(files_in(above), 0);
      auto kept = AtomicFolder::create(above / name);
      QVERIFY(kept && kept->commit());
      QCOMPARE(files_in(above), 1);
      QVERIFY(std::filesystem::is_directory(above / "series"));
      std::filesystem::remove_all(above);
    }
  }

  void a_folder_that_a_killed_program_was_filling_goes_when_it_is_next_filled() {
    const TemporaryFolder folder;
    const auto leave = [&](const std::string& name) {
      std::filesystem::create_directory(folder / name);
      std::ofstream(folder / name / "slice.dcm") << "half";
      return folder / name;
    };
    leave(".tidemark-0a1b2c-series");
    const auto other = leave(".tidemark-0a1b2c-other");
    const auto elsewhere = leave("elsewhere");
    std::filesystem::create_directory_symlink(elsewhere, folder / ".tidemark-333333-series");
    constexpr int kKept = 3;  // the last three
    {
      auto first = AtomicFolder::create(folder / "series");
      auto second = AtomicFolder::create(folder / "series");
      QVERIFY(first && second);
      QCOMPARE(files_in(folder.path()), kKept + 2);
      QVERIFY(first->commit());
      QVERIFY(second->commit());
    }
    QCOMPARE(files_in(folder.path()), kKept + 1);
    QCOMPARE(files_in(elsewhere), 1);
    QCOMPARE(files_in(other), 1);
  }

  void a_disk_that_is_full_leaves_the_target_alone() {
    const TemporaryFolder folder;
    const auto target = folder / "result.txt";
    QVERIFY(write_file(target, "kept"));
    // A limit on the size of files fails a write as a full disk does.
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    QCOMPARE(getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = 1000;
    QCOMPARE(setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto status = write_file(target, std::string(5000, 'x'));
    setrlimit(RLIMIT_FSIZE, &before);
    QVERIFY(!status);
    QCOMPARE(status.error().kind, ErrorKind::write);
    QCOMPARE(contents(target), std::string("kept"));
    QCOMPARE(files_in(folder.path()), 1);
  }

  void a_lock_is_waited_for_until_it_is_free_or_nobody_wants_it() {
    const TemporaryFolder folder;
    const auto file = folder / "lock";
    auto held = std::make_unique<FileLock>(FileLock::take(file, FileLock::Missing::make));
    QVERIFY(*held);
    std::atomic<bool> has_it = false;
    std::jthread waiting([&] { has_it = bool(FileLock::wait(file, FileLock::Missing::make, {})); });
    std::stop_source given_up;
    given_up.request_stop();
    QVERIFY(!FileLock::wait(file, FileLock::Missing::make, given_up.get_token()));
    QVERIFY(!has_it);
    held.reset();
    waiting.join();
    QVERIFY(has_it);
    QVERIFY(!FileLock::wait(folder / "no/such/folder", FileLock::Missing::make, {}));
  }

  void a_lock_ends_with_its_holder_though_a_copy_of_the_process_goes_on() {
    const TemporaryFolder folder;
    const auto file = folder / "lock";
    auto held = std::make_unique<FileLock>(FileLock::take(file, FileLock::Missing::make));
    QVERIFY(*held);
    const pid_t process = ::fork();
    QVERIFY(process >= 0);
    if (process == 0) {
      for (;;) ::pause();  // until it is killed
    }
    held.reset();
    const bool is_free(FileLock::take(file));
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    QVERIFY(is_free);
  }

  void the_pool_does_each_index_once() {
    for (const int threads : {1, 2, 5}) {
      ThreadPool pool(threads);
      QCOMPARE(pool.threads(), threads);
      for (int round = 0; round < 200; ++round) {
        std::vector<std::atomic<int>> visits(997);
        const auto visit = [&](std::int64_t begin, std::int64_t end, int member) {
          if (member < 0 || member >= threads || end - begin > 10) std::abort();
          for (std::int64_t i = begin; i < end; ++i) visits[static_cast<std::size_t>(i)]++;
        };
        pool.for_each(997, 10, visit,
                      round % 2 == 0 ? ThreadPool::Direction::forward : ThreadPool::Direction::backward);
        for (const auto& count : visits) QCOMPARE(count.load(), 1);
      }
    }
  }

  void the_pools_shares_follow_each_other_and_hold_whole_pieces() {
    ThreadPool pool(3);
    std::int64_t end = 0;
    for (int member = 0; member < pool.threads(); ++member) {
      QCOMPARE(pool.share(100, member).begin, end);
      end = pool.share(100, member).end;
    }
    QCOMPARE(end, 100);
    std::atomic<int> across{0};
    pool.for_each(100, 8, [&](std::int64_t piece_begin, std::int64_t piece_end, int) {
      for (int member = 0; member < pool.threads(); ++member) {
        const std::int64_t share_end = pool.share(100, member).end;
        if (piece_begin < share_end && piece_end > share_end) ++across;
      }
    });
    QCOMPARE(across.load(), 0);
  }

  void what_a_member_of_the_pool_throws_comes_to_the_caller() {
    for (const int threads : {1, 2, 4}) {
      ThreadPool pool(threads);
      for (int thrower = 0; thrower < threads; ++thrower) {
        const std::int64_t culprit = pool.share(997, thrower).begin;
        std::atomic<std::int64_t> done{0};
        std::string caught;
        try {
          pool.for_each(997, 1, [&](std::int64_t begin, std::int64_t, int) {
            if (begin == culprit) throw std::runtime_error("piece " + std::to_string(begin));
            ++done;
          });
        } catch (const std::runtime_error& error) {
          caught = error.what();
        }
        QCOMPARE(caught, "piece " + std::to_string(culprit));
        QVERIFY(done < 997);
      }
      // The pool is as good as new.
      std::atomic<std::int64_t> visited{0};
      pool.for_each(997, 1, [&](std::int64_t begin, std::int64_t end, int) { visited += end - begin; });
      QCOMPARE(visited.load(), 997);
    }
  }

  void of_many_exceptions_in_a_pool_one_is_thrown() {
    ThreadPool pool(4);
    for (int round = 0; round < 100; ++round) {
      int caught = 0;
      try {
        pool.for_each(64, 1, [](std::int64_t, std::int64_t, int) { throw std::bad_alloc(); });
      } catch (const std::bad_alloc&) {
        ++caught;
      }
      QCOMPARE(caught, 1);
    }
  }

  void a_pool_of_one_goes_there_and_back_in_order() {
    ThreadPool pool(1);
    std::vector<std::int64_t> begins;
    const auto note = [&](std::int64_t begin, std::int64_t, int) { begins.push_back(begin); };
    pool.for_each(10, 4, note);
    pool.for_each(10, 4, note, ThreadPool::Direction::backward);
    QCOMPARE(begins, (std::vector<std::int64_t>{0, 4, 8, 6, 2, 0}));
  }

  void voxels_that_are_not_finite_are_refused_by_name() {
    Volume volume;
    volume.geometry.size = {2, 2, 2};
    std::vector<float> values(8, 1.0F);
    values[6] = std::numeric_limits<float>::quiet_NaN();
    volume.voxels = values;
    const auto status = require_finite(volume, "scan.nii");
    QVERIFY(!status);
    QCOMPARE(status.error().kind, ErrorKind::input);
    QCOMPARE(QString::fromStdString(status.error().message), QString("scan.nii: voxel (0, 1, 1) is NaN"));
  }

  void values_are_rescaled() {
    Volume volume;
    volume.geometry.size = {3, 1, 1};
    volume.voxels = std::vector<std::int16_t>{0, 10, -5};
    volume.slope = -2.0;
    volume.intercept = 1.0;
    QCOMPARE(volume.value(Index3(1, 0, 0)), -19.0F);
    QCOMPARE(volume.range(), std::pair(-19.0F, 11.0F));
    QCOMPARE(volume.values(), (std::vector<float>{1.0F, -19.0F, 11.0F}));
  }

  void the_common_range_is_that_of_the_values_sorted_whatever_their_type() {
    const auto check = [](auto type, std::int64_t count, std::int64_t stride, double slope) {
      std::mt19937 random(5);
      std::normal_distribution<double> some(0.0, 3000.0);
      std::vector<decltype(type)> stored(static_cast<std::size_t>(count));
      constexpr bool kSigned = std::is_signed_v<decltype(type)>;
      for (auto& value : stored) {
        value = static_cast<decltype(type)>(
            std::clamp(some(random) + (kSigned ? 0.0 : 30000.0), -32768.0, 65535.0));
      }
      Volume volume;
      volume.geometry.size = {count, 1, 1};
      volume.slope = slope;
      volume.intercept = -100.0;
      volume.voxels = stored;
      std::vector<float> sorted;
      for (std::int64_t i = 0; i < count; i += stride) sorted.push_back(volume.value(i));
      std::sort(sorted.begin(), sorted.end());
      const std::size_t tail = sorted.size() / 200;
      QCOMPARE(volume.common_range(), std::pair(sorted[tail], sorted[sorted.size() - 1 - tail]));
    };
    for (const double slope : {1.0, 0.25, -2.0}) {
      for (const std::int64_t count : {1, 199, 200, 10'007}) {
        check(std::int16_t(), count, 1, slope);
        check(std::uint16_t(), count, 1, slope);
        check(float(), count, 1, slope);
      }
      check(std::int16_t(), 2'100'000, 3, slope);
      check(float(), 2'100'000, 3, slope);
    }
  }

  void dice_counts_overlap() {
    Mask a{{}, {1, 1, 0, 0}};
    Mask b{{}, {0, 1, 1, 0}};
    QCOMPARE(dice(a, b), 0.5);
    QCOMPARE(dice(Mask{{}, {0, 0}}, Mask{{}, {0, 0}}), 1.0);
  }
};

TIDEMARK_TEST(CoreTest)

}  // namespace tidemark::test::core_test

#include "core_test.moc"
