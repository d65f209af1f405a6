#!/usr/bin/env bash
# oci.sh [DEB]: an OCI image of tidemark-cli, for clusters and pipelines: Debian 12's smallest system with the Debian package
# (default: the one that deb.sh left) and what it depends on. Leaves build/package/tidemark-cli-VERSION-oci.tar, which
# `podman load`, `docker load` and `skopeo copy oci-archive:` take. It needs no network when it runs.
# Needs root, mmdebstrap and umoci. Tries the image's own root by chroot; no container engine is asked.
set -euo pipefail

tidemark_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$tidemark_root/packaging/version.sh"
source "$tidemark_root/packaging/chroot.sh"
source "$tidemark_root/packaging/phantom.sh"
out=$tidemark_root/build/package
image=$out/tidemark-cli-$tidemark_version-oci.tar

fail() {
  echo "oci: $*" >&2
  exit 1
}
((EUID == 0)) || fail "a system in a folder needs root"
for tool in mmdebstrap umoci cmake; do command -v "$tool" >/dev/null || fail "there is no $tool here"; done
deb=$(realpath -e "${1:-$out/deb/tidemark-cli_${tidemark_version}_amd64.deb}") || fail "there is no Debian package; deb.sh makes it"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
echo "== The system"
# The hook lets apt see files of this system by their own paths.
mmdebstrap --variant=essential --mode=root --hook-dir=/usr/share/mmdebstrap/hooks/file-mirror-automount \
  --include="ca-certificates,$deb" --dpkgopt='path-exclude=/usr/share/doc/*' \
  --dpkgopt='path-include=/usr/share/doc/*/copyright' --dpkgopt='path-exclude=/usr/share/man/*' \
  --dpkgopt='path-exclude=/usr/share/locale/*' \
  bookworm "$work/root.tar" "deb http://deb.debian.org/debian bookworm main" \
  "deb http://deb.debian.org/debian-security bookworm-security main" >"$out/oci.log" 2>&1 </dev/null || {
  tail -n 20 "$out/oci.log"
  fail "the system could not be made"
}

echo "== The image"
when=$(date -u -d "@$SOURCE_DATE_EPOCH" +%Y-%m-%dT%H:%M:%SZ)
layout=$work/layout
umoci init --layout "$layout"
umoci new --image "$layout:$tidemark_version"
umoci unpack --image "$layout:$tidemark_version" "$work/bundle"
tar -C "$work/bundle/rootfs" --exclude='./dev/*' -xf "$work/root.tar"
umoci repack --image "$layout:$tidemark_version" --history.created "$when" --history.created_by "packaging/oci.sh" "$work/bundle"
umoci config --image "$layout:$tidemark_version" --created "$when" --architecture amd64 --os linux \
  --config.entrypoint /usr/bin/tidemark-cli --config.cmd --help --config.workingdir /work --config.user 1000:1000 \
  --config.env PATH=/usr/bin:/bin --config.env LANG=C.UTF-8 --config.env HOME=/tmp \
  --config.label "org.opencontainers.image.title=tidemark-cli" \
  --config.label "org.opencontainers.image.version=$tidemark_version" \
  --config.label "org.opencontainers.image.licenses=Apache-2.0" \
  --history.created "$when" --history.created_by "packaging/oci.sh"
umoci gc --layout "$layout"

echo "== Trying it"
rm -rf "$work/bundle"
umoci unpack --image "$layout:$tidemark_version" "$work/try"
system=$work/try/rootfs
mkdir -p "$system/work" && chmod 1777 "$system/work"
inside() {
  tidemark_inside --offline "$system" setpriv --reuid 1000 --regid 1000 --clear-groups env HOME=/tmp tidemark-cli "$@"
}
tidemark_try_phantom "$system/work" /work inside || fail "not the phantom's figures"
echo "Tried in the image's root by chroot, as user 1000, without a network."

# The name that engines give it.
sed -i "s|\"org.opencontainers.image.ref.name\":\"$tidemark_version\"|\"org.opencontainers.image.ref.name\":\"tidemark-cli:$tidemark_version\"|" \
  "$layout/index.json"
grep -q "tidemark-cli:$tidemark_version" "$layout/index.json" || fail "the image has no name"
tar -C "$layout" --sort=name --mtime="@$SOURCE_DATE_EPOCH" --owner=0 --group=0 --numeric-owner --format=gnu \
  -cf "$image" oci-layout index.json blobs
if command -v skopeo >/dev/null; then skopeo inspect "oci-archive:$image" | grep -E '"(Architecture|Os|Created)"'; fi
ls -l "$image"
