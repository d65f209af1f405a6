#!/usr/bin/env bash
# manual_test.sh TIDEMARK_CLI PAGE: every command and option of the program's help stands in its page of the manual.
set -euo pipefail
cli=$1
page=$2

# As the page prints them: without roff's backslashes.
text=$(sed 's/\\//g' "$page")
missing=0
expect() {
  if ! grep -qE -- "(^|[^a-z-])$1([^a-z-]|\$)" <<<"$text"; then
    echo "not in $(basename "$page"): $1 ($2)"
    missing=1
  fi
}

commands=$("$cli" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[[ $commands == *segment* ]] || { echo "no commands found in the help"; exit 1; }
for command in $commands; do
  expect "$command" "a command"
  options=$("$cli" "$command" --help | sed -nE 's/^  (-h,)?(--[a-z-]+).*/\2/p')
  [[ $options == *--json* ]] || { echo "no options found in the help of $command"; exit 1; }
  for option in $options; do expect "$option" "$command"; done
done

# And the other way round: nothing that the program does not have.
known=$({ "$cli" --help; for command in $commands; do "$cli" "$command" --help; done; } | grep -oE -- '--[a-z][a-z-]+' | sort -u)
for option in $(grep -oE -- '--[a-z][a-z-]+' <<<"$text" | sort -u); do
  if ! grep -qx -- "$option" <<<"$known"; then
    echo "in $(basename "$page"), but not in the program: $option"
    missing=1
  fi
done
exit $missing
