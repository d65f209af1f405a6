# Clean systems in folders, for what tries packages. Sourced; the caller has set tidemark_root. Needs root and mmdebstrap.
# What a suite holds at first, nothing but Debian's "minbase", is kept in build/chroots.

# tidemark_suite SUITE: makes build/chroots/SUITE.tar where it is not there. Fails where the suite cannot be had.
tidemark_suite() {
  local suite=$1 kept=$tidemark_root/build/chroots
  local -a sources=("deb http://deb.debian.org/debian $suite main")
  if [[ $suite == noble ]]; then
    local keys=/usr/share/keyrings/ubuntu-archive-keyring.gpg
    # Debian 12 has no package with Ubuntu's keys. The folder is thrown away, and nothing of it gets into a package.
    if [[ -e $keys ]]; then keys=signed-by=$keys; else keys=trusted=yes; fi
    sources=("deb [$keys] http://archive.ubuntu.com/ubuntu $suite main universe")
  fi
  if [[ -s $kept/$suite.tar ]]; then return 0; fi
  mkdir -p "$kept"
  mmdebstrap --variant=minbase --mode=root --include=apt "$suite" "$kept/$suite.part.tar" "${sources[@]}" >"$kept/$suite.log" 2>&1 </dev/null || {
    rm -f "$kept/$suite.part.tar"
    return 1
  }
  mv "$kept/$suite.part.tar" "$kept/$suite.tar"
}

# tidemark_chroot SUITE FOLDER: a new system in FOLDER, with this system's way to the mirrors.
tidemark_chroot() {
  mkdir -p "$2"
  tar -C "$2" --exclude='./dev/*' -xf "$tidemark_root/build/chroots/$1.tar"
  rm -f "$2/etc/resolv.conf"
  cp /etc/resolv.conf "$2/etc/resolv.conf"
  printf 'APT::Install-Recommends "false";\nAcquire::Languages "none";\nAcquire::Check-Valid-Until "false";\n' \
    >"$2/etc/apt/apt.conf.d/90tidemark"
}

# tidemark_inside [--offline] FOLDER COMMAND...: the command in that system, as its root, with processes and mounts of its own, which
# end with it; with --offline without a network.
tidemark_inside() {
  local -a apart=(--mount --pid --ipc)
  if [[ $1 == --offline ]]; then
    apart+=(--net)
    shift
  fi
  # The root of a system that was itself entered by chroot is no mount, and its parent mount cannot be made private.
  if ! mountpoint -q /; then apart+=(--propagation unchanged); fi
  local folder=$1
  shift
  # shellcheck disable=SC2016  # for the inner shell
  unshare "${apart[@]}" --fork --kill-child -- sh -c '
    mount -t proc proc "$0/proc" && mount --rbind /dev "$0/dev" && mount --make-rslave "$0/dev" || exit
    chroot "$0" "$@"
    code=$?
    umount -R -l "$0/dev" "$0/proc"
    exit "$code"' "$folder" \
    env -i HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    PATH=/usr/sbin:/usr/bin:/sbin:/bin SOURCE_DATE_EPOCH="${SOURCE_DATE_EPOCH:-}" "$@"
}
