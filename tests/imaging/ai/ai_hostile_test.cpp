// Servers with models that misbehave: slow, endless, wrong. One clear line each, and nothing is left.
#include <QElapsedTimer>
#include <QTest>
#include <limits>
#include <thread>

#include "imaging/ai/ai_services.h"
#include "imaging/ai/packed_bytes.h"
#include "imaging/files/volume_file.h"
#include "tests/imaging/ai/model_server.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/support/test_program.h"

namespace tidemark::test::ai_hostile_test {

namespace {

constexpr qint64 kSoon = 15'000;  // ms, with a patience of one second, on a busy machine

using Protocol = imaging::AiServer::Protocol;
using Behaviour = ScriptedPeer::Behaviour;

std::string answer(const std::string& status, const std::string& type, const std::string& body) {
  return fmt::format("HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\n\r\n{}", status, type,
                     body.size(), body);
}
std::string json(const std::string& body) {
  return answer("200 OK", "application/json", body);
}
std::string image(const std::string& body) {
  return answer("200 OK", "application/octet-stream", body);
}

Behaviour says(const std::string& bytes) {
  return [bytes](PeerEnd& end) {
    while (!end.read_request().empty() && end.write(bytes)) {
    }
  };
}
Behaviour says_again_and_again(const std::string& begin, const std::string& bytes) {
  return [begin, bytes](PeerEnd& end) {
    end.read_request();
    if (!end.write(begin)) return;
    while (!end.quits() && end.write(bytes)) {
    }
  };
}

// A good DLS server until it is clicked at, which is answered with that.
Behaviour clicked(const std::string& bytes) {
  return [bytes](PeerEnd& end) {
    for (std::string head = end.read_request(); !head.empty(); head = end.read_request()) {
      const auto asks = [&](const char* what) { return head.find(what) != std::string::npos; };
      const std::string said = asks("/v2/models")       ? answer("404 Not Found", "application/json", "{}")
                               : asks("/start_session") ? json(R"({"session_id": "a-1"})")
                               : asks("/upload_raw/")   ? json(R"({"message": "taken"})")
                               : asks("/end_session/")  ? json(R"({"message": "Session ended"})")
                                                        : bytes;
      if (!end.write(said)) return;
    }
  };
}

imaging::AiServer server_at(const ScriptedPeer& peer, Protocol protocol) {
  imaging::AiServer server;
  server.name = "peer";
  server.protocol = protocol;
  server.access.url = peer.web_server().web->url;
  server.timeout_seconds = 1;
  return server;
}

imaging::AiRequest click() {
  return {{"model", {}, {}, imaging::AiModel::Clicks::required}, {}, {{kDimBall}, {}}};
}

// A volume file of some values, as bytes.
std::string nifti(const Geometry& grid, const std::vector<float>& values,
                  const std::string& name = "a.nii.gz") {
  const TemporaryFolder folder;
  Volume volume;
  volume.geometry = grid;
  volume.voxels = values;
  const Status written = imaging::write_volume_file(volume, folder / name);
  if (!written) qFatal("%s", written.error().message.c_str());
  return bytes_of(folder / name).toStdString();
}

std::string mask_of_bytes(std::int64_t bytes) {
  const TemporaryFolder folder;
  Volume volume;
  volume.geometry.size = {bytes / 4, 1, 1};
  volume.voxels = std::vector<float>(static_cast<std::size_t>(bytes / 4));
  if (!imaging::pack_values(volume, folder / "a.gz", {})) qFatal("cannot pack");
  return fmt::format(R"({{"status": "success", "result": "{}"}})",
                     bytes_of(folder / "a.gz").toBase64().toStdString());
}

QStringList left_in(const TemporaryFolder& folder) {
  return QDir(QString::fromStdString(folder.path().string()))
      .entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot);
}

}  // namespace

class AiHostileTest : public QObject {
  Q_OBJECT

