#!/usr/bin/env bash
# release.sh [--quick] [TAG]: everything that a release consists of, from a clean tree, in build/release-VERSION: bundle, Debian
# packages with their sources, RPM, OCI image, bills of materials, the section of CHANGELOG.md, and SHA256SUMS.
#   TAG       is held against the project's version (vX.Y.Z), the last commit and the signature
#   --quick   Debian packages from build/release instead of compiled in a clean system, to try the rest
# Needs root for the clean system and the image. docs/how-to/release.md has what comes before and after.
set -euo pipefail

tidemark_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$tidemark_root/packaging/dependencies.sh"
source "$tidemark_root/packaging/build.sh"
source "$tidemark_root/packaging/version.sh"
packaging=$tidemark_root/packaging
made=$tidemark_root/build/package
release=$tidemark_root/build/release-$tidemark_version

fail() {
  echo "release: $*" >&2
  exit 1
}
quick=false
if [[ ${1:-} == --quick ]]; then
  quick=true
  shift
fi
cd "$tidemark_root"
[[ -z $(git status --porcelain) ]] || fail "the tree is not clean"
if (($# > 0)); then
  tag=$1
  [[ $tag == "v$tidemark_version" ]] || fail "$tag is not v$tidemark_version, the version in CMakeLists.txt"
  [[ $(git rev-parse "$tag^{commit}") == $(git rev-parse HEAD) ]] || fail "$tag is not the commit that is checked out"
  git verify-tag "$tag" || fail "$tag is not signed by a key that is known here"
fi

grep -q "/tidemark-$tidemark_version-x86_64" packaging/flatpak/*.yaml || fail "the Flatpak manifest names another version"

# The section of this version, and before its release that of what is unreleased.
section() {
  awk -v version="$1" '$0 ~ "^## \\[" version "\\]" { on = 1; next } /^## / { on = 0 } on' CHANGELOG.md
}
changes=$(section "${tidemark_version//./\\.}")
if [[ -z $changes ]]; then
  (($# == 0)) || fail "CHANGELOG.md has no section [$tidemark_version]"
  changes=$(section Unreleased)
fi

((EUID == 0)) && tidemark_install_dependencies --packages
tidemark_build release tidemark_installed
if tidemark_has_target release handbook; then tidemark_build release handbook; fi
rm -rf "$release"
mkdir -p "$release"
"$packaging/bundle.sh"
if $quick; then "$packaging/deb.sh" --from "$tidemark_root/build/release"; else "$packaging/deb.sh"; fi
"$packaging/rpm.sh"
"$packaging/oci.sh"
"$packaging/check_bundle.sh"

name=tidemark-$tidemark_version
cp "$made/$name-x86_64".{tar.xz,run} "$made/$name-1.x86_64.rpm" "$made/tidemark-cli-$tidemark_version-oci.tar" "$release"
find "$made/deb" -type f ! -name log -exec cp -t "$release" {} +
for bill in spdx cdx; do cp "$made/$name-x86_64/share/doc/sbom/tidemark.$bill.json" "$release/$name.$bill.json"; done
printf '# Tidemark %s\n%s\n' "$tidemark_version" "$changes" >"$release/CHANGES.md"
(cd "$release" && find . -type f -printf '%P\n' | LC_ALL=C sort | xargs sha256sum) >"$made/SHA256SUMS"
mv "$made/SHA256SUMS" "$release"
echo "== $release"
cat "$release/SHA256SUMS"
