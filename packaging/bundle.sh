#!/usr/bin/env bash
# bundle.sh [BUILD]: one folder that runs on any Linux with a C library new enough, without root, from a finished build
# (default: build/release) on Debian.
# Leaves build/package/tidemark-VERSION-x86_64.tar.xz, and the same as .run where makeself is installed.
#
# Libraries are those that the programs and Qt's plugins load, less the GNU C library's own. They lie in three places,
# and bundle/launcher.sh says when each is used:
#   lib/          always ours
#   lib/shared/   those that the host's graphics drivers use, too: the newer of the host's and ours
#   lib/mesa/     OpenGL on the processor, for hosts without any OpenGL driver. Tidemark draws and computes without OpenGL,
#                 so this is for those who ask for OpenGL.
set -euo pipefail
export LC_ALL=C

tidemark_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$tidemark_root/packaging/version.sh"
build=$(cd "${1:-$tidemark_root/build/release}" && pwd)
out=$tidemark_root/build/package
name=tidemark-$tidemark_version-x86_64
root=$out/$name
system=/usr/lib/x86_64-linux-gnu
qt=$system/qt6/plugins

fail() {
  echo "bundle: $*" >&2
  exit 1
}
for tool in patchelf objdump xz dpkg-query strip; do
  command -v "$tool" >/dev/null || fail "$tool is not installed (packaging/dependencies.sh: tidemark_package_packages)"
done
for file in "$build/bin/tidemark" "$build/bin/tidemark-cli" "$qt/platforms/libqwayland-generic.so" \
  "$system/dri/swrast_dri.so" /usr/share/fonts/truetype/droid/DroidSansFallbackFull.ttf; do
  [[ -e $file ]] || fail "$file is not there"
done

rm -rf "$root"
mkdir -p "$root"/{bin,libexec,lib/shared,lib/mesa/dri,lib/mesa/egl_vendor.d,plugins,share}

# Each file of others, and where it came from: sbom.py finds the package by that.
origins=$out/origins.tsv
: >"$origins"
# take FROM TO: FROM's content, under the name TO in the bundle.
take() {
  install -D -m 644 "$(readlink -f "$1")" "$root/$2"
  printf '%s\t%s\n' "$2" "$(readlink -f "$1")" >>"$origins"
}

echo "== Programs and what belongs to them"
staging=$(mktemp -d)
trap 'rm -rf "$staging"' EXIT
DESTDIR=$staging cmake --install "$build" --prefix /usr --strip >/dev/null
for program in tidemark tidemark-cli; do install -m 755 "$staging/usr/bin/$program" "$root/libexec/$program"; done
install -m 755 "$tidemark_root/packaging/bundle/launcher.sh" "$root/bin/tidemark"
ln -s tidemark "$root/bin/tidemark-cli"
cp -r "$staging/usr/share/." "$root/share"
[[ -e $root/share/doc/tidemark/handbook/index.html ]] || echo "!! $build has no handbook (ninja -C $build handbook)"
printf '[Paths]\nPrefix=..\nPlugins=plugins\nTranslations=translations\n' >"$root/libexec/qt.conf"
for file in dicom.dic private.dic; do
  dictionary=$(ls -d /usr/share/libdcmtk*/"$file") || fail "DCMTK's $file is not there"
  take "$dictionary" "share/dcmtk/$file"
done
install -D -m 644 "$tidemark_root/packaging/bundle/fonts.conf" "$root/share/fontconfig/fonts.conf"
for font in dejavu/DejaVuSans{,-Bold,-Oblique,-BoldOblique,Mono,Mono-Bold} droid/DroidSansFallbackFull; do
  take "/usr/share/fonts/truetype/$font.ttf" "share/fonts/${font##*/}.ttf"
done
# Qt's own words, where they are installed (qt6-translations-l10n).
for file in /usr/share/qt6/translations/qtbase_*.qm; do
  if [[ -e $file ]]; then take "$file" "translations/${file##*/}"; fi
done

echo "== Qt's plugins"
plugins=(
  "$qt"/platforms/libq{xcb,offscreen,minimal}.so "$qt"/platforms/libqwayland-*.so
  "$qt"/xcbglintegrations/*.so "$qt"/imageformats/libq{svg,jpeg}.so "$qt"/iconengines/libqsvgicon.so
  "$qt"/platforminputcontexts/*.so "$qt"/wayland-shell-integration/libxdg-shell.so "$qt"/wayland-decoration-client/*.so
  "$qt"/wayland-graphics-integration-client/libqt-plugin-wayland-egl.so
)
for plugin in "${plugins[@]}"; do take "$plugin" "plugins/${plugin#"$qt"/}"; done

echo "== Libraries"
c_library='^(ld-linux-x86-64|libc|libm|libmvec|libdl|libpthread|librt|libresolv|libutil|libanl|libnss_.*|libBrokenLocale|libthread_db)\.so'
# closure FILE...: every library that they load, each by its name and path, less the C library's.
closure() { ldd "$@" | awk '$2 == "=>" { print $1, $3 }' | grep -vE "$c_library" | sort -u; }
programs=("$build/bin/tidemark" "$build/bin/tidemark-cli" "${plugins[@]}")
mesa=("$system/dri/swrast_dri.so" "$system/libEGL_mesa.so.0" "$system/libGLX_mesa.so.0")
dispatch=("$system/libGL.so.1" "$system/libEGL.so.1" "$system/libGLX.so.0" "$system/libOpenGL.so.0" "$system/libGLdispatch.so.0")
if ldd "${programs[@]}" "${mesa[@]}" | grep 'not found'; then fail "libraries are missing here"; fi
closure "${programs[@]}" >"$staging/programs"
{
  closure "${mesa[@]}" "${dispatch[@]}"
  printf '%s\n' "${dispatch[@]}" | sed -E 's|^(.*/)(.*)$|\2 \1\2|'
} | sed -E 's| /usr/lib/| /lib/|' | sort -u >"$staging/drivers"
sed -i -E 's| /usr/lib/| /lib/|' "$staging/programs"
# Fonts are found and drawn by the host's, too, whose rules a newer version may have written.
grep -E '^lib(fontconfig|freetype)\.so' "$staging/programs" >"$staging/fonts"
# ICU's names hold their version, so that it stands beside any other.
sort -u "$staging/drivers" "$staging/fonts" | grep -vE '^libicu' >"$staging/host"

