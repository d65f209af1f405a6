#!/bin/sh
# Starts Tidemark from the folder that this file is in, wherever that is. Its name says which program: tidemark, or
# tidemark-cli.
#   tidemark --install-menu   menu entry, icon and types of files for this user, in ~/.local/share
#   tidemark --uninstall      takes them away again; the folder itself is then yours to delete
# Any other arguments are the program's own.
set -eu

root=$(dirname "$(dirname "$(readlink -f "$0")")")
case ${0##*/} in
  tidemark-cli) program=tidemark-cli ;;
  *) program=tidemark ;;
esac

data=${XDG_DATA_HOME:-${HOME:-}/.local/share}

# What is in the menu, below share/ here and below $data there.
menu_files() {
  (cd "$root/share" && find icons/hicolor -type f -name 'tidemark.*')
  echo applications/tidemark.desktop
  echo mime/packages/tidemark.xml
}

tell_desktop() {
  if command -v update-mime-database >/dev/null; then update-mime-database "$data/mime" || :; fi
  if command -v update-desktop-database >/dev/null; then update-desktop-database "$data/applications" || :; fi
  if command -v gtk-update-icon-cache >/dev/null && [ -f "$data/icons/hicolor/index.theme" ]; then
    gtk-update-icon-cache -q "$data/icons/hicolor" || :
  fi
}

install_menu() {
  menu_files | while read -r file; do
    mkdir -p "$(dirname "$data/$file")"
    cp "$root/share/$file" "$data/$file"
  done
  # The desktop entry's own quoting: in quotation marks, and these four with a backslash. Then each backslash is doubled.
  quoted=$(printf '%s' "$root/bin/tidemark" | sed -e 's/[\\"`$]/\\&/g' -e 's/\\/\\\\/g' -e 's/%/%%/g')
  EXEC="Exec=\"$quoted\" %U" awk '/^Exec=/ { print ENVIRON["EXEC"]; next } { print }' \
    "$root/share/applications/tidemark.desktop" >"$data/applications/tidemark.desktop"
  tell_desktop
  echo "Tidemark is in the menu of this user. '$0 --uninstall' takes it out again."
}

uninstall() {
  menu_files | while read -r file; do rm -f "$data/$file"; done
  tell_desktop
  echo "Tidemark is out of the menu of this user. Delete $root to remove the rest."
}

if [ "$program" = tidemark ]; then
  case ${1:-} in
    --install-menu) install_menu; exit ;;
    --uninstall) uninstall; exit ;;
  esac
fi

# Libraries that the host's graphics drivers use, too, are the host's where it has them in this version or a newer one: a
# driver does not start on older ones. Each of the others has a folder of its own in lib/shared, which is searched first.
known=$(for tool in /sbin/ldconfig /usr/sbin/ldconfig; do
  if [ -x "$tool" ]; then "$tool" -p; break; fi
done | grep x86-64 || :)
hosts=$(printf '%s\n' "$known" | awk 'NR == FNR { wanted[$1]; next } $1 in wanted && !seen[$1]++ { print $1, $NF }' \
  "$root/lib/shared/versions" -)
# The names that links lead to hold the versions. All at once, as a program a library would take long.
real=$(printf '%s\n' "$hosts" | awk '{ print $2 }' | xargs readlink -f 2>/dev/null || :)
own=$(printf '%s\n\n%s\n\n%s\n' "$(cat "$root/lib/shared/versions")" "$hosts" "$real" | awk '
  function older(a, b,   x, y, n, i) {
    sub(/^.*\.so\./, "", a); sub(/^.*\.so\./, "", b)
    n = split(b, y, "."); split(a, x, ".")
    for (i = 1; i <= n; i++) if (x[i] + 0 != y[i] + 0) return x[i] + 0 < y[i] + 0
    return 0
  }
  NF == 0 { part++; next }
  part == 0 { order[++count] = $1; version[$1] = $2; next }
  part == 1 { host[++hosts] = $1; next }
  { sub(/^.*\//, ""); file[++files] = $0 }
  END {
    # A name without a version says nothing; the host is believed.
    if (files == hosts)
      for (i = 1; i <= hosts; i++)
        has[host[i]] = file[i] !~ /\.so\./ || file[i] == host[i] || !older(file[i], version[host[i]])
    for (i = 1; i <= count; i++) if (!has[order[i]]) print order[i]
  }')
folders=
for name in $own; do folders=$folders$root/lib/shared/$name:; done

# A host without any OpenGL driver gets Mesa's software driver. Tidemark draws and computes without OpenGL; this is for
# those who ask for it (--renderer gl, --executor compute or stream).
case $known in
  *libEGL_*.so.0* | *libGLX_*.so.0*) ;;
  *)
    folders=$folders$root/lib/mesa:
    export LIBGL_DRIVERS_PATH="$root/lib/mesa/dri"
    export __EGL_VENDOR_LIBRARY_DIRS="$root/lib/mesa/egl_vendor.d"
    export __GLX_VENDOR_LIBRARY_NAME=mesa
    ;;
esac
if [ -n "$folders" ]; then export LD_LIBRARY_PATH="${folders%:}${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}"; fi

# OpenSSL and libcurl come from Debian and look for the host's authorities where Debian keeps them. Fedora and its kin,
# openSUSE and Arch keep them elsewhere.
for file in /etc/ssl/certs/ca-certificates.crt /etc/pki/tls/certs/ca-bundle.crt \
  /etc/pki/ca-trust/extracted/pem/tls-ca-bundle.pem /etc/ssl/ca-bundle.pem /etc/ssl/cert.pem; do
  if [ -z "${SSL_CERT_FILE:-}" ] && [ -r "$file" ]; then export SSL_CERT_FILE="$file"; fi
done

# The host's fonts, and ours after them.
export FONTCONFIG_FILE="${FONTCONFIG_FILE:-$root/share/fontconfig/fonts.conf}"
# DCMTK reads the names and types of DICOM's attributes from here.
export DCMDICTPATH="${DCMDICTPATH:-$root/share/dcmtk/dicom.dic:$root/share/dcmtk/private.dic}"

exec "$root/libexec/$program" "$@"
