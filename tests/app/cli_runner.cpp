#include "tests/app/cli_runner.h"

#include <signal.h>
#include <sys/resource.h>

#include <QDir>
#include <QElapsedTimer>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/child_process.h"

namespace tidemark::test {
namespace {

constexpr int kLongestRun = 300'000;  // ms, also under sanitizers

}  // namespace

bool Outcome::failed_in_one_line(int wanted_code) const {
  return code == wanted_code && err.startsWith("tidemark-cli: error: ") && err.count('\n') == 1 &&
         err.endsWith('\n') && err.size() > 30;
}

QByteArray Outcome::told() const {
  return "code " + QByteArray::number(code) + "\nstdout: " + out + "\nstderr: " + err;
}

QString cli_program() {
  return QStringLiteral(TIDEMARK_CLI);
}

Outcome run_cli(const QStringList& arguments, const RunOptions& options) {
  QProcess process;
  process.setProcessEnvironment(options.environment);
  if (!options.folder.isEmpty()) process.setWorkingDirectory(options.folder);
  if (options.largest_file >= 0 || !options.is_privileged) {
    process.setChildProcessModifier([limit = options.largest_file, is_privileged = options.is_privileged] {
      const rlimit bytes{static_cast<rlim_t>(limit), static_cast<rlim_t>(limit)};
      if (limit >= 0) setrlimit(RLIMIT_FSIZE, &bytes);
      if (!is_privileged) give_up_privileges();
    });
  }
  process.start(cli_program(), arguments);
  Outcome outcome;
  const bool ended = process.waitForFinished(kLongestRun) && process.exitStatus() == QProcess::NormalExit;
  if (ended) outcome.code = process.exitCode();
  outcome.out = process.readAllStandardOutput();
  outcome.err = process.readAllStandardError();
  return outcome;
}

Outcome must_run(const QStringList& arguments, const RunOptions& options) {
  Outcome outcome = run_cli(arguments, options);
  if (outcome.code == 0) return outcome;
  // Members of a test class are made before there is a test that could fail.
  if (!QTest::currentTestFunction()) qFatal("%s", outcome.told().constData());
  QTest::qFail(outcome.told().constData(), __FILE__, __LINE__);
  return outcome;
}

void set_ignored_signals(QProcess& process, const std::vector<int>& ignored) {
  process.setChildProcessModifier([ignored] {
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      const bool is_ignored = std::find(ignored.begin(), ignored.end(), signal) != ignored.end();
      ::signal(signal, is_ignored ? SIG_IGN : SIG_DFL);
    }
  });
}

bool start_cli(QProcess& process, const QStringList& arguments, const QByteArray& line) {
  process.start(cli_program(), arguments);
  QByteArray seen;
  QElapsedTimer timer;
  for (timer.start(); timer.elapsed() < kLongestRun;) {
    if (!process.waitForReadyRead(kLongestRun)) return false;
    seen += process.readAllStandardOutput();
    if (seen.contains(line)) return true;
  }
  return false;
}

QString text(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

QJsonObject json_of(const QByteArray& bytes) {
  return QJsonDocument::fromJson(bytes).object();
}

QStringList names_in(const std::filesystem::path& folder) {
  return QDir(text(folder)).entryList(QDir::AllEntries | QDir::Hidden | QDir::NoDotAndDotDot, QDir::Name);
}

Volume ball(Index3 size, double radius) {
  Volume volume;
  volume.geometry.size = size;
  std::vector<std::int16_t> voxels;
  const glm::dvec3 middle = 0.5 * glm::dvec3(size - Index3(1));
  for (std::int64_t k = 0; k < size.z; ++k) {
    for (std::int64_t j = 0; j < size.y; ++j) {
      for (std::int64_t i = 0; i < size.x; ++i) {
        const bool inside = glm::length(glm::dvec3(i, j, k) - middle) < radius;
        voxels.push_back(inside ? std::int16_t{1000} : std::int16_t{0});
      }
    }
  }
  volume.voxels = std::move(voxels);
  return volume;
}

Mask ball_mask(const Volume& ball) {
  Mask mask{ball.geometry, {}};
  for (std::int64_t v = 0; v < ball.geometry.voxel_count(); ++v) {
    mask.voxels.push_back(ball.value(v) > 0.0F ? 1 : 0);
  }
  return mask;
}

QStringList ball_arguments(Index3 size) {
  const QString seed = QString("%1,%2,%3,4").arg(size.x / 2).arg(size.y / 2).arg(size.z / 2);
  return {"--target", "1000", "--range", "500", "--alpha", "0.8", "--seed", seed, "--threads", "1"};
}

SphereStudy::SphereStudy() {
  must_run({"phantom", "sphere", "--out", text(folder())});
  phantom_ = json_of(bytes_of(folder() / "phantom.json"));
  if (!phantom_.contains("target")) qFatal("there is no phantom");
}

QStringList SphereStudy::arguments() const {
  QStringList seed;
  for (const auto number : phantom_["seed"].toArray()) seed.append(QString::number(number.toDouble()));
  return {"segment",   text(folder() / "series"),
          "--target",  QString::number(phantom_["target"].toDouble()),
          "--range",   QString::number(phantom_["range"].toDouble()),
          "--alpha",   QString::number(phantom_["alpha"].toDouble()),
          "--seed",    seed.join(','),
          "--threads", "1"};
}

}  // namespace tidemark::test
