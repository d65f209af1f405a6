// Everything that is written is there whole, or as it was before: when its writer is killed at any moment,
// and when the disk is full.
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <random>

#include "core/atomic_file.h"
#include "core/files_below.h"
#include "document/session_file.h"
#include "imaging/deidentify/deidentify.h"
#include "imaging/dicom/dicom.h"
#include "imaging/files/gif_file.h"
#include "imaging/files/png_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "imaging/pacs/services.h"
#include "imaging/phantom/phantom.h"
#include "imaging/results/results.h"
#include "imaging/surface/surface.h"
#include "tests/document/cases.h"
#include "tests/support/child_process.h"
#include "tests/support/test_program.h"

namespace tidemark::test::whole_files_test {

namespace fs = std::filesystem;

namespace {

constexpr Index3 kSize{24, 20, 16};
// How many bytes before its end a file is cut off: UIDs make some files longer by a few bytes each time.
constexpr std::int64_t kNearTheEnd = 40;

// A file in two versions: the older one exists when the newer one is written.
struct Contents {
  Volume volume;
  Mask mask;
  Volume phi;
  imaging::Mesh mesh;
  std::vector<std::uint8_t> pixels;
  document::SessionContents session;
  imaging::PacsConfiguration servers;
  imaging::Phantom phantom;
  std::shared_ptr<TemporaryFolder> folder = std::make_shared<TemporaryFolder>();  // of the images
  std::vector<fs::path> images;
};

// Noise, which no format makes short.
Contents make_contents(unsigned version) {
  std::mt19937 random(version);
  Contents made;
  made.volume.geometry.size = kSize;
  std::vector<std::int16_t> voxels(static_cast<std::size_t>(made.volume.geometry.voxel_count()));
  for (auto& voxel : voxels) voxel = static_cast<std::int16_t>(random());
  made.phi.geometry = made.mask.geometry = made.volume.geometry;
  std::vector<float> values;
  for (const auto voxel : voxels) {
    made.mask.voxels.push_back(voxel > 0 ? 1 : 0);
    values.push_back(static_cast<float>(voxel) / 10000.0F);
  }
  made.volume.voxels = std::move(voxels);
  made.phi.voxels = std::move(values);
  for (std::uint32_t corner = 0; corner < 999; ++corner) {
    const auto next = [&] { return static_cast<float>(random() % 1000); };
    made.mesh.vertices.emplace_back(next(), next(), next());
    if (corner % 3 == 2) made.mesh.triangles.push_back({corner - 2, corner - 1, corner});
  }
  made.pixels.resize(std::size_t{4} * 40 * 30);
  for (auto& byte : made.pixels) byte = static_cast<std::uint8_t>(random());
  made.session = document::snapshot_of(*test::begun_case()).value();
  made.session.origin.phantom = "tumour";
  made.session.view_state = fmt::format("version {}", version);
  imaging::PacsServer server;
  server.name = fmt::format("Server {}", version);
  server.host = "pacs.example";
  server.ae_title = "ARCHIVE";
  made.servers.servers = {server};
  made.phantom.kind = "sphere";
  made.phantom.volume = made.volume;
  made.phantom.volume.modality = "MR";
  made.phantom.truth = made.mask;
  made.phantom.random_seed = version;
  if (!imaging::write_dicom_series(made.volume, {}, *made.folder / "images")) qFatal("there are no images");
  made.images = files_below(*made.folder / "images").value();
  return made;
}

Status write_film(const Contents& of, const fs::path& to) {
  auto film = imaging::GifFile::create(40, 30, 0.1, to);
  if (!film) return pass_on(film);
  for (int picture = 0; picture < 3; ++picture) TIDEMARK_TRY(film->add(of.pixels));
  return film->finish();
}

Status write_anonymous(const Contents& of, const fs::path& to) {
  auto made = imaging::deidentify(of.images, to, {});
  if (!made) return pass_on(made);
  return made->folder.commit();
}

struct Writer {
  const char* name;  // of the file or folder
  std::function<Status(const Contents&, const fs::path&)> write;
};

// Whatever the programs write comes from one of these. Text (recipes, statistics, presets of transfer
// functions, descriptions of phantoms) all goes through write_file().
const std::vector<Writer>& writers() {
  const auto volume = [](const Contents& of, const fs::path& to) {
    return imaging::write_volume_file(of.volume, to);
  };
  const auto mesh = [](const Contents& of, const fs::path& to) { return imaging::write_mesh(of.mesh, to); };
  const auto segments = [](const Contents& of) { return imaging::segments_of(of.mask, "Segment"); };
  static const std::vector<Writer> all{
      {"volume.nii", volume},
      {"volume.nii.gz", volume},
      {"volume.nrrd", volume},
      {"volume.mha", volume},
      {"mask.nii.gz", [](const auto& of, const auto& to) { return imaging::write_mask_file(of.mask, to); }},
      {"surface.stl", mesh},
      {"surface.ply", mesh},
      {"surface.obj", mesh},
      {"segmentation.dcm",
       [=](const auto& of, const auto& to) { return imaging::write_segmentation(segments(of), {}, to); }},
      {"contours.dcm",
       [=](const auto& of, const auto& to) { return imaging::write_structure_set(segments(of), {}, to); }},
      {"phi.vdb", [](const auto& of, const auto& to) { return imaging::write_level_set(of.phi, 4.0, to); }},
      {"picture.png",
       [](const auto& of, const auto& to) { return imaging::write_png_file(40, 30, of.pixels, to); }},
      {"film.gif", write_film},
      {"case.tidemark",
       [](const auto& of, const auto& to) { return document::write_session(of.session, to); }},
      {"recipe.json",
       [](const auto& of, const auto& to) {
         return write_file(to, of.session.view_state + of.session.recipe.to_text().value());
       }},
      {"servers.json",
       [](const auto& of, const auto& to) { return imaging::write_pacs_configuration(of.servers, to); }},
      {"series",
       [](const auto& of, const auto& to) { return imaging::write_dicom_series(of.volume, {}, to); }},
      {"anonymous", write_anonymous},
      {"phantom", [](const auto& of, const auto& to) { return imaging::write_phantom(of.phantom, to); }},
  };
  return all;
}

// The bytes of a file, or of all files below a folder by their names.
using Bytes = std::map<std::string, std::string>;

Bytes bytes_of(const fs::path& path) {
  const auto read = [](const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(stream), {}};
  };
  if (!fs::is_directory(path)) return {{"", read(path)}};
  Bytes bytes;
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    if (!entry.is_directory()) bytes[entry.path().lexically_relative(path)] = read(entry.path());
  }
  return bytes;
}

