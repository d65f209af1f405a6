// Encrypted conversations, with a real peer: who is believed, and who is not.
#include <QTest>

#include "imaging/load_study.h"
#include "imaging/pacs/services.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/imaging/pacs/certificates.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/support/test_program.h"

namespace tidemark::test::pacs_tls_test {

class PacsTlsTest : public QObject {
  Q_OBJECT

  static QString text(const std::filesystem::path& path) { return QString::fromStdString(path.string()); }

  // A peer with that certificate, which wants one of us signed by `authority`.
  static std::unique_ptr<StoringPeer> peer_with(const Certificates::Pair& own,
                                                const Certificates& authority) {
    return std::make_unique<StoringPeer>(
        QStringList{"+tls", text(own.key), text(own.certificate), "+cf", text(authority.authority())});
  }

  static imaging::PacsServer reached(const Archive& peer, const imaging::TlsFiles& tls) {
    imaging::PacsServer server = peer.server();
    server.tls = tls;
    server.timeout_seconds = 10;
    return server;
  }

  static QString said(const Result<double>& echoed) {
    return echoed ? "it answers" : QString::fromStdString(echoed.error().message);
  }

 private slots:
  void files_go_over_an_encrypted_line() {
    const Certificates authority;
    const auto peer = peer_with(authority.signed_for("localhost"), authority);
    const auto own = authority.signed_for("workstation.example");
    const imaging::PacsServer server =
        reached(*peer, {authority.authority(), own.certificate, own.key, true});
    QCOMPARE(failure(imaging::pacs_echo(server)), QString());
    const TemporaryFolder folder;
    const auto files = write_series(sample_volume({64, 64, 3}), folder / "series");
    const auto sent = imaging::send_files(server, files);
    QCOMPARE(failure(sent), QString());
    QCOMPARE(sent->objects, 3);
    std::size_t received = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(peer->received()))
      ++received;
    QCOMPARE(received, files.size());
  }

  void series_come_over_encrypted_lines_both_ways() {
    const Certificates authority;
    const auto of_archive = authority.signed_for("localhost");
    const auto own = authority.signed_for("workstation.example");
    const TlsFiles files{authority.authority(), of_archive.certificate, of_archive.key};
    const auto archive = start_orthanc(&files);
    const imaging::TlsFiles tls{authority.authority(), own.certificate, own.key, true};
    const imaging::PacsServer by_get = reached(*archive, tls);
    const TemporaryFolder folder;
    const Volume volume = sample_volume({64, 64, 3});
    QCOMPARE(failure(imaging::send_files(by_get, write_series(volume, folder / "sent"))), QString());
    const auto studies = imaging::find_studies(by_get, {});
    QCOMPARE(failure(studies), QString());
    imaging::PacsServer by_move = by_get;
    by_move.retrieve = imaging::PacsServer::Retrieve::move;
    imaging::PacsLimits limits;
    limits.free_bytes = 1 << 20;
    for (const auto& [server, name] : {std::pair{by_get, "get"}, {by_move, "move"}}) {
      const auto retrieved =
          imaging::retrieve(server, {studies->entries.at(0).uid, {}, folder / name}, limits);
      QCOMPARE(failure(retrieved), QString());
      const auto loaded = imaging::load_volume(folder / name);
      QCOMPARE(failure(loaded), QString());
      QVERIFY2(loaded->values() == volume.values(), name);
    }
  }

