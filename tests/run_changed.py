#!/usr/bin/env python3
"""Runs the tests of a preset but those that passed before with the same program and files.

    tests/run_changed.py PRESET [--all] [option of ctest ...]

A test's result is the same while these are: its command and environment; the bits of the programs that it runs, and what
else its REQUIRED_FILES are; every file of the project that is not C++, and for a script that too; the studies; the
processor and the packages of the machine. What passed is kept beside the build, so that a fresh build runs everything. --all runs
everything in any case.
"""

import hashlib
import json
import os
import pathlib
import subprocess
import sys
import xml.etree.ElementTree

PROJECT = pathlib.Path(__file__).resolve().parent.parent
NOT_OF_IT = {"build", "out", "__pycache__"}
CPP = {".cpp", ".h"}
# What is another in each terminal and each session.
VOLATILE = {"_", "COLUMNS", "DISPLAY", "INVOCATION_ID", "JOURNAL_STREAM", "LINES", "OLDPWD", "PWD", "SHLVL", "TERM",
            "WINDOWID", "XAUTHORITY"}


def output(*command):
    return subprocess.run(command, cwd=PROJECT, check=True, capture_output=True).stdout


def files_below(folder):
    found = []
    for place, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name not in NOT_OF_IT and not name.startswith(".")]
        found += [pathlib.Path(place, name) for name in names if name != "compile_commands.json"]
    return found


def processor():
    """What it is and can do: vectorised code is chosen by it."""
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    return sorted({line for line in lines if line.startswith(("model name", "flags", "Features"))})


def digest(*parts):
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()


class Files:
    """The digests of files, each read once."""

    def __init__(self):
        self.known = {}

    def of(self, path):
        if path not in self.known:
            with open(path, "rb") as file:
                self.known[path] = hashlib.file_digest(file, "sha256").hexdigest()
        return self.known[path]

    def of_all(self, paths):
        return digest(*(f"{path} {self.of(path)}" for path in sorted(paths) if path.is_file()))


def studies():
    """Their names, sizes and times: they are too large to be read for this."""
    folder = pathlib.Path(os.environ.get("TIDEMARK_STUDIES", PROJECT.parent / "shared" / "data"))
    listed = []
    for path in sorted(files_below(folder)):
        status = path.lstat()
        listed.append(f"{path} {status.st_size} {status.st_mtime_ns}")
    return digest(*listed)


class Inputs:
    """Everything that decides a test's result."""

    def __init__(self, build):
        self.programs = build / "tests"
        self.files = Files()
        project = files_below(PROJECT)
        self.cpp = self.files.of_all(path for path in project if path.suffix in CPP)
        variables = sorted(f"{name}={value}" for name, value in os.environ.items() if name not in VOLATILE)
        self.common = digest(self.files.of_all(path for path in project if path.suffix not in CPP), studies(),
                             output("dpkg-query", "-W").decode(), *processor(), *variables)

    def of(self, test):
        properties = {one["name"]: one["value"] for one in test.get("properties", [])}
        command = test.get("command", [])  # none: its program has not been built
        named = [pathlib.Path(word) for word in [*command, *properties.get("REQUIRED_FILES", [])]]
        is_program = any(path.parent == self.programs for path in named)
        return digest(self.common, "" if is_program else self.cpp, *command, *properties.get("ENVIRONMENT", []),
                      *(self.files.of_all(files_below(path) if path.is_dir() else [path]) for path in named))


def passed_before(kept):
    try:
        return json.loads(kept.read_text())
    except (FileNotFoundError, json.JSONDecodeError):
        return {}


def passed_in(report):
    cases = xml.etree.ElementTree.parse(report).getroot().iter("testcase")
    return {case.get("name") for case in cases if case.get("status") == "run"}


def main(preset, options):
    run_all = "--all" in options
    options = [option for option in options if option != "--all"]
    build = PROJECT / "build" / preset
    ctest = ["ctest", "--preset", preset]
    wanted = json.loads(output(*ctest, *options, "--show-only=json-v1"))["tests"]
    kept = build / "passed_tests.json"
    passed = passed_before(kept)
    inputs = Inputs(build)
    now = {test["name"]: inputs.of(test) for test in wanted}
    to_run = {name for name in now if run_all or passed.get(name) != now[name]}
    if len(to_run) < len(now):
        print(f"{len(now) - len(to_run)} of {len(now)} tests have passed with the same program and files, and are not "
              "run again", flush=True)
    if not to_run:
        return 0
    numbers = [str(number) for number, test in enumerate(wanted, 1) if test["name"] in to_run]
    report = build / "test_report.xml"
    report.unlink(missing_ok=True)
    result = subprocess.run([*ctest, *options, "--output-junit", str(report),
                             "-I", ",".join(["0,0,0", *numbers])], cwd=PROJECT, check=False)
    if report.exists():
        good = passed_in(report)
        for name in to_run:
            passed.pop(name, None)
            if name in good:
                passed[name] = now[name]
        written = kept.with_suffix(".new")
        written.write_text(json.dumps(passed, indent=1, sort_keys=True))
        written.replace(kept)
    return result.returncode


if __name__ == "__main__":
    if len(sys.argv) < 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    sys.exit(main(sys.argv[1], sys.argv[2:]))