// OpenVDB gives each file an identity of 36 characters.
bool differ_in_identity(const Bytes& a, const Bytes& b) {
  const std::string& one = a.begin()->second;
  const std::string& other = b.begin()->second;
  if (one.size() != other.size()) return false;
  std::int64_t same = 0;
  for (std::size_t at = 0; at < one.size(); ++at) same += one[at] == other[at] ? 1 : 0;
  return static_cast<std::int64_t>(one.size()) - same <= 36;
}

std::int64_t longest(const Bytes& bytes) {
  std::size_t length = 0;
  for (const auto& [name, content] : bytes) length = std::max(length, content.size());
  return static_cast<std::int64_t>(length);
}

}  // namespace

class WholeFilesTest : public QObject {
  Q_OBJECT

  const Contents older_ = make_contents(1);
  const Contents newer_ = make_contents(2);
  int kills_ = 0;  // at events

  struct Place {
    explicit Place(const Writer& writer) : target(folder / writer.name) {}
    test::TemporaryFolder folder;
    fs::path target;
  };

  // What appears at once: a phantom's series, its truth and its description do so one after the other.
  static std::vector<fs::path> parts_of(const fs::path& target) {
    if (target.filename() != "phantom") return {target};
    return {target / "series", target / "truth.nii.gz", target / "phantom.json"};
  }

