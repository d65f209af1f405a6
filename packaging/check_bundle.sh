#!/usr/bin/env bash
# check_bundle.sh [ARCHIVE.tar.xz]: unpacks the bundle (default: what bundle.sh left) in new systems with nothing in them,
# Debian 12 and 13 and Ubuntu 24.04, and tries it there as a user who is not root, without a network: both programs
# without any X library and without OpenGL, then the desktop on an X server that nobody sees, where it segments a tumour.
# Leaves pictures of it in build/package/check. Needs root and mmdebstrap; a system that cannot be had is said.
#   TIDEMARK_SUITES="bookworm"   other systems than all three
#   TIDEMARK_START_MS=2000       the longest that the processor may need until the window appears; the clock's time is said,
#                                but other work on the machine is not the bundle's fault
set -euo pipefail

tidemark_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$tidemark_root/packaging/version.sh"
source "$tidemark_root/packaging/chroot.sh"
source "$tidemark_root/packaging/phantom.sh"
name=tidemark-$tidemark_version-x86_64
archive=${1:-$tidemark_root/build/package/$name.tar.xz}
pictures=$tidemark_root/build/package/check
longest_ms=${TIDEMARK_START_MS:-2000}

fail() {
  echo "check_bundle: $*" >&2
  exit 1
}
skip() {
  echo "!! SKIPPED: the bundle was not tried: $*"
  exit 0
}
((EUID == 0)) || skip "systems in folders need root"
for tool in mmdebstrap unshare cmake; do command -v "$tool" >/dev/null || skip "there is no $tool here"; done
[[ -s $archive ]] || fail "$archive is not there; bundle.sh makes it"
size=$(stat -c %s "$archive")
((size <= 150000000)) || fail "the archive has $size bytes, more than 150 MB"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$pictures"

if [[ -s ${archive%.tar.xz}.run ]]; then
  echo "== The .run holds the same"
  mkdir "$work/run" "$work/tar"
  (cd "$work/run" && sh "${archive%.tar.xz}.run" --quiet >/dev/null)
  tar -C "$work/tar" -xf "$archive"
  diff -r --no-dereference "$work/run" "$work/tar" || fail "the .run and the archive differ"
  rm -rf "$work/run" "$work/tar"
fi

# as_user COMMAND...: in $system, without a network.
as_user() {
  tidemark_inside --offline "$system" setpriv --reuid 1000 --regid 1000 --clear-groups env HOME=/home/user XDG_RUNTIME_DIR=/home/user "$@"
}

try_without_x() {
  if find "$system/usr" -name 'libX11.so*' -o -name 'libGL.so*' -o -name 'libEGL.so*' | grep .; then fail "$suite has X or OpenGL"; fi
  echo "-- no X library, no OpenGL: tidemark-cli"
  tidemark_try_phantom "$home" /home/user as_user "$bin/tidemark-cli" || fail "not the phantom's figures"
  for renderer in host gl; do
    as_user "$bin/tidemark-cli" render /home/user/tumour/series --mask /home/user/mask.nii.gz --fit --renderer "$renderer" \
      --out "/home/user/$renderer.png" >/dev/null
    cp "$home/$renderer.png" "$pictures/$suite-$renderer.png"
  done
  echo "-- DCMTK's dictionary is found"
  as_user "$bin/tidemark-cli" info /home/user/tumour/series 2>&1 | grep -i dictionary && fail "no dictionary"
  echo "-- tidemark --diagnostics"
  as_user env QT_QPA_PLATFORM=offscreen "$bin/tidemark" --diagnostics | grep -E '^(tidemark|qt|renderer|opengl renderer|system):'
  echo "-- tidemark --install-menu, --uninstall"
  as_user "$bin/tidemark" --install-menu >/dev/null
  local entry=$home/.local/share/applications/tidemark.desktop
  grep -qxF "Exec=\"$bin/tidemark\" %U" "$entry" || fail "the menu entry starts something else: $(grep ^Exec= "$entry")"
  if command -v desktop-file-validate >/dev/null; then desktop-file-validate "$entry"; fi
  as_user "$bin/tidemark" --uninstall >/dev/null
  if find "$home/.local" -name 'tidemark*' | grep .; then fail "--uninstall leaves files"; fi
}

