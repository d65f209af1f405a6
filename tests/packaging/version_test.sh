#!/usr/bin/env bash
# version_test.sh SOURCE: every package has a version and a date, also where there is no git, and in an unpacked archive; the
# files that pages and manifests name are of that version.
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/archive" "$work/bin"
cp "$source/CMakeLists.txt" "$source/CHANGELOG.md" "$work/archive"
touch -d @1700000000 "$work/archive/CHANGELOG.md"
for tool in bash sed stat; do ln -s "$(command -v $tool)" "$work/bin"; done

# date_of PATH: as packaging/version.sh finds it with these programs.
date_of() {
  env -i PATH="$1" bash -c 'set -euo pipefail; tidemark_root=$1; source "$2/packaging/version.sh"
    [[ $tidemark_version =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] && echo "$SOURCE_DATE_EPOCH"' - "$work/archive" "$source"
}
for path in "$work/bin" "$PATH"; do
  date=$(date_of "$path")
  [[ $date == 1700000000 ]] || { echo "with $path the date is '$date'"; exit 1; }
done

tidemark_root=$source
source "$source/packaging/version.sh"
named=(packaging/flatpak/org.tidemark.Tidemark.yaml handbook/install.md handbook/languages/de/LC_MESSAGES/install.po)
for file in "${named[@]}"; do
  # As in tidemark-0.1.0-x86_64.tar.xz, tidemark_0.1.0_amd64.deb and tidemark-cli:0.1.0.
  versions=$(grep -oE 'tidemark(-cli|-doc)?[-_:][0-9]+\.[0-9]+\.[0-9]+' "$source/$file" | sed 's/.*[-_:]//' | sort -u)
  [[ $versions == "$tidemark_version" ]] || { echo "$file names files of ${versions:-no version}, not $tidemark_version"; exit 1; }
done
