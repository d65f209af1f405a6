#!/usr/bin/env bash
# glx_fallback_test.sh TIDEMARK NO_GLX_VISUALS: on a display whose GLX has no visuals the desktop starts all the same, with its
# arguments; a choice that somebody has made for Qt is left alone, and --no-opengl asks for none.
set -euo pipefail
program=$1
preload=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export XDG_RUNTIME_DIR=$work QT_QPA_PLATFORM=xcb
unset QT_XCB_GL_INTEGRATION

fail() {
  echo "$*"
  exit 1
}
# started [VARIABLE=VALUE...] PROGRAM ARGUMENT...
started() { xvfb-run -a -s "-screen 0 800x600x24 -nolisten tcp" env LD_PRELOAD="$preload" "$@" --diagnostics 2>&1; }

said=$(started "$program") || fail "it ended: $said"
[[ $said == *"GLX has no visuals"* ]] || fail "GLX was there: $said"
[[ $said == *"automatic executor:"* ]] || fail "it was not asked for diagnostics: $said"
if said=$(started QT_XCB_GL_INTEGRATION=xcb_glx "$program"); then fail "Qt was to use GLX, and did not: $said"; fi
said=$(started "$program" --no-opengl) || fail "it wanted OpenGL all the same: $said"
[[ $said != *GLX* ]] || fail "it asked for GLX: $said"
