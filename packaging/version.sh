# What every package of one version has in common. Sourced; the caller has set tidemark_root.

# The project's version, from where CMake has it.
tidemark_version=$(sed -nE 's/^project\(tidemark VERSION ([0-9.]+).*/\1/p' "$tidemark_root/CMakeLists.txt")

# The same sources give the same bits: every date in a package is that of the last commit. Without git, or in an unpacked
# archive, it is that of the changelog.
if [[ -z ${SOURCE_DATE_EPOCH:-} ]]; then
  SOURCE_DATE_EPOCH=$(git -C "$tidemark_root" log -1 --format=%ct 2>/dev/null ||
    stat -c %Y "$tidemark_root/CHANGELOG.md")
fi
export SOURCE_DATE_EPOCH

# tidemark_archive FOLDER OUT.tar.xz: FOLDER with its own name on top, the same bits for the same content.
tidemark_archive() {
  tar -C "$(dirname "$1")" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner \
    --mode=u+rw,go+rX,go-w --format=gnu -cf - "$(basename "$1")" | xz -6 -T2 >"$2"
}
