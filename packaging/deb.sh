#!/usr/bin/env bash
# deb.sh              the Debian source package of the last commit, and its binary packages, compiled in a clean Debian 12 that
#                     has nothing but build-essential and what debian/control asks for. Needs root and mmdebstrap.
# deb.sh --source     the source package alone
# deb.sh --from BUILD the binary packages from a finished build, without compiling
# Leaves them in build/package/deb (--from: in the folder that --out names, else there).
# Source packages are native: sources and packaging are released together, so that no version has two packagings.
set -euo pipefail

tidemark_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$tidemark_root/packaging/build.sh"
source "$tidemark_root/packaging/version.sh"
source "$tidemark_root/packaging/chroot.sh"
source "$tidemark_root/packaging/dependencies.sh"
out=$tidemark_root/build/package/deb
mode=clean
build=

fail() {
  echo "deb: $*" >&2
  exit 1
}
while (($# > 0)); do
  case $1 in
    --source) mode=source ;;
    --from)
      mode=from
      build=$(cd "${2:?--from needs a build}" && pwd)
      shift
      ;;
    --out)
      out=${2:?--out needs a folder}
      shift
      ;;
    *) fail "unexpected argument '$1'" ;;
  esac
  shift
done
for tool in dpkg-buildpackage dh; do command -v "$tool" >/dev/null || fail "there is no $tool here"; done

# One list of what a build needs, and the other: both are right.
for package in "${tidemark_packages[@]}"; do
  case $package in
    # Debian's own, or needed by running alone.
    g++ | ccache | libegl1 | libgl1 | libgl1-mesa-dri) continue ;;
  esac
  grep -qE "^ $package\b" "$tidemark_root/packaging/debian/control" || fail "debian/control does not ask for $package"
done

work=$(mktemp -d)
chmod 755 "$work"
trap 'rm -rf "$work"' EXIT
source=$work/tidemark-$tidemark_version
mkdir -p "$source" "$out"
rm -f "$out"/tidemark*

# debian/ as Debian wants it, from packaging/debian.
add_debian() {
  cp -r "$tidemark_root/packaging/debian" "$source/debian"
  sed -e "s/@VERSION@/$tidemark_version/" -e "s/@DATE@/$(LC_ALL=C date -u -R -d "@$SOURCE_DATE_EPOCH")/" \
    "$source/debian/changelog.in" >"$source/debian/changelog"
  rm "$source/debian/changelog.in"
}

if [[ $mode == from ]]; then
  cp -r "$tidemark_root"/{docs,README.md} "$source"
  add_debian
  (cd "$source" && TIDEMARK_BUILD=$build dpkg-buildpackage -b -us -uc -d --no-sign) >"$out/log" 2>&1 || {
    tail -n 40 "$out/log"
    fail "dpkg-buildpackage failed"
  }
  cp "$work"/*.deb "$out"
  exit
fi

echo "== The source package"
git -C "$tidemark_root" archive HEAD | tar -x -C "$source"
add_debian
(cd "$work" && dpkg-source -b "$source" >"$out/log") || { cat "$out/log"; fail "dpkg-source failed"; }
cp "$work"/*.dsc "$work"/*.tar.* "$out"
if [[ $mode == source ]]; then exit; fi

((EUID == 0)) || fail "a clean system needs root"
command -v mmdebstrap >/dev/null || fail "there is no mmdebstrap here"
echo "== A clean Debian 12 with what the source package asks for"
tidemark_suite bookworm || fail "Debian 12 cannot be had: build/chroots/bookworm.log"
clean=$work/clean
tidemark_chroot bookworm "$clean"
mkdir "$clean/build"
cp "$out"/*.dsc "$out"/*.tar.* "$clean/build"
# shellcheck disable=SC2016
tidemark_inside "$clean" sh -ec 'apt-get update -q && apt-get install -y -q build-essential && apt-get build-dep -y -q /build/*.dsc' \
  >>"$out/log" 2>&1 || { tail -n 40 "$out/log"; fail "what is needed could not be installed"; }
echo "== Compiling (build/package/deb/log)"
tidemark_inside "$clean" sh -ec "cd /build && dpkg-source -x ./*.dsc source && cd source &&
  DEB_BUILD_OPTIONS=parallel=$(tidemark_jobs) nice -n 19 dpkg-buildpackage -b -us -uc" >>"$out/log" 2>&1 || {
  tail -n 40 "$out/log"
  fail "it does not compile in a clean system"
}
cp "$clean"/build/*.deb "$clean"/build/*.buildinfo "$out"
ls -l "$out"