  // Whether it reads as the newer version. Files with a time or new UIDs in them are never the same bytes.
  Status read_newer(const fs::path& part) const {
    const auto differs = [&] { return fail(ErrorKind::input, "{}: is another one", part.string()); };
    if (fs::is_directory(part)) {
      auto volume = imaging::load_volume(part);
      if (!volume) return pass_on(volume);
      return volume->voxels == newer_.volume.voxels ? Status() : differs();
    }
    if (part.extension() == ".dcm") {
      auto segments = imaging::read_result(part, &newer_.mask.geometry);
      if (!segments) return pass_on(segments);
      return imaging::union_of(*segments).voxels == newer_.mask.voxels ? Status() : differs();
    }
    if (part.extension() != ".tidemark") return differs();
    auto session = document::load_session(part);
    if (!session) return pass_on(session);
    return session->view_state == newer_.session.view_state ? Status() : differs();
  }

  // Every part of the target is as it was before, or the whole newer one; nothing else is there but what has
  // a temporary name.
  void verify_old_or_new(const fs::path& target, const std::map<fs::path, Bytes>& before,
                         const std::map<fs::path, Bytes>& newer) const {
    for (const fs::path& part : parts_of(target)) {
      const auto old = before.find(part.filename());
      if (!fs::exists(part)) {
        QVERIFY2(old == before.end(), part.c_str());
        continue;
      }
      const Bytes now = bytes_of(part);
      if ((old != before.end() && now == old->second) || now == newer.at(part.filename())) continue;
      if (part.extension() == ".vdb" && differ_in_identity(now, newer.at(part.filename()))) continue;
      const test::Ended read = test::run_in_child([&] { return read_newer(part); });
      QVERIFY2(read.failure.empty(), read.failure.c_str());
    }
    for (const fs::path& stranger : strangers_beside(target)) {
      QVERIFY2(!AtomicFile::target_of(stranger).empty(), stranger.c_str());
    }
  }

  // What lies in the folders of a target and is no part of it.
  static std::vector<fs::path> strangers_beside(const fs::path& target) {
    const auto parts = parts_of(target);
    std::vector<fs::path> found;
    for (const fs::path& folder : {target.parent_path(), parts.front().parent_path()}) {
      if (!fs::exists(folder)) continue;
      for (const auto& entry : fs::directory_iterator(folder)) {
        const bool is_known =
            entry.path() == target || std::count(parts.begin(), parts.end(), entry.path()) > 0;
        if (!is_known) found.push_back(entry.path());
      }
    }
    return found;
  }

  static std::map<fs::path, Bytes> read_parts(const fs::path& target) {
    std::map<fs::path, Bytes> found;
    for (const fs::path& part : parts_of(target)) {
      if (fs::exists(part)) found[part.filename()] = bytes_of(part);
    }
    return found;
  }

  // Writes the newer version, disturbed, and looks at what is there. Written again, it takes away what a
  // killed writer left.
  void disturb(const Writer& writer, bool has_older, test::Disturbance how,
               const std::map<fs::path, Bytes>& newer, bool& was_killed) const {
    const Place place(writer);
    if (has_older) write(writer, older_, place.target);
    const auto before = read_parts(place.target);
    how.watched = parts_of(place.target).front().parent_path();
    fs::create_directories(how.watched);
    const test::Ended ended = test::run_in_child([&] { return writer.write(newer_, place.target); }, how);
    was_killed = ended.was_killed;
    QCOMPARE(ended.failure, std::string());
    verify_old_or_new(place.target, before, newer);
    if (!was_killed) return;
    write(writer, newer_, place.target);
    for (const fs::path& stranger : strangers_beside(place.target)) {
      QVERIFY2(!fs::is_directory(stranger), stranger.c_str());
    }
  }