 private slots:
  void who_misbehaves_when_asked_for_models_is_told_off_data() {
    QTest::addColumn<Protocol>("protocol");
    QTest::addColumn<Behaviour>("behave");
    QTest::addColumn<QString>("said");
    const auto both = [](const char* name, const Behaviour& behave, const char* said) {
      QTest::newRow(fmt::format("MONAI Label: {}", name).c_str()) << Protocol::monai_label << behave << said;
      QTest::newRow(fmt::format("DLS: {}", name).c_str()) << Protocol::dls << behave << said;
    };
    both(
        "hangs up", [](PeerEnd&) {}, "breaks off");
    both(
        "says nothing", [](PeerEnd& end) { end.say_nothing(); }, "does not answer: nothing came for 1 s");
    both("speaks another language", says("220 mail.example ESMTP\r\n"), "does not answer as web servers do");
    both("goes on without end",
         says_again_and_again("HTTP/1.1 200 OK\r\nContent-Type: application/json\r\n\r\n",
                              std::string(100'000, ' ')),
         "sends more than an answer may hold");
    both("is elsewhere",
         says("HTTP/1.1 307 Moved\r\nLocation: https://evil.example/\r\nContent-Length: 0\r\n\r\n"),
         "sends us on to https://evil.example/: enter that address");
    both("wants a secret", says(answer("401 Unauthorized", "text/plain", "")),
         "(HTTP 401): it wants a secret");
    both("is no JSON", says(json("{")), "not JSON");
    both("is deep", says(json(std::string(100'000, '['))), "nested more than");
    both("has no models", says(json("{}")), "models: is missing");
    QTest::newRow("MONAI Label: a page")
        << Protocol::monai_label << says(answer("200 OK", "text/html", "<html>"))
        << "answers with 'text/html', which is not JSON";
    QTest::newRow("MONAI Label: models are a list")
        << Protocol::monai_label << says(json(R"({"models": [1]})")) << "models: not an object";
    QTest::newRow("MONAI Label: a model is a number")
        << Protocol::monai_label << says(json(R"({"models": {"a": {"type": 1}}})"))
        << "models.a.type: not a text";
    QTest::newRow("MONAI Label: a long name")
        << Protocol::monai_label << says(json("{\"models\": {\"" + std::string(1000, 'a') + "\": {}}}"))
        << "a name has more than 255 bytes";
    QTest::newRow("DLS: a model without a name")
        << Protocol::dls << says(json(R"({"models": [{"dimensions": 3}]})")) << "models[0].id: is missing";
  }
  void who_misbehaves_when_asked_for_models_is_told_off() {
    QFETCH(Protocol, protocol);
    QFETCH(Behaviour, behave);
    QFETCH(QString, said);
    const ScriptedPeer peer(behave);
    QElapsedTimer timer;
    timer.start();
    const auto models = imaging::ai_models(server_at(peer, protocol));
    QVERIFY(timer.elapsed() < kSoon);
    QVERIFY(!models);
    QCOMPARE(models.error().kind, ErrorKind::input);
    const QString message = failure(models);
    QVERIFY2(message.startsWith("AI server peer (http://127.0.0.1:"), qPrintable(message));
    QVERIFY2(message.contains(said), qPrintable(message));
    QVERIFY2(!message.contains('\n') && message.size() < 400, qPrintable(message));
  }

  void an_answer_that_is_none_is_told_and_leaves_nothing_data() {
    QTest::addColumn<Protocol>("protocol");
    QTest::addColumn<Behaviour>("behave");
    QTest::addColumn<QString>("said");
    const Geometry grid = oblique_balls().geometry;
    const auto count = static_cast<std::size_t>(grid.voxel_count());
    const auto with = [&](float value) {
      std::vector<float> values(count, 1.0F);
      values[5] = value;
      return values;
    };
    const auto monai = [](const char* name, const std::string& bytes, const char* said) {
      QTest::newRow(fmt::format("MONAI Label: {}", name).c_str())
          << Protocol::monai_label << says(bytes) << said;
    };
    Geometry other = grid;
    other.size.x = 32;
    Geometry elsewhere = grid;
    elsewhere.origin_mm.x += 40.0;
    Geometry turned = grid;
    turned.direction = glm::dmat3(1.0);
    monai("a page", answer("200 OK", "text/html; charset=utf-8", "<html>Log in</html>"),
          "answers with 'text/html; charset=utf-8', which is not an image");
    monai("no image", json(R"({"params": {}})"), "which is not an image");
    monai("nothing", image(""), "is no image that can be read");
    monai("words", image("Traceback (most recent call last)"), "is no image that can be read");
    monai("broken off", image(nifti(grid, with(2.0F)).substr(0, 60)), "is no image that can be read");
    monai("another grid", image(nifti(other, std::vector<float>(count * 32 / 33, 1.0F))),
          "its answer has a grid of 32 x 20 x 11 voxels");
    monai("another place", image(nifti(elsewhere, with(2.0F))), "lies elsewhere in the patient");
    monai("another direction", image(nifti(turned, with(2.0F))), "lies elsewhere in the patient");
    monai("below 0", image(nifti(grid, with(-1.0F))), "answers with -1 at voxel 5, 0, 0");
    monai("no label", image(nifti(grid, with(1.5F))), "neither labels nor a probability");
    monai("a label beyond 255", image(nifti(grid, with(256.0F))), "answers with 256 at voxel 5, 0, 0");
    monai("empty", image(nifti(grid, std::vector<float>(count))), "the model model has found nothing");
    std::string nan = nifti(grid, with(0.5F), "a.nii");
    const float none = std::numeric_limits<float>::quiet_NaN();
    std::memcpy(nan.data() + 352 + 5 * 4, &none, 4);
    monai("NaN", image(nan), "is no image that can be read");
    monai("refuses", answer("500 Oops", "application/json", R"({"detail": "CUDA out\nof memory"})"),
          "refuses the request (HTTP 500): CUDA out of memory");
    QTest::newRow("MONAI Label: a small file that unpacks to much")
        << Protocol::monai_label
        << says(image(nifti({{400, 400, 400}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0)},
                            std::vector<float>(64'000'000))))
        << "its answer has a grid of 400 x 400 x 400 voxels";
    QTest::newRow("MONAI Label: goes on without end")
        << Protocol::monai_label
        << says_again_and_again("HTTP/1.1 200 OK\r\nContent-Type: application/gzip\r\n\r\n",
                                std::string(100'000, 'x'))
        << "sends more than an answer may hold";
    const auto dls = [](const char* name, const std::string& bytes, const char* said) {
      QTest::newRow(fmt::format("DLS: {}", name).c_str()) << Protocol::dls << clicked(bytes) << said;
    };
    const auto bytes = static_cast<std::int64_t>(count);
    dls("a page", answer("200 OK", "text/html", "<html>"), "answers with 'text/html', which is not JSON");
    dls("refuses", json(R"({"error": "Invalid session"})"), "refuses: Invalid session");
    dls("no result", json("{}"), "result: is missing");
    dls("a number", json(R"({"result": 1})"), "result: not a text");
    dls("no Base64", json(R"({"result": "!!!!"})"), "is no mask of 7260 voxels");
    dls("not packed", json(R"({"result": "AAAA"})"), "is no mask of 7260 voxels");
    dls("too short", json(mask_of_bytes(bytes - 4)), "is no mask of 7260 voxels");
    dls("too long", json(mask_of_bytes(std::int64_t{64} << 20)), "is no mask of 7260 voxels");
    dls("empty", json(mask_of_bytes(bytes)), "the model model has found nothing");
    QTest::newRow("DLS: a session that is a path")
        << Protocol::dls << says(json(R"({"models": [], "session_id": "../../infer", "message": ""})"))
        << "begins a session by a name that is none";
    QTest::newRow("DLS: goes on without end") << Protocol::dls << Behaviour([](PeerEnd& end) {
      clicked("HTTP/1.1 200 OK\r\nContent-Type: application/json\r\n\r\n" + std::string(20 << 20, ' '))(end);
    }) << "sends more than an answer may hold";
  }
  void an_answer_that_is_none_is_told_and_leaves_nothing() {
    QFETCH(Protocol, protocol);
    QFETCH(Behaviour, behave);
    QFETCH(QString, said);
    const TemporaryFolder temporary;
    const Variable there("TMPDIR", QByteArray::fromStdString(temporary.path().string()));
    const ScriptedPeer peer(behave);
    QElapsedTimer timer;
    timer.start();
    const auto found = imaging::ai_segment(server_at(peer, protocol), oblique_balls(), click());
    QVERIFY2(timer.elapsed() < kSoon, qPrintable(QString::number(timer.elapsed())));
    const QString message = failure(found);
    QVERIFY2(message.startsWith("AI server peer (http://127.0.0.1:"), qPrintable(message));
    QVERIFY2(message.contains(said), qPrintable(message));
    QVERIFY2(!message.contains('\n') && message.size() < 400, qPrintable(message));
    QCOMPARE(found.error().kind, ErrorKind::input);
    QCOMPARE(left_in(temporary), QStringList());
  }

  void a_request_to_stop_ends_it_soon_data() {
    QTest::addColumn<Protocol>("protocol");
    QTest::addColumn<Behaviour>("behave");
    QTest::newRow("MONAI Label") << Protocol::monai_label
                                 << Behaviour([](PeerEnd& end) { end.say_nothing(); });
    QTest::newRow("DLS") << Protocol::dls << clicked("");
  }
  void a_request_to_stop_ends_it_soon() {
    QFETCH(Protocol, protocol);
    QFETCH(Behaviour, behave);
    const ScriptedPeer peer(behave);
    imaging::AiServer server = server_at(peer, protocol);
    server.timeout_seconds = 600;
    std::stop_source stop;
    Progress progress;
    progress.stop = stop.get_token();
    std::thread stopper([&] {
      QTest::qSleep(400);
      stop.request_stop();
    });
    QElapsedTimer timer;
    timer.start();
    const auto found = imaging::ai_segment(server, oblique_balls(), click(), progress);
    stopper.join();
    QVERIFY(!found);
    QCOMPARE(found.error().kind, ErrorKind::cancelled);
    QVERIFY2(timer.elapsed() < 8'000, qPrintable(QString::number(timer.elapsed())));
  }
};

TIDEMARK_TEST(AiHostileTest)

}  // namespace tidemark::test::ai_hostile_test

#include "ai_hostile_test.moc"
