#!/usr/bin/env bash
# manual_test.sh TIDEMARK_CLI PAGE [TIDEMARK PAGE]: the commands and options in the program's help, and those in its page of
# the manual, are the same. The desktop's page has each option of its help.
set -euo pipefail
cli=$1
page=$2
desktop=${3:-}
desktop_page=${4:-}

options_in() { grep -oE -- '--[a-z][a-z-]+' | sort -u; }

# The commands, and those of groups ("pacs echo").
words_in() { sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p'; }
help=$("$cli" --help)
commands=$(words_in <<<"$help")
[[ $commands == *segment* ]] || { echo "no commands found in the help"; exit 1; }
for command in $commands; do
  own=$("$cli" "$command" --help)
  help+=$own
  for part in $(words_in <<<"$own"); do
    help+=$("$cli" "$command" "$part" --help)
    commands+=$'\n'"$command $part"
  done
done
in_help=$(options_in <<<"$help")
[[ $in_help == *--target* ]] || { echo "no options found in the help of the commands"; exit 1; }

# As the page prints it: without roff's backslashes.
manual=$(sed 's/\\//g' "$page")
difference=$(diff <(echo "$in_help") <(options_in <<<"$manual")) || {
  echo "options in the help (<) and in $(basename "$page") (>) differ:"
  echo "$difference"
  exit 1
}
while read -r command; do
  grep -qE -- "^\.BI? $command( |\$)" <<<"$manual" || { echo "the command $command is not in $(basename "$page")"; exit 1; }
done <<<"$commands"

[[ -n $desktop ]] || exit 0
in_help=$(QT_QPA_PLATFORM=offscreen "$desktop" --help | options_in)
[[ $in_help == *--diagnostics* ]] || { echo "no options found in the desktop's help"; exit 1; }
missing=$(comm -23 <(echo "$in_help") <(sed 's/\\//g' "$desktop_page" | options_in))
[[ -z $missing ]] || { echo "$(basename "$desktop_page") lacks:"; echo "$missing"; exit 1; }
