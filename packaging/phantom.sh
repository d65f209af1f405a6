# The phantom tumour, by which packages are tried. Sourced; the caller has set tidemark_root.

# tidemark_phantom_options PHANTOM.json: the options of `tidemark-cli segment` that it comes with.
tidemark_phantom_options() { cmake -DJSON="$1" -P "$tidemark_root/packaging/phantom_options.cmake"; }

# tidemark_phantom_result STATISTICS.json: prints the figures; fails when they are not those of the tumour.
tidemark_phantom_result() {
  local dice volume
  dice=$(sed -nE 's/.*"dice": *([-0-9.e+]+).*/\1/p' "$1" | head -n 1)
  volume=$(sed -nE 's/.*"volume_ml": *([-0-9.e+]+).*/\1/p' "$1" | head -n 1)
  echo "Volume $volume ml (117.6 are right), Dice $dice"
  awk -v dice="$dice" -v volume="$volume" 'BEGIN { exit !(dice >= 0.98 && volume > 112 && volume < 119) }'
}

# tidemark_try_phantom OUTSIDE INSIDE COMMAND...: segments the phantom by COMMAND, a tidemark-cli that sees the folder OUTSIDE
# as INSIDE, and leaves all of it there; fails as tidemark_phantom_result does.
tidemark_try_phantom() {
  local outside=$1 inside=$2
  local -a options
  shift 2
  "$@" phantom tumour --out "$inside/tumour" >/dev/null || return
  read -r -a options < <(tidemark_phantom_options "$outside/tumour/phantom.json")
  "$@" segment "$inside/tumour/series" "${options[@]}" --truth "$inside/tumour/truth.nii.gz" --out "$inside/mask.nii.gz" \
    --out "$inside/surface.stl" --stats "$inside/statistics.json" >/dev/null || return
  [[ -s $outside/mask.nii.gz && -s $outside/surface.stl ]] || return
  tidemark_phantom_result "$outside/statistics.json"
}
