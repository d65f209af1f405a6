#!/usr/bin/env bash
# prose_test.sh SOURCE: each header begins with a noun phrase, and no page or message uses the phrases below, which hide
# who does what.
set -euo pipefail
cd "$1"
folders=(app bench core document engine gpu imaging renderer solver tests ui)
failed=0

complain() {
  [[ -z $2 ]] && return
  echo "$1"
  echo "$2"
  failed=1
}

headers=$(find "${folders[@]}" -name '*.h')
[[ $(wc -l <<<"$headers") -gt 300 ]] || { echo "few headers found"; exit 1; }
complain "Headers that do not begin with a comment:" \
  "$(xargs awk 'FNR == 1 && !/^\/\/ [^ ]/ { print FILENAME }' <<<"$headers")"
complain "Headers that begin with a question or a verb instead of a noun phrase:" \
  "$(xargs awk 'FNR == 1 && /^\/\/ (How|What|Whether|Where|When|Which|Who|Why|Asks|Does|Gives|Holds|Is|Keeps|Makes|Puts|Says|Shows|Tells)[ ,]/ { print FILENAME ": " $0 }' <<<"$headers")"

phrases='(is|are|was|were|be|been) told( of| about)?\b|it is told|(is|are) taken (as|for) |more than is taken|what is (told|taken|followed)'
complain "Phrases on pages:" \
  "$(grep -nEi "$phrases" README.md CHANGELOG.md CONTRIBUTING.md packaging/man/* $(find docs handbook -name '*.md') || true)"
# It leaves most of what tells who a patient is; `tidemark-cli deidentify` does not.
complain "Pages that remove patients by dcmodify:" "$(grep -nE 'dcmodify -ea' ./*.md $(find docs handbook -name '*.md') || true)"
complain "Phrases in messages:" "$(find app core document engine imaging renderer solver ui -name '*.cpp' -print0 |
  xargs -0 grep -nEi "\"[^\"]*($phrases)" || true)"
exit "$failed"
