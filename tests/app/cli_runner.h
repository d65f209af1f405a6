// A runner of the built tidemark-cli, as a user runs it, and small inputs for it.
#pragma once

#include <QJsonObject>
#include <QProcess>
#include <QStringList>
#include <filesystem>
#include <string>
#include <vector>

#include "core/volume.h"
#include "tests/support/support.h"

namespace tidemark::test {

struct Outcome {
  int code = -1;  // -1: crashed or hung
  QByteArray out;
  QByteArray err;

  // Whether it ended with that code and one line on standard error, "tidemark-cli: error: <message>".
  [[nodiscard]] bool failed_in_one_line(int wanted_code) const;
  [[nodiscard]] QByteArray told() const;  // code and both outputs, for messages
};

struct RunOptions {
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  qint64 largest_file = -1;   // bytes that any file may grow to, as on a full disk; -1: no limit
  QString folder = {};        // to run in
  bool is_privileged = true;  // where root runs it; else permissions of files hold for root, too
};

// The path of the program that was built.
QString cli_program();

// Runs to the end.
Outcome run_cli(const QStringList& arguments, const RunOptions& options = {});

// The same for a command that must succeed; else the test fails and shows its output.
Outcome must_run(const QStringList& arguments, const RunOptions& options = {});

// Of SIGINT, SIGTERM and SIGHUP the program that is to be started ignores these, and no others: whoever runs
// the tests may ignore some, as nohup does, or a script for its jobs in the background.
void set_ignored_signals(QProcess& process, const std::vector<int>& ignored);

// Starts it and returns once `line` has appeared on standard output.
bool start_cli(QProcess& process, const QStringList& arguments, const QByteArray& line);

QString text(const std::filesystem::path& path);
QJsonObject json_of(const QByteArray& bytes);

// The names in a folder, hidden ones too.
QStringList names_in(const std::filesystem::path& folder);

// 1000 inside a ball in the middle, 0 outside, int16, spacing 1 mm.
Volume ball(Index3 size, double radius);
Mask ball_mask(const Volume& ball);

// What segments such a ball, starting at its centre.
QStringList ball_arguments(Index3 size);

// The phantom "sphere" as the program writes it: series/, truth.nii.gz and phantom.json.
class SphereStudy {
 public:
  SphereStudy();

  [[nodiscard]] std::filesystem::path folder() const { return folder_ / "sphere"; }
  std::filesystem::path operator/(const std::string& name) const { return folder() / name; }
  // The options that segment it, with the phantom's own start.
  [[nodiscard]] QStringList arguments() const;

 private:
  TemporaryFolder folder_;
  QJsonObject phantom_;
};

}  // namespace tidemark::test
