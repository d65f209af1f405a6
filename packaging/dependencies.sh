# What a machine needs to build, run and test Tidemark, and how it is installed. Sourced by run and test.
# What each package is for: docs/5-dependencies.md.

# These names are the same on Debian 12, Debian 13 and Ubuntu 24.04.
tidemark_packages=(
  g++ cmake ninja-build ccache pkg-config
  qt6-base-dev qt6-svg-dev fonts-dejavu-core libgl-dev libepoxy-dev libegl-dev libegl1 libgl1 libgl1-mesa-dri
  libglm-dev libfmt-dev libspdlog-dev libexpected-dev nlohmann-json3-dev libcli11-dev libhwy-dev
  libzip-dev libssl-dev libcurl4-openssl-dev libdcmtk-dev libnsl-dev libopenjp2-7-dev
  libinsighttoolkit5-dev libgdcm-dev zlib1g-dev libpng-dev libjpeg-dev libtiff-dev libgif-dev
  libopenvdb-dev libtbb-dev libboost-dev
)

# Qt's OpenGL classes are a package of their own on Debian 12, and part of qt6-base-dev later.
if grep -qs '^VERSION_CODENAME=bookworm' /etc/os-release; then tidemark_packages+=(libqt6opengl6-dev); fi

# Only tests need these: a screen that nobody sees, other readers and validators of DICOM, PACS servers, what makes and
# looks at the Debian package, a second compiler with its sanitizers and a linker, the reference compiler of shaders, what makes the
# handbook's HTML, a font for Chinese and Japanese, and schedulers of clusters.
tidemark_test_packages=(
  xvfb xauth locales python3-pydicom python3-numpy dicom3tools dcm2niix plastimatch orthanc orthanc-dicomweb dcmtk openssl
  dpkg-dev debhelper fakeroot file clang libclang-rt-dev lld glslang-tools python3-sphinx python3-myst-parser
  fonts-droid-fallback slurmctld slurmd slurm-client munge
)

# Only ./test --long needs these.
tidemark_long_test_packages=(clang-format clang-tidy python3-skimage nodejs snakemake)

# Only making packages (packaging/release.sh) and ./test --long need these: what is in the bundle beside libraries, what
# makes archives, packages and images, and systems in folders to try them in.
tidemark_package_packages=(
  qt6-translations-l10n qt6-wayland libgl1-mesa-dri libegl-mesa0 libglx-mesa0 fonts-dejavu-core fonts-dejavu-extra fonts-droid-fallback patchelf makeself xz-utils
  git debhelper fakeroot lintian desktop-file-utils appstream mmdebstrap imagemagick rpm umoci skopeo python3
)

# The packages of the list that are not installed, one a line.
tidemark_missing_packages() {
  local package
  for package in "${tidemark_packages[@]}"; do
    if [[ $(dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | head -n 1) != installed ]]; then
      echo "$package"
    fi
  done
}

# tidemark_install_dependencies [--tests | --long-tests | --packages]: installs what is missing. Where that cannot be done it says
# what is needed and goes on: the build finds out whether it is there all the same.
tidemark_install_dependencies() {
  if [[ ${1:-} == --* ]]; then tidemark_packages+=("${tidemark_test_packages[@]}"); fi
  if [[ ${1:-} == --long-tests ]]; then tidemark_packages+=("${tidemark_long_test_packages[@]}"); fi
  if [[ ${1:-} == --packages || ${1:-} == --long-tests ]]; then tidemark_packages+=("${tidemark_package_packages[@]}"); fi
  if ! command -v apt-get >/dev/null || ! command -v dpkg-query >/dev/null; then
    echo "This system has no apt. Tidemark needs what these Debian packages hold:"
    echo "  ${tidemark_packages[*]}"
    echo "Going on in case they are there (docs/5-dependencies.md has versions and purposes)."
    return 0
  fi

  local missing
  mapfile -t missing < <(tidemark_missing_packages)
  if ((${#missing[@]} == 0)); then
    return 0
  fi

  local -a as_root=(env)
  if ((EUID != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "These packages are missing, and without root or sudo they cannot be installed from here:"
      echo "  apt-get install --no-install-recommends ${missing[*]}"
      echo "Going on in case what they hold is there."
      return 0
    fi
    as_root=(sudo env)
  fi
  as_root+=(DEBIAN_FRONTEND=noninteractive)

  echo "Installing ${#missing[@]} packages: ${missing[*]}"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" apt-get install -y -q --no-install-recommends "${missing[@]}"
}
