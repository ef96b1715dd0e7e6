# What the steps of CI share; each step sources this file. Works on a new Debian with Rust.
# shellcheck shell=bash
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Programs from PyPI, npm and crates.io, kept from run to run.
cache=${XDG_CACHE_HOME:-$HOME/.cache}/tatamu-ci
mkdir -p "$cache"
export PATH=$PATH:$cache/bin
# What is built here is built once, and debugged elsewhere.
export CARGO_INCREMENTAL=0 CARGO_PROFILE_DEV_DEBUG=none

# install_debian PACKAGE...
install_debian() {
    local as_root=()
    (($#)) || return 0
    ((EUID == 0)) || as_root=(sudo)
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends "$@"
}

# install_tools COMMAND:PACKAGE...: installs the Debian package of each command that is missing.
install_tools() {
    local missing=() tool
    for tool in "$@"; do
        command -v "${tool%%:*}" >/dev/null || missing+=("${tool#*:}")
    done
    install_debian "${missing[@]}"
}
