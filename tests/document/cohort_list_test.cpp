// The work list of a cohort: what it holds, and what is refused.
#include <locale>

#include "core/csv.h"
#include "document/cohort/shared_recipe.h"
#include "document/cohort/work_list.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cohort_list_test {

using cohort::WorkList;
using cohort::WorkRow;

namespace {

// As German has it; the locale itself need not be installed.
class DecimalComma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
};

WorkList parsed(const std::string& text) {
  auto list = WorkList::parse(text, "list.csv", "/data");
  if (!list) qFatal("%s", list.error().message.c_str());
  return std::move(*list);
}

QString refusal(const std::string& text) {
  return test::failure(WorkList::parse(text, "list.csv", "/data"));
}

QString problems(const std::string& text) {
  QStringList all;
  for (const std::string& problem : parsed(text).problems) all << QString::fromStdString(problem);
  return all.join('|');
}

}  // namespace

class CohortListTest : public QObject {
  Q_OBJECT

 private slots:
  void a_list_is_written_as_it_was_read();
  void fields_with_commas_quotes_and_line_ends_survive();
  void numbers_are_read_the_same_in_every_locale();
  void a_spreadsheet_may_separate_by_semicolons();
  void what_is_no_table_is_refused_data();
  void what_is_no_table_is_refused();
  void all_problems_are_named_at_once();
  void a_wrong_field_is_named_by_line_and_column_data();
  void a_study_is_on_the_disk_or_on_a_server();
  void a_wrong_field_is_named_by_line_and_column();
  void ids_are_safe_names_of_folders();
  void a_row_takes_what_it_lacks();
  void what_is_given_replaces_what_a_row_has();
};

void CohortListTest::a_list_is_written_as_it_was_read() {
  const std::string text =
      "id,input,series,mask,within_mm,seed,seed_mm,target,alpha,steps,truth,truth_label\r\n"
      "a,/data/a.nii.gz,,,,\"1,2,3,4.5 6,7,8,9\",,100.25,0.5,,/data/t.nii.gz,3\r\n"
      "b,/data/b,1.2.3#2,/data/m.nii.gz,2.5,,\"-1.5,2,3,4\",,,200,,\r\n";
  const WorkList list = parsed(text);
  QVERIFY(list.problems.empty());
  QCOMPARE(list.rows.size(), std::size_t{2});
  QCOMPARE(list.rows[0].seeds.size(), std::size_t{2});
  QCOMPARE(list.rows[0].seeds[0].radius_mm, 4.5);
  QCOMPARE(list.rows[1].seeds_mm[0].centre.x, -1.5);
  QCOMPARE(list.rows[1].line, std::size_t{3});
  QCOMPARE(QByteArray::fromStdString(list.to_text()), QByteArray::fromStdString(text));
}

void CohortListTest::a_study_is_on_the_disk_or_on_a_server() {
  const std::string text =
      "id,input,server,study,series\r\na,/data/a.nii.gz,,,\r\n1.2.3.4,,main,1.2.3,1.2.3.4\r\n";
  const WorkList list = parsed(text);
  QVERIFY(list.problems.empty());
  QCOMPARE(QString::fromStdString(list.rows.at(0).place()), QString("/data/a.nii.gz"));
  QCOMPARE(QString::fromStdString(list.rows.at(1).place()), QString("pacs:main/1.2.3"));
  QCOMPARE(QByteArray::fromStdString(list.to_text()), QByteArray::fromStdString(text));
  QCOMPARE(QString::fromStdString(parsed("server,study,series\nmain,1.2,1.2.3\n").rows.at(0).id),
           QString("1.2.3"));
  for (const auto& [row, why] :
       {std::pair("a,x.nii,main,1.2,1.2.3", "a study is in one of them"),
        std::pair("a,,main,,1.2.3", "both are needed"), std::pair("a,,main,1.2,", "both are needed"),
        std::pair("a,x.nii,,1.2,", "study: needs a server"), std::pair("a,,,,", "input: is missing")}) {
    const WorkList wrong = parsed(std::string("id,input,server,study,series\n") + row + "\n");
    QVERIFY2(!wrong.problems.empty() && wrong.problems.front().find(why) != std::string::npos, row);
  }
}

