// The tables of the conformance statement, held against the code.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcuid.h>
#include <fmt/format.h>

#include <QTest>
#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "core/atomic_file.h"
#include "imaging/pacs/storage_classes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::conformance_test {

namespace {

constexpr std::string_view kMark = "<!-- From here on written by conformance_test. -->\n";

std::string name_of(const std::string& uid) {
  const char* name = dcmFindNameOfUID(uid.c_str());
  return name != nullptr ? name : "";
}

std::string tables() {
  // Which encodings go with which classes, and how often.
  std::map<std::string, std::set<std::string>> encodings;
  for (const imaging::Proposal& proposal : imaging::storage_proposals())
    encodings[proposal.abstract_syntax].insert(proposal.transfer_syntaxes.begin(),
                                               proposal.transfer_syntaxes.end());
  std::string text =
      "\n## Storage classes\n\nThose that are taken, by C-GET or after a C-MOVE. Sent are DICOM "
      "files of any class, in the encoding that they have.\n\n"
      "| class | UID | in compressed encodings, too |\n|---|---|---|\n";
  for (const std::string& uid : imaging::storage_classes()) {
    const bool compressed = encodings.at(uid).size() > 2;
    text += fmt::format("| {} | {} | {} |\n", name_of(uid), uid, compressed ? "yes" : "no");
  }
  text +=
      "\n## Transfer syntaxes\n\nThe first two for every class and for queries; all of them for the classes "
      "with a yes above.\n\n"
      "| transfer syntax | UID |\n|---|---|\n";
  for (const std::string& uid : imaging::storage_syntaxes())
    text += fmt::format("| {} | {} |\n", name_of(uid), uid);
  text += "\n## Services\n\n| class | UID | as SCU | as SCP |\n|---|---|---|---|\n";
  const std::pair<const char*, const char*> services[] = {
      {UID_VerificationSOPClass, "during a C-MOVE"},
      {UID_FINDStudyRootQueryRetrieveInformationModel, "no"},
      {UID_GETStudyRootQueryRetrieveInformationModel, "no"},
      {UID_MOVEStudyRootQueryRetrieveInformationModel, "no"}};
  for (const auto& [uid, scp] : services)
    text += fmt::format("| {} | {} | yes | {} |\n", name_of(uid), uid, scp);
  text +=
      "| the storage classes above | | any class | on the association of a C-GET, and during a C-MOVE |\n";
  return text;
}

}  // namespace

class ConformanceTest : public QObject {
  Q_OBJECT

 private slots:
  void the_statement_is_what_the_code_does() {
    const std::filesystem::path file = TIDEMARK_CONFORMANCE_PAGE;
    const std::string page = bytes_of(file).toStdString();
    const std::size_t mark = page.find(kMark);
    QVERIFY(mark != std::string::npos);
    const std::size_t begin = mark + kMark.size();
    if (const char* target = std::getenv("TIDEMARK_WRITE_TABLE"))
      QVERIFY(write_file(target, page.substr(0, begin) + tables()).has_value());
    QVERIFY2(
        page.substr(begin) == tables() || std::getenv("TIDEMARK_WRITE_TABLE") != nullptr,
        "handbook/conformance.md is not what the code does; to write it again:\n"
        "  TIDEMARK_WRITE_TABLE=handbook/conformance.md build/release/tests/pacs_tests conformance_test");
  }

  void every_class_and_encoding_has_a_name() {
    for (const auto* uids : {&imaging::storage_classes(), &imaging::storage_syntaxes()}) {
      for (const std::string& uid : *uids) QVERIFY2(!name_of(uid).empty(), uid.c_str());
    }
  }
};

TIDEMARK_TEST(ConformanceTest)

}  // namespace tidemark::test::conformance_test

#include "conformance_test.moc"
