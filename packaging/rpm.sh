#!/usr/bin/env bash
# rpm.sh: an RPM of the bundle's folder (bundle.sh makes it first) in /opt/tidemark, with the programs in /usr/bin and an entry
# in the menu. It depends on nothing but the C library. Leaves build/package/tidemark-VERSION-1.x86_64.rpm.
# Tries it in an empty folder: what is listed is there, and tidemark-cli segments a phantom from there.
set -euo pipefail

tidemark_root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
source "$tidemark_root/packaging/version.sh"
source "$tidemark_root/packaging/phantom.sh"
out=$tidemark_root/build/package
bundle=$out/tidemark-$tidemark_version-x86_64

fail() {
  echo "rpm: $*" >&2
  exit 1
}
command -v rpmbuild >/dev/null || fail "rpmbuild is not installed (Debian's package rpm)"
[[ -d $bundle ]] || fail "$bundle is not there; bundle.sh makes it"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
glibc=$(sed -nE 's/.*GNU C library, ([0-9.]+).*/\1/p' "$bundle/README")
[[ -n $glibc ]] || fail "the bundle does not say which C library it needs"

cat >"$work/tidemark.spec" <<SPEC
Name: tidemark
Version: $tidemark_version
Release: 1
Summary: Segments medical volumes by steering a level-set surface
License: Apache-2.0 AND LicenseRef-share-doc-licences
Group: Applications/Engineering
AutoReqProv: no
Requires: glibc >= $glibc

# The bundle is complete, and its files stay as they are.
%global __os_install_post %{nil}
%global debug_package %{nil}
%global _build_id_links none
%global source_date_epoch_from_changelog 0
%global use_source_date_epoch_as_buildtime 1
%global clamp_mtime_to_source_date_epoch 1
%global _buildhost localhost
%global _binary_payload w6T2.xzdio

%description
Tidemark segments CT and MR volumes with a level set: a surface that grows from a seed while the brightness around it
attracts it and its own curvature smooths it. The desktop and tidemark-cli, with the libraries that they need.
Research use only. Not for diagnostic use.

%install
mkdir -p %{buildroot}/opt/tidemark %{buildroot}/usr/bin %{buildroot}/usr/share
cp -a $bundle/. %{buildroot}/opt/tidemark
ln -s /opt/tidemark/bin/tidemark %{buildroot}/usr/bin/tidemark
ln -s /opt/tidemark/bin/tidemark-cli %{buildroot}/usr/bin/tidemark-cli
cp -a $bundle/share/applications $bundle/share/icons $bundle/share/mime $bundle/share/metainfo $bundle/share/man %{buildroot}/usr/share
find %{buildroot} -exec touch -h -d @$SOURCE_DATE_EPOCH {} +

%files
%defattr(-,root,root,-)
/opt/tidemark
/usr/bin/tidemark
/usr/bin/tidemark-cli
/usr/share/applications/tidemark.desktop
/usr/share/icons/hicolor/*/apps/tidemark.*
/usr/share/mime/packages/tidemark.xml
/usr/share/metainfo/org.tidemark.Tidemark.metainfo.xml
/usr/share/man/man1/tidemark*.1*
SPEC
rpmbuild -bb --quiet --target x86_64 --define "_topdir $work/rpm" --define "_rpmdir $out" \
  --define '_rpmfilename %{NAME}-%{VERSION}-%{RELEASE}.%{ARCH}.rpm' "$work/tidemark.spec" >"$out/rpm.log" 2>&1 || {
  tail -n 20 "$out/rpm.log"
  fail "rpmbuild failed"
}
rpm=$out/tidemark-$tidemark_version-1.x86_64.rpm

echo "== Trying it in an empty folder"
# Without the C library's package there, which belongs to a system.
if ((EUID == 0)); then
  rpm --root "$work/system" --initdb
  rpm --root "$work/system" --install --nodeps --nosignature "$rpm"
  "$work/system/opt/tidemark/bin/tidemark-cli" --version
  mkdir "$work/try"
  tidemark_try_phantom "$work/try" "$work/try" "$work/system/opt/tidemark/bin/tidemark-cli" || fail "not the phantom's figures"
  [[ $(readlink "$work/system/usr/bin/tidemark") == /opt/tidemark/bin/tidemark ]] || fail "no link in /usr/bin"
  rpm --root "$work/system" --erase --nodeps tidemark
  if [[ -e $work/system/opt/tidemark || -e $work/system/usr/bin/tidemark ]]; then fail "removing it leaves files"; fi
else
  echo "!! SKIPPED: installing needs root"
fi
ls -l "$rpm"
