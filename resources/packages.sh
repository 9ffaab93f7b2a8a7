# SPDX-License-Identifier: BSD-3-Clause
# The Debian packages that Episcope needs, in one place. Sourced by run.sh and test.sh.

# What programs need that link the engine, too: the package libepiscope-dev depends on it.
LIBRARY_PACKAGES="libhdf5-dev libopencv-core-dev
  libopencv-imgproc-dev libopencv-imgcodecs-dev libopencv-ml-dev libopencv-calib3d-dev
  libopencv-features2d-dev libeigen3-dev libassimp-dev
  libpng-dev zlib1g-dev nlohmann-json3-dev libfmt-dev libmatio-dev liblzf-dev libboost-dev
  pkg-config libavfilter-dev libavformat-dev libavcodec-dev"
ENGINE_PACKAGES="g++ cmake ninja-build libcli11-dev $LIBRARY_PACKAGES"
WINDOW_PACKAGES="qt6-base-dev libqt6opengl6-dev qt6-svg-dev qt6-l10n-tools libvtk9-dev
  libgl1-mesa-dri"
WAYLAND_PACKAGES="qt6-wayland"
TEST_PACKAGES="ccache libbenchmark-dev libopencv-contrib-dev mkdocs xvfb xauth
  pybind11-dev python3-dev python3-numpy python3-pytest
  python3-h5py python3-h5netcdf python3-xarray python3-pandas python3-matplotlib
  hdf5-tools octave jq"
# What making the manual as web pages takes.
MANUAL_PACKAGES="mkdocs doxygen"
FUZZ_PACKAGES="clang libclang-rt-14-dev"
# What making and trying packages takes.
PACKAGING_PACKAGES="dpkg-dev librsvg2-bin lintian mmdebstrap desktop-file-utils appstream
  shared-mime-info man-db"

# install_missing PACKAGE…: installs those that are not installed yet; asks nothing and touches
# nothing if all are.
install_missing() {
  missing=""
  for package in "$@"; do
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing="$missing $package"
  done
  [ -n "$missing" ] || return 0
  as_root=""
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "These packages are missing, and there is no sudo to install them. As root, run:" >&2
      echo "  apt-get install --no-install-recommends$missing" >&2
      return 1
    fi
    as_root="sudo"
  fi
  echo "Installing:$missing"
  # The lists of a fresh container are empty, those of an old one name packages that are gone.
  $as_root apt-get update -qq
  # shellcheck disable=SC2086 # One word a package.
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends \
    $missing >/dev/null
}
