#!/usr/bin/env bash
# Installs the Debian packages that Duskline needs and that are missing, as root or with sudo.
#
# usage: tools/install_dependencies.sh [GROUP...]
#   build   to build the libraries and the programs
#   run     to run what uses OpenGL without a graphics card's own driver, too: Mesa's
#   test    to build and run the tests and benchmarks besides
#   check   to check format and names besides (clang-format and clang-tidy)
# Without a group: build, run and test.
set -euo pipefail

build=(g++ make cmake ninja-build pkg-config libtbb-dev libhwy-dev libgdal-dev libwebp-dev liberfa-dev
       libcli11-dev libfmt-dev nlohmann-json3-dev libepoxy-dev libegl-dev libglfw3-dev libimgui-dev libstb-dev)
run=(libegl1 libgl1-mesa-dri libopengl0)
test=(git python3 groff-base libgtest-dev libgmock-dev libbenchmark-dev gdal-bin proj-bin clang-format
      glslang-tools libglm-dev xvfb xauth xdotool)
check=(clang clang-format clang-tidy)

stop() {
    echo "install_dependencies: $1" >&2
    exit 1
}

wanted=()
[ $# -gt 0 ] || set -- build run test
for group in "$@"; do
    case $group in
    build) wanted+=("${build[@]}") ;;
    run) wanted+=("${run[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    check) wanted+=("${check[@]}") ;;
    *) stop "no group is called '$group'; there are: build, run, test, check" ;;
    esac
done

is_installed() {
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

command -v apt-get >/dev/null || stop "this is no Debian; install the counterparts of: ${wanted[*]}"
missing=()
for package in "${wanted[@]}"; do
    is_installed "$package" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || stop "run as root, or install sudo; missing packages: ${missing[*]}"
    as_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 "$@" >"$log" 2>&1
}

echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
# Old package lists name files that are gone, so they are renewed first; without a network the cache may do.
apt update || echo "install_dependencies: package lists not renewed: $(tail -n 1 "$log")" >&2
apt install --no-install-recommends "${missing[@]}" \
    || stop "apt-get could not install ${missing[*]}: $(grep '^E:' "$log" | head -n 1)"