void CohortListTest::fields_with_commas_quotes_and_line_ends_survive() {
  WorkList list;
  WorkRow row;
  row.id = "a";
  row.input = "/data/a \"quoted\", with\nline/x.nii";
  list.rows = {row};
  const WorkList read = parsed(list.to_text());
  QCOMPARE(QString::fromStdString(read.rows.at(0).input.string()),
           QString::fromStdString(row.input.string()));
}

void CohortListTest::numbers_are_read_the_same_in_every_locale() {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  const WorkList list = parsed("input,alpha\na.nii,0.75\n");
  const std::string text = list.to_text();
  std::locale::global(before);
  QCOMPARE(*list.rows.at(0).alpha, 0.75);
  QVERIFY(text.find("0.75") != std::string::npos);
}

void CohortListTest::a_spreadsheet_may_separate_by_semicolons() {
  const WorkList list = parsed("\xEF\xBB\xBFid;input;seed\na;x.nii;1,2,3,4\n\n");
  QVERIFY(list.problems.empty());
  QCOMPARE(list.rows.at(0).seeds.size(), std::size_t{1});
  QCOMPARE(QString::fromStdString(list.rows[0].input.string()), QString("/data/x.nii"));
}

void CohortListTest::what_is_no_table_is_refused_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("why");
  QTest::newRow("nothing") << QByteArray("\n\n") << "is empty";
  QTest::newRow("unknown column") << QByteArray("input,tagret\n") << "line 1: no column is named 'tagret'";
  QTest::newRow("double column") << QByteArray("input,id,input\n")
                                 << "line 1: the column 'input' is there twice";
  QTest::newRow("no input") << QByteArray("id\na\n") << "a column 'input' or 'server' is needed";
  QTest::newRow("short row") << QByteArray("id,input\na\n") << "line 2: 1 fields, but 2 columns";
  QTest::newRow("open quote") << QByteArray("id,input\na,\"b\n") << "line 2: a quote is not closed";
  QTest::newRow("after a quote") << QByteArray("id,input\na,\"b\"c\n")
                                 << "line 2: text follows a closing quote";
  QTest::newRow("zero byte") << QByteArray("id,input\na,b\0c\n", 15) << "holds a zero byte";
  QTest::newRow("long field") << QByteArray("input\n") + QByteArray(5000, 'x') << "more than 4096 bytes";
  QTest::newRow("many columns") << QByteArray(200, ',') << "more than 64 columns";
}

void CohortListTest::what_is_no_table_is_refused() {
  QFETCH(QByteArray, text);
  QFETCH(QString, why);
  const QString error = refusal(text.toStdString());
  QVERIFY2(error.startsWith("list.csv: ") && error.contains(why), qPrintable(error));
}

void CohortListTest::all_problems_are_named_at_once() {
  const QString found = problems("id,input,alpha\na,x.nii,2\na,y.nii,0.5\n../b,z.nii,oops\n");
  QVERIFY2(found.contains("line 2: alpha: must be 0 to 1"), qPrintable(found));
  QVERIFY2(found.contains("line 3: id 'a': line 2 has it, too"), qPrintable(found));
  QVERIFY2(found.contains("line 4: alpha: 'oops' is not a number"), qPrintable(found));
  QVERIFY2(found.contains("line 4: id '../b'"), qPrintable(found));
}

