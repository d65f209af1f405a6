#!/usr/bin/env bash
# Makes the Debian packages from build/release, installs an older version of them in this system and then these, tries what
# was installed, removes and purges it, and looks that nothing is left. Needs root; what cannot be tried here is said.
# Leaves build/package/deb-tried/*.deb.
#   check_deb.sh [BUILD]   another finished build, which is taken as it is
set -euo pipefail

tidemark_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$tidemark_root/packaging/build.sh"
source "$tidemark_root/packaging/version.sh"
source "$tidemark_root/packaging/phantom.sh"
build=${1:-$tidemark_root/build/release}
debs=$tidemark_root/build/package/deb-tried
packages=(tidemark tidemark-cli tidemark-doc)

skip() {
  echo "!! SKIPPED: the Debian packages were not tried: $*"
  exit 0
}
fail() {
  echo "check_deb: $*" >&2
  exit 1
}
for tool in dpkg-buildpackage dh apt-get; do command -v "$tool" >/dev/null || skip "there is no $tool here"; done
((EUID == 0)) || skip "installing needs root"
# Somebody's own: neither replaced nor removed.
for package in "${packages[@]}"; do
  if dpkg -s "$package" >/dev/null 2>&1; then skip "a package '$package' is installed already"; fi
done

if (($# == 0)); then tidemark_build release tidemark_installed; fi
echo "== Making the packages"
"$tidemark_root/packaging/deb.sh" --from "$build" --out "$debs"
for deb in "$debs"/*.deb; do dpkg-deb -f "$deb" Package Version Depends; done

if command -v lintian >/dev/null; then
  echo "== lintian"
  lintian --allow-root --fail-on error "$debs"/*.deb || fail "lintian finds errors"
else
  echo "!! lintian is not installed: the packages were not held against Debian's rules"
fi

work=$(mktemp -d)
chmod 755 "$work"
purge() { DEBIAN_FRONTEND=noninteractive dpkg --purge "${packages[@]}" >/dev/null 2>&1; }
cleanup() {
  rm -rf "$work"
  purge || true
}
trap cleanup EXIT

# Files of this system, without those that say of themselves that they change: dpkg's, apt's and other caches.
files() {
  find /etc /opt /usr /var -xdev \( -path /var/cache -o -path /var/log -o -path /var/lib/apt -o -path /var/lib/dpkg \
    -o -path /var/tmp -o -name __pycache__ \) -prune -o -print | LC_ALL=C sort
}
install() {
  DEBIAN_FRONTEND=noninteractive apt-get install -y -q -o Dpkg::Use-Pty=0 -o DPkg::Lock::Timeout=300 \
    --no-install-recommends "$@" >"$work/apt.log" 2>&1 || { cat "$work/apt.log"; fail "apt-get install failed"; }
}

# What the packages bring along stays installed, so that it comes before the list of files.
echo "== What the packages depend on"
depends=$(for deb in "$debs"/*.deb; do dpkg-deb -f "$deb" Depends; done | tr ',' '\n' | sed -E 's/^ *//; s/[ (|].*//' |
  grep -vE '^tidemark' | sort -u)
mapfile -t missing < <(for package in $depends; do dpkg -s "$package" >/dev/null 2>&1 || echo "$package"; done)
if ((${#missing[@]} > 0)); then install "${missing[@]}"; fi
files >"$work/before"

echo "== Installing the version before, then this one"
mkdir "$work/old"
for deb in "$debs"/*.deb; do
  dpkg-deb -R "$deb" "$work/old/package"
  sed -i -E "s/^Version: .*/Version: 0.0.1/; s/= $tidemark_version\)/= 0.0.1)/" "$work/old/package/DEBIAN/control"
  dpkg-deb --root-owner-group -Z gzip -z 1 -b "$work/old/package" "$work/old/$(basename "$deb")" >/dev/null
  rm -rf "$work/old/package"
done
install "$work"/old/*.deb
[[ $(dpkg-query -W -f '${Version}' tidemark) == 0.0.1 ]] || fail "the older version is not installed"
cp "$debs"/*.deb "$work"
install "$work"/*.deb
for package in "${packages[@]}"; do
  [[ $(dpkg-query -W -f '${Version}' "$package") == "$tidemark_version" ]] || fail "$package was not upgraded"
done

# What is tried from here on is what was installed, and nothing of the build: PATH holds the system's folders alone.
export PATH=/usr/sbin:/usr/bin:/sbin:/bin
cd "$work"

echo "== Segmenting a phantom with the installed tidemark-cli"
[[ $(command -v tidemark-cli) == /usr/bin/tidemark-cli ]] || fail "tidemark-cli is not in /usr/bin"
tidemark_try_phantom . . tidemark-cli || fail "not the phantom's figures"

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
  metainfo/org.tidemark.Tidemark.metainfo.xml doc/tidemark/copyright doc/tidemark-cli/copyright doc/tidemark/changelog.gz; do
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

echo "== Removing it, and looking for what is left"
DEBIAN_FRONTEND=noninteractive apt-get remove -y -q -o DPkg::Lock::Timeout=300 "${packages[@]}" >/dev/null
[[ ! -e /usr/bin/tidemark-cli && ! -e /usr/bin/tidemark ]] || fail "a program is still there"
purge || fail "purging fails"
files >"$work/after"
# Other packages that were installed meanwhile are theirs.
LC_ALL=C comm -13 "$work/before" "$work/after" | grep -i tidemark && fail "these files are left"
left=$(LC_ALL=C comm -13 "$work/before" "$work/after")
if [[ -n $left ]]; then
  while read -r file; do
    dpkg -S "$file" >/dev/null 2>&1 || echo "$file"
  done <<<"$left" >"$work/left"
  if [[ -s $work/left ]]; then
    cat "$work/left"
    fail "these files are left, and no package's"
  fi
fi
echo "== The Debian packages work: $debs"