  static void add_rows() {
    QTest::addColumn<int>("number");
    QTest::addColumn<bool>("has_older");
    for (std::size_t n = 0; n < writers().size(); ++n) {
      for (const bool has_older : {false, true}) {
        QTest::addRow("%s%s", writers()[n].name, has_older ? ", over an older one" : "")
            << static_cast<int>(n) << has_older;
      }
    }
  }

  // Writes one version undisturbed.
  static void write(const Writer& writer, const Contents& contents, const fs::path& target) {
    const test::Ended ended = test::run_in_child([&] { return writer.write(contents, target); });
    QVERIFY2(!ended.was_killed && ended.failure.empty(), ended.failure.c_str());
  }

 private slots:
  void initTestCase() {
    // Else each child would read DCMTK's dictionary.
    QVERIFY(!imaging::result_form_of("nothing"));
    // Where it costs nothing that every file is synced.
    if (::access("/dev/shm", W_OK) == 0) qputenv("TMPDIR", "/dev/shm");
    // On one processor this process takes a child's place as soon as there is an event.
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<unsigned>(::sched_getcpu()), &one);
    ::sched_setaffinity(0, sizeof one, &one);
  }

  void a_killed_writer_leaves_the_old_one_or_the_new_one_data() { add_rows(); }
  void a_killed_writer_leaves_the_old_one_or_the_new_one() {
    QFETCH(int, number);
    QFETCH(bool, has_older);
    const Writer& writer = writers()[static_cast<std::size_t>(number)];
    const Place undisturbed(writer);
    write(writer, newer_, undisturbed.target);
    const auto newer = read_parts(undisturbed.target);
    const std::int64_t length = longest(bytes_of(undisturbed.target));
    QVERIFY(length > 2 * kNearTheEnd);
    bool was_killed = false;
    for (const std::int64_t bytes : {std::int64_t{0}, std::int64_t{1}, length / 2, length - kNearTheEnd}) {
      disturb(writer, has_older, {.largest_file = bytes}, newer, was_killed);
      QVERIFY(was_killed);
    }
    // A child that was quicker than the kill has written the whole.
    int survived = 0;
    for (int events = 1; survived < 2; ++events) {
      disturb(writer, has_older, {.events = events}, newer, was_killed);
      (was_killed ? kills_ : survived) += 1;
    }
  }
  void kills_came_between_the_steps_of_writers() {
    QVERIFY2(kills_ > 30, qPrintable(QString::number(kills_)));
  }

  void a_full_disk_is_told_and_leaves_nothing_data() { add_rows(); }
  void a_full_disk_is_told_and_leaves_nothing() {
    QFETCH(int, number);
    QFETCH(bool, has_older);
    const Writer& writer = writers()[static_cast<std::size_t>(number)];
    const Place place(writer);
    write(writer, newer_, place.target);
    const std::int64_t length = longest(bytes_of(place.target));
    fs::remove_all(place.target);
    if (has_older) write(writer, older_, place.target);
    const Bytes before = bytes_of(place.folder.path());
    for (const std::int64_t bytes : {std::int64_t{0}, length / 2, length - kNearTheEnd}) {
      const test::Ended ended = test::run_in_child([&] { return writer.write(newer_, place.target); },
                                                   {.largest_file = bytes, .is_fatal = false});
      QVERIFY2(ended.failure.starts_with(place.target.string()), ended.failure.c_str());
      QVERIFY2(ended.failure.find(".tidemark-") == std::string::npos, ended.failure.c_str());
      QVERIFY2(bytes_of(place.folder.path()) == before, ended.failure.c_str());
    }
  }
};

TIDEMARK_TEST(WholeFilesTest)

}  // namespace tidemark::test::whole_files_test

#include "whole_files_test.moc"