void CohortListTest::a_wrong_field_is_named_by_line_and_column_data() {
  QTest::addColumn<QString>("column");
  QTest::addColumn<QString>("field");
  QTest::addColumn<QString>("why");
  QTest::newRow("three numbers") << "seed"
                                 << "\"1,2,3\""
                                 << "seed: '1,2,3' is not 4 numbers";
  QTest::newRow("five numbers") << "seed"
                                << "\"1,2,3,4,5\""
                                << "seed: '1,2,3,4,5' is not 4 numbers";
  QTest::newRow("no radius") << "seed_mm"
                             << "\"1,2,3,0\""
                             << "seed_mm: radius 0: must be greater than 0 mm";
  QTest::newRow("nan") << "target"
                       << "nan"
                       << "target: 'nan' is not a number";
  QTest::newRow("huge") << "target"
                        << "1e999"
                        << "target: '1e999' is not a number";
  QTest::newRow("German") << "alpha"
                          << "\"0,5\""
                          << "alpha: '0,5' is not a number";
  QTest::newRow("range") << "range"
                         << "0"
                         << "range: must be greater than 0";
  QTest::newRow("threshold") << "threshold"
                             << "\"2,1\""
                             << "threshold: the lower limit is above";
  QTest::newRow("auto") << "auto_start"
                        << "maybe"
                        << "auto_start: 'maybe' is neither yes nor no";
  QTest::newRow("steps") << "steps"
                         << "-1"
                         << "steps: '-1' is not a whole number";
  QTest::newRow("levels") << "levels"
                          << "9"
                          << "levels: must be 1 to 3";
  QTest::newRow("within") << "within_mm"
                          << "3"
                          << "within_mm: needs a mask";
  QTest::newRow("label") << "truth_label"
                         << "3"
                         << "truth_label: needs a truth";
}

void CohortListTest::a_wrong_field_is_named_by_line_and_column() {
  QFETCH(QString, column);
  QFETCH(QString, field);
  QFETCH(QString, why);
  const QString found = problems(("input," + column + "\nx.nii," + field + "\n").toStdString());
  QVERIFY2(found.startsWith("list.csv: line 2: " + why), qPrintable(found));
}

void CohortListTest::ids_are_safe_names_of_folders() {
  for (const char* id : {"", ".", "..", ".hidden", "-option", "a/b", "a b", "a\nb", "<b>", "=1"}) {
    QVERIFY2(!cohort::is_safe_id(id), id);
    QVERIFY2(cohort::is_safe_id(cohort::safe_id(id)), id);
  }
  QVERIFY(cohort::is_safe_id("sub-01_ses-2_T1w.v2"));
  QVERIFY(!cohort::is_safe_id(std::string(101, 'a')));
}

void CohortListTest::a_row_takes_what_it_lacks() {
  WorkRow defaults;
  defaults.alpha = 0.5;
  defaults.target = 100.0;
  defaults.auto_start = true;
  WorkRow row;
  row.alpha = 0.7;
  row.seeds.push_back({});
  row.complete(defaults);
  QCOMPARE(*row.alpha, 0.7);
  QCOMPARE(*row.target, 100.0);
  QVERIFY(!row.auto_start);
  WorkRow without_start;
  without_start.complete(defaults);
  QVERIFY(without_start.auto_start);
}

void CohortListTest::what_is_given_replaces_what_a_row_has() {
  WorkRow row;
  row.range = 100.0;
  row.alpha = 0.7;
  row.steps = 20;
  row.mask = "/data/mask.nii.gz";
  row.within_mm = 3.0;
  WorkRow given;
  given.range = 80.0;
  given.max_steps = 50;
  given.auto_start = true;
  row.replace(given);
  QCOMPARE(*row.range, 80.0);
  QCOMPARE(*row.alpha, 0.7);
  QVERIFY(!row.steps && row.max_steps == 50);
  QVERIFY(!row.mask.empty() && !row.auto_start);
  given.seeds_mm.push_back({});
  row.replace(given);
  QVERIFY(row.mask.empty() && !row.within_mm && row.auto_start);
  QCOMPARE(row.seeds_mm.size(), std::size_t{1});
  QVERIFY(cohort::problems_of_values(row).empty());
}

TIDEMARK_TEST(CohortListTest)

}  // namespace tidemark::test::cohort_list_test

#include "cohort_list_test.moc"
