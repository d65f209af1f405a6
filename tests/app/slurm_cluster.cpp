#include "tests/app/slurm_cluster.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <QFile>
#include <QStandardPaths>
#include <QSysInfo>
#include <QThread>
#include <random>

#include "core/atomic_file.h"
#include "tests/imaging/pacs/archives.h"

namespace tidemark::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLongestStart = 60'000;  // ms, also on a busy machine
constexpr int kLongestQueue = 200'000;
constexpr int kShownLines = 8;
constexpr const char* kNodes[] = {"node-a", "node-b"};

// It starts the daemons and waits for its input's end, which comes with the test program's, however that
// ends. What they leave behind becomes its children, as it is their subreaper: it kills its children until
// there are none.
constexpr const char* kGuard = R"(
cd "$1" || exit 1
[ -r /proc/$$/task/$$/children ] || { echo "the kernel lists no children of a process"; exit 1; }
keep() { { "${@:2}" >"$1.log" 2>&1; echo "$1 ended with code $?"; } & }
keep munged "$2" --foreground --force --key-file="$1/munge.key" --socket="$1/munge.socket" \
  --pid-file="$1/munged.pid" --seed-file="$1/munged.seed"
while [ ! -S munge.socket ] && kill -0 $!; do
  read -rt 0.05
  [ $? -gt 128 ] || break  # no input yet, or its end
done
keep slurmctld "$3" -D -f "$1/slurm.conf"
keep node-a "$4" -D -N node-a -f "$1/slurm.conf"
keep node-b "$4" -D -N node-b -f "$1/slurm.conf"
cat >/dev/null
exec >/dev/null 2>&1
while true; do
  read -ra children </proc/$$/task/$$/children
  [ ${#children[@]} -gt 0 ] || break
  kill -KILL "${children[@]}"
  sleep 0.05
done
)";

// Where Debian has daemons, ordinary users have no path to.
QString daemon_path(const QString& program) {
  QString found = QStandardPaths::findExecutable(program);
  if (found.isEmpty()) found = QStandardPaths::findExecutable(program, {"/usr/sbin", "/usr/local/sbin"});
  if (found.isEmpty()) qFatal("%s is not installed: packaging/dependencies.sh has it", qPrintable(program));
  return found;
}

// Such as 22.05, as a number.
double version_of(const QString& slurmctld) {
  QProcess process;
  process.start(slurmctld, {"-V"});
  process.waitForFinished();
  const QByteArray said = process.readAllStandardOutput();  // "slurm-wlm 22.05.8"
  const QList<QByteArray> numbers = said.mid(said.lastIndexOf(' ') + 1).split('.');
  if (numbers.size() < 2) qFatal("%s says no version: %s", qPrintable(slurmctld), said.constData());
  return (numbers[0] + '.' + numbers[1]).toDouble();
}

void must_write(const fs::path& file, const std::string& text) {
  if (const Status written = write_file(file, text); !written) qFatal("%s", written.error().message.c_str());
}

void write_configuration(const fs::path& folder, int largest_array) {
  std::string text =
      fmt::format(R"(ClusterName=tidemark
SlurmctldHost={1}(127.0.0.1)
SlurmctldPort={2}
SlurmUser={3}
SlurmdUser={3}
AuthType=auth/munge
# Nothing that was requeued starts again before its credential has expired.
AuthInfo=socket={0}/munge.socket,cred_expire=5
StateSaveLocation={0}/state
SlurmdSpoolDir={0}/spool-%n
SlurmctldPidFile={0}/slurmctld.pid
SlurmdPidFile={0}/%n.pid
PlugStackConfig={0}/plugstack.conf
MailProg=/bin/true
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=5
MaxArraySize={4}
)",
                  folder.string(), QSysInfo::machineHostName().section('.', 0, 0).toStdString(), free_port(),
                  ::geteuid(), largest_array);
  for (const char* node : kNodes) {
    fs::create_directories(folder / fmt::format("spool-{}", node));
    text += fmt::format("NodeName={} NodeHostname={} NodeAddr=127.0.0.1 Port={} CPUs=2 RealMemory=2000\n",
                        node, QSysInfo::machineHostName().section('.', 0, 0).toStdString(), free_port());
  }
  text += "PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP\n";
  fs::create_directories(folder / "state");
  must_write(folder / "slurm.conf", text);
  must_write(folder / "plugstack.conf", "");
  // No control groups, which not every system has. Earlier versions do not know the word "disabled"; their
  // first plugin looks for groups only once a task asks for one.
  constexpr double kKnowsDisabled = 23.11;
  const bool knows = version_of(daemon_path("slurmctld")) >= kKnowsDisabled;
  must_write(folder / "cgroup.conf", fmt::format("CgroupPlugin={}\n", knows ? "disabled" : "cgroup/v1"));
}

