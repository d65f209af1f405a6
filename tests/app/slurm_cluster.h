// A Slurm of two nodes, started on this machine for a test and ended with it.
#pragma once

#include <QProcess>
#include <QStringList>

#include "tests/app/cli_runner.h"
#include "tests/support/support.h"

namespace tidemark::test {

// Its nodes are node-a and node-b, with two processors each. All it needs lies in a folder of its own: no
// service of the machine is asked, and none of its configuration is read. It runs as the user who runs the
// test.
class SlurmCluster {
 public:
  // Arrays have at most so many tasks. Ends the test program when the cluster cannot be started.
  explicit SlurmCluster(int largest_array);
  // Ends all that runs in it. That happens, too, when the test program is killed.
  ~SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  // In which Slurm's commands find it.
  [[nodiscard]] QProcessEnvironment environment() const;
  // Runs a command line of a shell to its end.
  [[nodiscard]] Outcome run(const QString& command) const;
  // The same for one that should succeed; else its output is shown.
  QByteArray must_run(const QString& command) const;
  // The ids of the tasks that run on a node, as Slurm's commands take them: "12_3".
  [[nodiscard]] QStringList running_on(const QString& node) const;
  // Waits until no task runs or waits. "" on success, else what is left.
  [[nodiscard]] QString wait_until_empty() const;
  // The last lines of what its daemons have said.
  [[nodiscard]] QByteArray log() const;

 private:
  void start_daemons();
  [[nodiscard]] bool has_ended();

  TemporaryFolder folder_;
  QProcess guard_;
  QByteArray said_by_guard_;
};

}  // namespace tidemark::test
