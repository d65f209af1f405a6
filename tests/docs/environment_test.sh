#!/usr/bin/env bash
# environment_test.sh SOURCE: docs/environment.md and the handbook's page for IT name every variable TIDEMARK_... that is read
# and every CMake option, and no other.
set -euo pipefail
cd "$1"
pages=(docs/environment.md handbook/for-it.md)

code() { find app bench cmake core document engine gpu imaging packaging renderer run solver test tests ui CMakeLists.txt \
  -type f \( "$@" \) -print0; }
names() { grep -oE 'TIDEMARK_[A-Z0-9_]+' | sort -u; }
# A call may be broken into lines, so a file is one line.
read_in_code() { code -name '*.cpp' -o -name '*.h' | xargs -0 grep -zhoE \
  '(getenv|qgetenv|qEnvironmentVariable[A-Za-z]*)\(\s*"TIDEMARK_[A-Z0-9_]+' | tr '\0' '\n'; }
read_in_scripts() { code -name '*.sh' -o -name run -o -name test | xargs -0 grep -hoE '\$\{?TIDEMARK_[A-Z0-9_]+'; }
declared() { code -name CMakeLists.txt -o -name '*.cmake' | xargs -0 grep -hoE '(option\(|set\()TIDEMARK_[A-Z0-9_]+.*' |
  grep -E '^option|CACHE' | grep -oE '^[a-z]+\(TIDEMARK_[A-Z0-9_]+'; }
rows() { sed -n "/^## $1/,/^## /p" "${pages[@]}" | grep -E '^\| `TIDEMARK_' | cut -d'|' -f2; }

compare() {
  local what=$1 found=$2 written=$3 difference
  [[ -n $found ]] || { echo "no $what found in the code"; exit 1; }
  difference=$(diff <(echo "$found") <(echo "$written")) || {
    echo "$what in the code (<) and in ${pages[*]} (>) differ:"
    echo "$difference"
    exit 1
  }
}
compare variables "$({ read_in_code; read_in_scripts; } | names)" \
  "$({ rows 'Environment variables'; rows 'Variables of the tests'; } | names)"
compare options "$(declared | names)" "$(rows 'CMake options' | names)"