comm -12 "$staging/programs" "$staging/host" >"$staging/shared"
printf '%s\n' "${dispatch[@]}" | sed -E 's|^/usr(.*/)(.*)$|\2 \1\2|' | sort -u - "$staging/shared" >"$staging/shared.all"
comm -23 "$staging/programs" "$staging/shared.all" | while read -r library path; do take "$path" "lib/$library"; done
while read -r library path; do
  take "$path" "lib/shared/$library/$library"
  echo "$library $(basename "$(readlink -f "$path")")" >>"$root/lib/shared/versions"
done <"$staging/shared.all"
comm -13 "$staging/programs" "$staging/drivers" | comm -23 - "$staging/shared.all" |
  while read -r library path; do take "$path" "lib/mesa/$library"; done
take "$system/dri/swrast_dri.so" lib/mesa/dri/swrast_dri.so
for library in libEGL_mesa.so.0 libGLX_mesa.so.0; do take "$system/$library" "lib/mesa/$library"; done
take /usr/share/glvnd/egl_vendor.d/50_mesa.json lib/mesa/egl_vendor.d/50_mesa.json

# shellcheck disable=SC2016  # $ORIGIN is for the loader
{
  # RPATH rather than RUNPATH: a cluster's LD_LIBRARY_PATH does not bring in other versions of what is ours.
  patchelf --force-rpath --set-rpath '$ORIGIN/../lib' "$root"/libexec/tidemark{,-cli}
  patchelf --force-rpath --set-rpath '$ORIGIN' "$root"/lib/*.so*
  patchelf --force-rpath --set-rpath '$ORIGIN/../../lib' "$root"/plugins/*/*.so
  patchelf --force-rpath --set-rpath '$ORIGIN:$ORIGIN/..' "$root"/lib/mesa/*.so*
  patchelf --force-rpath --set-rpath '$ORIGIN/..:$ORIGIN/../..' "$root"/lib/mesa/dri/*.so
}

echo "== Licences"
# Of packages with files here, and of those whose headers are part of the programs.
headers=(libglm-dev libexpected-dev nlohmann-json3-dev libcli11-dev)
boost=$(dpkg-query -W -f '${Depends}' libboost-dev) && headers+=("${boost%% *}")
# dpkg may know a file by its path before /lib became a link. sbom.py finds out if a file is nobody's.
cut -f 2 "$origins" | sed -E 'p; s|^/usr||' | sort -u | { xargs dpkg-query -S 2>/dev/null || :; } |
  sed 's/[:,].*//' | sort -u >"$staging/packages"
printf '%s\n' "${headers[@]}" | sort -u - "$staging/packages" | while read -r package; do
  install -D -m 644 "$(readlink -f "/usr/share/doc/$package/copyright")" "$root/share/doc/licences/$package/copyright"
done
mkdir -p "$root/share/doc/licences/common-licenses"
for licence in /usr/share/common-licenses/*; do
  cp "$(readlink -f "$licence")" "$root/share/doc/licences/common-licenses/${licence##*/}"
done

# The oldest C library that has every symbol that is needed.
glibc=$(find "$root" -type f \( -name '*.so*' -o -path '*/libexec/tidemark*' \) -exec objdump -T {} + 2>/dev/null |
  grep -F '*UND*' | grep -oE 'GLIBC_[0-9.]+' | sort -Vu | tail -n 1)
glibc=${glibc#GLIBC_}
sed -e "s/@VERSION@/$tidemark_version/" -e "s/@GLIBC@/$glibc/" -e "s/@DEBIAN@/$(cat /etc/debian_version)/" \
  "$tidemark_root/packaging/bundle/README" >"$root/README"
python3 "$tidemark_root/packaging/sbom.py" "$root" "$origins" --version "$tidemark_version" --headers "${headers[@]}"

echo "== Packing"
tidemark_archive "$root" "$out/$name.tar.xz"
if command -v makeself >/dev/null; then
  # It unpacks into a folder of its name where it is started, and puts nothing anywhere else. Its head has the command that
  # made it, so the command names no folder.
  (cd "$out" && TZ=UTC makeself --quiet --nomd5 --nocrc --sha256 --xz --threads 2 --complevel 6 --notemp --nowait --nox11 --keep-umask \
    --packaging-date "$(date -u -d "@$SOURCE_DATE_EPOCH")" \
    --tar-extra "--sort=name --mtime=@$SOURCE_DATE_EPOCH --owner=0 --group=0 --numeric-owner" \
    "$name" "$name.run" "Tidemark $tidemark_version") >"$out/makeself.log" 2>&1 || {
    cat "$out/makeself.log"
    fail "makeself failed"
  }
else
  echo "!! makeself is not installed: no .run"
fi
echo "Needs the GNU C library $glibc or newer."
du -sh "$root" | cut -f 1 | sed 's/^/Unpacked: /'
cd "$out" && ls -l "$name".*
