#!/usr/bin/env bash
# launcher_test.sh SOURCE: what starts the programs of the bundle (packaging/bundle/launcher.sh) chooses libraries by version,
# finds the host's authorities, passes arguments on, and puts the menu's files in place and away, in a bundle whose programs
# only say how they were started.
set -euo pipefail
source=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
root="$work/a \"folder\" of 100 %"
mkdir -p "$root"/{bin,libexec,lib/shared,share/applications,share/mime/packages,share/icons/hicolor/16x16/apps}
cp "$source/packaging/bundle/launcher.sh" "$root/bin/tidemark"
ln -s tidemark "$root/bin/tidemark-cli"
for program in tidemark tidemark-cli; do
  # shellcheck disable=SC2016  # for the program
  printf '#!/bin/sh\necho "%s [$1] [$2] ${LD_LIBRARY_PATH:-} ${SSL_CERT_FILE:-}"\n' "$program" >"$root/libexec/$program"
  chmod +x "$root/libexec/$program"
done
cp "$source/packaging/files/tidemark.desktop" "$root/share/applications"
cp "$source/packaging/files/tidemark.mime.xml" "$root/share/mime/packages/tidemark.xml"
touch "$root/share/icons/hicolor/16x16/apps/tidemark.png"
unset LD_LIBRARY_PATH SSL_CERT_FILE

fail() {
  echo "$*"
  exit 1
}
# started VERSIONS NAME ARGUMENT...: what the program says when lib/shared has libraries of these versions.
started() {
  printf '%b' "$1" >"$root/lib/shared/versions"
  "$root/bin/$2" "${@:3}"
}
host=$(basename "$(readlink -f "$(/sbin/ldconfig -p | awk '$1 == "libstdc++.so.6" && /x86-64/ { print $NF; exit }')")")
[[ $host == libstdc++.so.6.* ]] || fail "no libstdc++ of this system found"

said=$(started "libstdc++.so.6 $host\n" tidemark-cli "two words" 'a*')
[[ $said == 'tidemark-cli [two words] [a*] '* ]] || fail "wrongly started: $said"
[[ $said != *libstdc++* ]] || fail "the host's libstdc++ is as new, but was not taken: $said"
said=$(started "libstdc++.so.6 libstdc++.so.6.0.1\n" tidemark a b)
[[ $said == 'tidemark [a] [b] '* && $said != *libstdc++* ]] || fail "the host's libstdc++ is newer, but was not taken: $said"
said=$(started "libstdc++.so.6 libstdc++.so.6.0.999\nlibnowhere.so.1 libnowhere.so.1.0\n" tidemark a b)
[[ $said == *"$root/lib/shared/libstdc++.so.6:$root/lib/shared/libnowhere.so.1"* ]] || fail "older or missing, but not ours: $said"
ln -s "$root/bin/tidemark-cli" "$work/tidemark-cli"
[[ $("$work/tidemark-cli" a b) == 'tidemark-cli [a] [b]'* ]] || fail "a link elsewhere starts something else"

# Authorities of a host that has them where the first argument says.
authorities() {
  rm -rf "$work/etc"
  mkdir -p "$work/etc/$(dirname "$1")"
  touch "$work/etc/$1"
  sed "s|/etc/|$work/etc/|g" "$source/packaging/bundle/launcher.sh" >"$root/bin/tidemark"
  "$root/bin/tidemark" a b
}
for file in ssl/certs/ca-certificates.crt pki/tls/certs/ca-bundle.crt ssl/ca-bundle.pem; do
  said=$(authorities "$file")
  [[ $said == *" $work/etc/$file" ]] || fail "the host's authorities in /etc/$file are not named: $said"
done
said=$(SSL_CERT_FILE=/own.pem authorities ssl/certs/ca-certificates.crt)
[[ $said == *' /own.pem' ]] || fail "the user's authorities are not named: $said"

export XDG_DATA_HOME=$work/data
"$root/bin/tidemark" --install-menu >/dev/null
grep -qxF "Exec=\"$work/a \\\\\"folder\\\\\" of 100 %%/bin/tidemark\" %U" "$XDG_DATA_HOME/applications/tidemark.desktop" ||
  fail "the menu starts $(grep ^Exec "$XDG_DATA_HOME/applications/tidemark.desktop")"
[[ -e $XDG_DATA_HOME/icons/hicolor/16x16/apps/tidemark.png ]] || fail "no icon"
"$root/bin/tidemark" --uninstall >/dev/null
if find "$XDG_DATA_HOME" -name 'tidemark*' | grep .; then fail "--uninstall leaves files"; fi
