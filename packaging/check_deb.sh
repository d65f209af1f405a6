#!/usr/bin/env bash
# Builds the Debian package from build/release, installs it in this system, tries what was installed, and removes it.
# Needs root; what cannot be tried here is said. Leaves build/release/package/tidemark_*.deb.
set -euo pipefail

tidemark_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$tidemark_root/packaging/build.sh"
build=$tidemark_root/build/release

skip() {
  echo "!! SKIPPED: the Debian package was not tried: $*"
  exit 0
}
fail() {
  echo "check_deb: $*" >&2
  exit 1
}
for tool in dpkg dpkg-shlibdeps apt-get; do command -v "$tool" >/dev/null || skip "there is no $tool here"; done
((EUID == 0)) || skip "installing needs root"
# Somebody's own: neither replaced nor removed.
if dpkg -s tidemark >/dev/null 2>&1; then skip "a package 'tidemark' is installed already"; fi

tidemark_build release tidemark_installed
rm -rf "$build/package"
echo "== Making the package"
(cd "$build" && cpack -G DEB -B "$build/package" >"$build/package.log" 2>&1) || { cat "$build/package.log"; fail "cpack failed"; }
deb=$(ls "$build"/package/*.deb)
dpkg-deb -I "$deb" | sed -n '/Package:/,/Description:/p'

work=$(mktemp -d)
chmod 755 "$work"
cleanup() {
  rm -rf "$work"
  if dpkg -s tidemark >/dev/null 2>&1; then DEBIAN_FRONTEND=noninteractive dpkg --purge tidemark >/dev/null; fi
}
trap cleanup EXIT

echo "== Installing $(basename "$deb")"
cp "$deb" "$work/tidemark.deb"
DEBIAN_FRONTEND=noninteractive apt-get install -y -q -o Dpkg::Use-Pty=0 --no-install-recommends "$work/tidemark.deb"

# What is tried from here on is what was installed, and nothing of the build: PATH holds the system's folders alone.
cmake=$(command -v cmake)
export PATH=/usr/sbin:/usr/bin:/sbin:/bin
cd "$work"
value() { sed -nE "s/.*\"$2\": *([-0-9.e+]+).*/\1/p" "$1" | head -n 1; }

echo "== Segmenting a phantom with the installed tidemark-cli"
[[ $(command -v tidemark-cli) == /usr/bin/tidemark-cli ]] || fail "tidemark-cli is not in /usr/bin"
tidemark-cli phantom tumour --out tumour >/dev/null
read -r -a options < <("$cmake" -DJSON=tumour/phantom.json -P "$tidemark_root/packaging/phantom_options.cmake")
tidemark-cli segment tumour/series "${options[@]}" --truth tumour/truth.nii.gz --out mask.nii.gz --out surface.stl \
  --stats statistics.json
for file in mask.nii.gz surface.stl; do [[ -s $file ]] || fail "$file was not written"; done
dice=$(value statistics.json dice)
volume=$(value statistics.json volume_ml)
awk -v dice="$dice" -v volume="$volume" 'BEGIN { exit !(dice >= 0.98 && volume > 112 && volume < 119) }' ||
  fail "the tumour has $volume ml (117.6 are right) and a Dice of $dice"

echo "== What belongs to the programs"
for page in tidemark tidemark-cli; do
  gzip -dc "/usr/share/man/man1/$page.1.gz" | grep -q '^\.SH NAME' || fail "no manual page $page(1)"
done
for side in 16 48 256 512; do
  file=/usr/share/icons/hicolor/${side}x$side/apps/tidemark.png
  [[ $(dd if="$file" bs=1 skip=16 count=4 2>/dev/null | od -An -tu1 | awk '{ print $3 * 256 + $4 }') == "$side" ]] ||
    fail "$file is not $side pixels wide"
done
for file in icons/hicolor/scalable/apps/tidemark.svg applications/tidemark.desktop mime/packages/tidemark.xml \
  metainfo/org.tidemark.Tidemark.metainfo.xml doc/tidemark/copyright doc/tidemark/third-party.md; do
  [[ -s /usr/share/$file ]] || fail "/usr/share/$file is missing"
done
if command -v appstreamcli >/dev/null; then
  appstreamcli validate --no-net --explain /usr/share/metainfo/org.tidemark.Tidemark.metainfo.xml ||
    fail "the AppStream description is not valid"
fi
if command -v desktop-file-validate >/dev/null; then desktop-file-validate /usr/share/applications/tidemark.desktop; fi
if command -v update-mime-database >/dev/null; then  # run by dpkg when the package was unpacked
  for known in 'application/x-tidemark-session:*.tidemark' 'application/x-nifti:*.nii' 'application/x-nrrd:*.nrrd'; do
    grep -qxF "$known" /usr/share/mime/globs || fail "files are not known as $known"
  done
fi

if [[ -x /usr/bin/tidemark ]]; then
  echo "== The installed tidemark"
  QT_QPA_PLATFORM=xcb xvfb-run -a /usr/bin/tidemark --diagnostics | tee diagnostics.txt
  grep -q '^tidemark: *[0-9]' diagnostics.txt || fail "tidemark --diagnostics says no version"
fi

if command -v lintian >/dev/null; then
  echo "== lintian (for information)"
  lintian --allow-root "$work/tidemark.deb" || true
fi

echo "== Removing it"
DEBIAN_FRONTEND=noninteractive apt-get purge -y -q tidemark >/dev/null
[[ ! -e /usr/bin/tidemark-cli ]] || fail "tidemark-cli is still there"
echo "== The Debian package works: $deb"
