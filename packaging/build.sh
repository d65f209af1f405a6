# Configuring and building, for run and test. Sourced; the caller has set tidemark_root.

# Compilers that read ITK or OpenVDB take up to 2 GB each, so memory limits how many run at once.
tidemark_jobs() {
  local processors available_kb by_memory
  processors=$(nproc 2>/dev/null || getconf _NPROCESSORS_ONLN)
  available_kb=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo 2>/dev/null || true)
  by_memory=$(( ${available_kb:-4000000} / 2000000 ))
  ((by_memory >= 1)) || by_memory=1
  echo $((processors < by_memory ? processors : by_memory))
}

# Where ccache knows nothing yet it asks the compiler, not the preprocessor, which headers were read.
export CCACHE_DEPEND=1

# tidemark_configure PRESET: build/PRESET, at first and after changes of the build's files, and again where packages were
# installed since: they may hold what was not found.
tidemark_configure() {
  local preset=$1 made=$tidemark_root/build/$1/build.ninja
  if [[ ! -f $made || /var/lib/dpkg/status -nt $made ]]; then
    echo "== Configuring $preset"
    (cd "$tidemark_root" && cmake --preset "$preset")
  else
    ninja -C "$tidemark_root/build/$preset" build.ninja >/dev/null
  fi
}

# tidemark_build PRESET [TARGET...]: all targets when none is named.
tidemark_build() {
  local preset=$1
  shift
  tidemark_configure "$preset"
  echo "== Building $preset"
  local -a targets=()
  if (($# > 0)); then targets=(--target "$@"); fi
  NINJA_STATUS='[%f/%t, %es] ' cmake --build "$tidemark_root/build/$preset" -j "$(tidemark_jobs)" "${targets[@]}"
}

# tidemark_has_target PRESET TARGET: whether what was built last has a target of that name.
tidemark_has_target() {
  ninja -C "$tidemark_root/build/$1" -t query "$2" >/dev/null 2>&1
}
