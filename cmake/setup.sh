#!/bin/sh
# sh cmake/setup.sh [package...]
# On Debian and Ubuntu: installs the compiler, CMake, Eigen and the packages named, as far as they are missing.
# On other systems it installs nothing.
set -eu

wanted="g++ cmake ninja-build libeigen3-dev $*"

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    echo "This is not a Debian or Ubuntu system: nothing is installed. A C++20 compiler, CMake 3.22 or newer and git" \
         "must be there; CMake fetches the libraries that it does not find."
    exit 0
fi

is_installed() {
    [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2> /dev/null)" = installed ]
}

missing=
for package in $wanted; do
    is_installed "$package" || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo > /dev/null; then
        echo "These packages are missing:$missing. Install them as root (apt-get install$missing), or install sudo," \
             "and try again." >&2
        exit 1
    fi
    as_root=sudo
fi

$as_root apt-get -q update || echo "The package lists could not be renewed; the ones at hand are used." >&2

available=
for package in $missing; do
    if [ -n "$(apt-cache madison "$package" 2> /dev/null)" ]; then
        available="$available $package"
    else
        echo "This system has no package $package; if it is a library, CMake fetches it with git." >&2
        is_installed git || available="$available git ca-certificates"
    fi
done
if [ -n "$available" ] && ! $as_root env DEBIAN_FRONTEND=noninteractive \
        apt-get -q install -y --no-install-recommends $available; then
    echo "apt-get could not install:$available. Its message above says why; nothing was built." >&2
    exit 1
fi