# Starts the desktop three times on an X server, and says what passes until its window is there. In the third a click places
# a surface in the tumour, and another one plays it; its screen is left.
cat >"$work/desktop.sh" <<'INNER'
cd /home/user
mkdir -p screen
# It would begin anew, and refuse clients meanwhile, when its last client has gone.
Xvfb :97 -noreset -screen 0 1600x1000x24 -nolisten tcp -fbdir /home/user/screen >xvfb.log 2>&1 &
export DISPLAY=:97
until xwininfo -root >/dev/null 2>&1; do sleep 0.1; done
: >times
for run in 1 2 3; do
  before=$(date +%s%N)
  "$1" --phantom tumour >desktop.log 2>&1 &
  tidemark=$!
  for wait in $(seq 600); do
    xwininfo -root -tree 2>/dev/null | grep -qE '"[^"]*Tidemark[^"]*".* [0-9]{3,}x[0-9]{3,}\+' && break
    kill -0 $tidemark || exit 1
    sleep 0.05
  done
  clock=$((($(date +%s%N) - before) / 1000000))
  # utime and stime, in hundredths of a second.
  processor=$(($(sed 's/.*) //' "/proc/$tidemark/stat" | awk '{ print $12 + $13 }') * 10))
  echo "$processor $clock" >>times
  if [ $run = 3 ]; then
    tr '\0' '\n' <"/proc/$tidemark/environ" | grep -E '^LD_LIBRARY_PATH' >path || :
    sleep 5
    xdotool mousemove 290 271 click 1  # the tumour in the axial slice
    sleep 2
    xdotool mousemove 244 38 click 1  # Play
    sleep 15
    cp screen/Xvfb_screen0 screen.xwd
  fi
  kill $tidemark
  wait $tidemark 2>/dev/null || :
done
"$1" --diagnostics
INNER

try_desktop() {
  echo "-- the desktop, under Xvfb"
  tidemark_inside "$system" sh -ec 'apt-get update -q && apt-get install -y -q xvfb x11-utils xdotool xkb-data' >"$work/apt.log" 2>&1 || {
    tail "$work/apt.log"
    echo "!! SKIPPED: $suite's X server could not be installed"
    return 0
  }
  cp "$work/desktop.sh" "$home/desktop.sh"
  mkdir -p "$system/tmp/.X11-unix"
  chmod 1777 "$system/tmp/.X11-unix"
  as_user sh /home/user/desktop.sh "$bin/tidemark" >"$work/diagnostics" || {
    cat "$home/desktop.log" "$home/xvfb.log"
    fail "the desktop does not start on $suite"
  }
  grep -E '^(qt platform|renderer|opengl renderer|opengl version|system):' "$work/diagnostics"
  echo "Said while it ran: $(cat "$home/desktop.log")"
  echo "Ours, as the system lacks them or has older ones: $(tr ':' '\n' <"$home/path" | sed 's|.*/||' | tr '\n' ' ')"
  echo "Until the window is there, in ms of the processor and of the clock: $(paste -sd ';' "$home/times")"
  local best
  best=$(sort -n "$home/times" | head -n 1 | cut -d ' ' -f 1)
  ((best <= longest_ms)) || fail "the desktop takes $best ms to start"
  if command -v convert >/dev/null; then
    convert "xwd:$home/screen.xwd" "$pictures/$suite-desktop.png"
    local colours
    colours=$(convert "$pictures/$suite-desktop.png" -format %k info:)
    ((colours > 500)) || fail "the screen is nearly empty: $colours colours"
    # The surface is the only thing in the 3D view that has more red than blue.
    local share
    share=$(convert "$pictures/$suite-desktop.png" -crop 415x640+500+115 -fx 'r>b+0.15' -format '%[fx:round(100*mean)]' info:)
    ((share >= 5)) || fail "no tumour is in the 3D view: $pictures/$suite-desktop.png"
    echo "The screen, with $colours colours and $share % of the 3D view on the tumour: $pictures/$suite-desktop.png"
  else
    echo "!! ImageMagick is not installed: the screen was not looked at"
  fi
}

for suite in ${TIDEMARK_SUITES:-bookworm trixie noble}; do
  echo "== $suite"
  tidemark_suite "$suite" || {
    echo "!! SKIPPED: $suite cannot be had (build/chroots/$suite.log)"
    continue
  }
  system=$work/$suite
  tidemark_chroot "$suite" "$system"
  home=$system/home/user
  # A blank in the path: programs are put into folders of all names.
  bin="/home/user/my programs/$name/bin"
  mkdir -p "$home/my programs"
  tar -C "$home/my programs" -xf "$archive"
  chown -R 1000:1000 "$home"
  chmod 700 "$home"
  try_without_x
  try_desktop
  rm -rf "$system"
done
echo "== The bundle works"