void write_key(const fs::path& file) {
  std::random_device random;
  std::string key;
  for (int i = 0; i < 128; ++i) key += static_cast<char>(random());
  must_write(file, key);
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
}

}  // namespace

SlurmCluster::SlurmCluster(int largest_array) {
  // munged wants its socket to be in reach of all.
  fs::permissions(folder_.path(), fs::perms(0711));
  write_key(folder_ / "munge.key");
  write_configuration(folder_.path(), largest_array);
  start_daemons();
  QElapsedTimer timer;
  for (timer.start(); timer.elapsed() < kLongestStart && !has_ended(); QThread::msleep(100)) {
    if (run("sinfo --noheader --format='%T %D'").out == "idle 2\n") return;
  }
  qFatal("Slurm cannot be started: %s\n%s", said_by_guard_.constData(), log().constData());
}

void SlurmCluster::start_daemons() {
  guard_.setProcessChannelMode(QProcess::MergedChannels);
  guard_.setProcessEnvironment(environment());
  guard_.setChildProcessModifier([] {
    ::setsid();  // Ctrl-C is not for it
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  });
  guard_.start("bash", {"-c", kGuard, "bash", text(folder_.path()), daemon_path("munged"),
                        daemon_path("slurmctld"), daemon_path("slurmd")});
  if (!guard_.waitForStarted()) qFatal("bash: %s", qPrintable(guard_.errorString()));
}

// The daemons do not end before they are ended.
bool SlurmCluster::has_ended() {
  guard_.waitForReadyRead(0);
  said_by_guard_ += guard_.readAll();
  return guard_.state() != QProcess::Running || said_by_guard_.contains("ended with code");
}

SlurmCluster::~SlurmCluster() {
  guard_.closeWriteChannel();
  if (!guard_.waitForFinished(20'000)) qWarning("Slurm does not end: %s", log().constData());
}

QProcessEnvironment SlurmCluster::environment() const {
  QProcessEnvironment variables = QProcessEnvironment::systemEnvironment();
  // The test may itself run in a task of another Slurm.
  for (const QString& name : variables.keys()) {
    for (const char* start : {"SLURM", "SBATCH_", "SQUEUE_", "SINFO_", "SCANCEL_", "SCONTROL_"}) {
      if (name.startsWith(start)) variables.remove(name);
    }
  }
  variables.insert("SLURM_CONF", text(folder_ / "slurm.conf"));
  return variables;
}

Outcome SlurmCluster::run(const QString& command) const {
  QProcess process;
  process.setProcessEnvironment(environment());
  process.start("bash", {"-c", command});
  Outcome outcome;
  if (process.waitForFinished(kLongestStart) && process.exitStatus() == QProcess::NormalExit) {
    outcome.code = process.exitCode();
  }
  outcome.out = process.readAllStandardOutput();
  outcome.err = process.readAllStandardError();
  return outcome;
}

QByteArray SlurmCluster::must_run(const QString& command) const {
  const Outcome outcome = run(command);
  if (outcome.code != 0) {
    qWarning("%s: %s\n%s", qPrintable(command), outcome.told().constData(), log().constData());
  }
  return outcome.out;
}

QStringList SlurmCluster::running_on(const QString& node) const {
  const QByteArray out =
      must_run("squeue --noheader --states=RUNNING --format=%i --sort=i --nodelist=" + node);
  return QString::fromUtf8(out).split('\n', Qt::SkipEmptyParts);
}

QString SlurmCluster::wait_until_empty() const {
  QByteArray left;
  QElapsedTimer timer;
  for (timer.start(); timer.elapsed() < kLongestQueue; QThread::msleep(100)) {
    const Outcome outcome = run("squeue --noheader --format='%i %T %N %r'");
    if (outcome.code == 0 && outcome.out.isEmpty()) return {};
    left = outcome.told();
  }
  return QString::fromUtf8(left + log());
}

QByteArray SlurmCluster::log() const {
  QByteArray all;
  for (const char* daemon : {"munged", "slurmctld", "node-a", "node-b"}) {
    const QList<QByteArray> lines = bytes_of(folder_ / fmt::format("{}.log", daemon)).trimmed().split('\n');
    all +=
        QByteArray(daemon) + ":\n" + lines.mid(std::max<qsizetype>(0, lines.size() - kShownLines)).join('\n');
    all += '\n';
  }
  return all;
}

}  // namespace tidemark::test