  void who_cannot_be_believed_is_not_talked_to() {
    const Certificates authority;
    const Certificates stranger;
    const auto own = authority.signed_for("workstation.example");
    const imaging::TlsFiles tls{authority.authority(), own.certificate, own.key, true};

    const auto of_stranger = peer_with(stranger.signed_for("localhost"), authority);
    QVERIFY2(said(imaging::pacs_echo(reached(*of_stranger, tls))).contains("certificate"),
             qPrintable(said(imaging::pacs_echo(reached(*of_stranger, tls)))));
    imaging::TlsFiles unverified = tls;
    unverified.verify = false;
    QCOMPARE(said(imaging::pacs_echo(reached(*of_stranger, unverified))), QString("it answers"));

    // Signed by the right authority, for another host.
    const auto of_other = peer_with(authority.signed_for("other.example"), authority);
    QVERIFY2(said(imaging::pacs_echo(reached(*of_other, tls))).contains("certificate"),
             qPrintable(said(imaging::pacs_echo(reached(*of_other, tls)))));
    QCOMPARE(said(imaging::pacs_echo(reached(*of_other, unverified))), QString("it answers"));
  }

  void a_host_may_be_an_address() {
    const Certificates authority;
    const auto peer = peer_with(authority.signed_for("127.0.0.1"), authority);
    const auto own = authority.signed_for("workstation.example");
    imaging::PacsServer server = reached(*peer, {authority.authority(), own.certificate, own.key, true});
    server.host = "127.0.0.1";
    QCOMPARE(said(imaging::pacs_echo(server)), QString("it answers"));
  }

  void who_wants_our_certificate_gets_none_of_another_authority() {
    const Certificates authority;
    const Certificates stranger;
    const auto peer = peer_with(authority.signed_for("localhost"), authority);
    QVERIFY(said(imaging::pacs_echo(reached(*peer, {authority.authority(), {}, {}, true}))) != "it answers");
    const auto own = stranger.signed_for("workstation.example");
    const imaging::TlsFiles tls{authority.authority(), own.certificate, own.key, true};
    QVERIFY(said(imaging::pacs_echo(reached(*peer, tls))) != "it answers");
  }

  void a_peer_without_encryption_is_not_talked_to_in_the_clear() {
    const Certificates authority;
    const StoringPeer plain({"+xa"});
    QVERIFY(said(imaging::pacs_echo(reached(plain, {authority.authority(), {}, {}, true}))) != "it answers");
    const auto secret = peer_with(authority.signed_for("localhost"), authority);
    imaging::PacsServer in_the_clear = secret->server();
    in_the_clear.timeout_seconds = 3;
    QVERIFY(said(imaging::pacs_echo(in_the_clear)) != "it answers");
  }

  void a_peer_that_is_silent_in_the_handshake_is_given_up() {
    const Certificates authority;
    const ScriptedPeer peer([](PeerEnd& end) { end.say_nothing(); });
    imaging::PacsServer server = peer.server();
    server.tls = imaging::TlsFiles{authority.authority(), {}, {}, true};
    const QString message = said(imaging::pacs_echo(server));
    QVERIFY2(message.contains("is too slow") || message.contains("does not answer"), qPrintable(message));
  }

  void keys_that_are_not_usable_are_named() {
    const Certificates authority;
    const auto own = authority.signed_for("workstation.example");
    const auto other = authority.signed_for("other.example");
    const ScriptedPeer peer([](PeerEnd& end) { end.say_nothing(); });
    imaging::PacsServer server = peer.server();
    server.tls = imaging::TlsFiles{"/none/ca.pem", {}, {}, true};
    QVERIFY2(said(imaging::pacs_echo(server)).startsWith("/none/ca.pem: no certificate"),
             qPrintable(said(imaging::pacs_echo(server))));
    server.tls = imaging::TlsFiles{authority.authority(), own.certificate, "/none/key.pem", true};
    QVERIFY2(said(imaging::pacs_echo(server)).startsWith("/none/key.pem: no private key"),
             qPrintable(said(imaging::pacs_echo(server))));
    server.tls = imaging::TlsFiles{authority.authority(), own.certificate, other.key, true};
    QVERIFY2(said(imaging::pacs_echo(server)).contains("is not the key of"),
             qPrintable(said(imaging::pacs_echo(server))));
  }
};

TIDEMARK_TEST(PacsTlsTest)

}  // namespace tidemark::test::pacs_tls_test

#include "pacs_tls_test.moc"
