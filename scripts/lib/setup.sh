#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# Makes a fresh Debian 12 ready and builds into build/. Says nothing and takes no time where nothing is to be done.
# Sourced by scripts/demo and scripts/test, or run by itself:  scripts/lib/setup.sh [target ...]
#
#   mpmInstall            installs what is missing of mpmPackages
#   mpmBuild [target...]  configures where needed and builds; mpmPreset=sanitize mpmBuild: the kernel with sanitizers, in build/sanitize
#   mpmSetup [target...]  both

mpmRoot=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
mpmBuildFolder=${YADE_MPM_BUILD:-$mpmRoot/build}

# Everything the project needs, and nothing that one of these brings along.
mpmPackages=(
	# YADE itself: the program, its Python part, its libraries
	yade python3-yade libyade
	# to build the plugin
	g++ cmake ninja-build libeigen3-dev libboost-python-dev libboost-serialization-dev libpython3.11-dev libvtk9-dev
	# tests and micro-benchmarks
	libgtest-dev libbenchmark-dev xvfb xauth
	# the manual
	python3-sphinx python3-myst-parser
	# the Python face, plots, STL files
	python3-numpy python3-matplotlib python3-vtk9
)

mpmFail() {
	echo "yade-mpm: $*" >&2
	return 1
}

mpmMissing() {
	local package status
	local -A installed=()
	while IFS=$'\t' read -r package status; do
		[ "$status" = installed ] && installed[${package%%:*}]=1
	done < <(dpkg-query -W -f '${Package}\t${db:Status-Status}\n' "${mpmPackages[@]}" 2>/dev/null)
	for package in "${mpmPackages[@]}"; do
		[ -n "${installed[$package]:-}" ] || echo "$package"
	done
}

mpmInstall() {
	local missing log
	command -v dpkg-query >/dev/null || { mpmFail "this needs Debian 12: there is no dpkg-query here"; return 1; }
	mapfile -t missing < <(mpmMissing)
	[ "${#missing[@]}" -gt 0 ] || return 0
	if [ "$(id -u)" != 0 ]; then
		mpmFail "these packages are missing: ${missing[*]}
Install them as root, then start this again:
    apt-get update && apt-get install --no-install-recommends ${missing[*]}"
		return 1
	fi
	echo "yade-mpm: installing ${missing[*]} (about a minute)" >&2
	log=$(mktemp)
	if ! DEBIAN_FRONTEND=noninteractive apt-get update -q >"$log" 2>&1 \
		|| ! DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1; then
		tail -n 15 "$log" >&2
		rm -f "$log"
		mpmFail "apt-get could not install ${missing[*]}: is this Debian 12, and is its package server reachable?"
		return 1
	fi
	rm -f "$log"
}

mpmBuild() {
	local folder=$mpmBuildFolder preset=${mpmPreset:-release} log target targets=()
	[ "$preset" = release ] || folder=$mpmBuildFolder/$preset
	log=$folder/setup.log
	for target in "$@"; do targets+=(--target "$target"); done
	mkdir -p "$folder"
	if [ ! -f "$folder/build.ninja" ]; then
		if ! (cd "$mpmRoot" && cmake --preset "$preset" -B "$folder") >"$log" 2>&1; then
			tail -n 30 "$log" >&2
			mpmFail "CMake failed; all it said is in $log"
			return 1
		fi
		echo "yade-mpm: building in $folder (some minutes the first time)" >&2
	fi
	if ! cmake --build "$folder" --parallel "${MPM_JOBS:-$(nproc)}" "${targets[@]}" >"$log" 2>&1; then
		grep -E -A4 'error|Error|FAILED|undefined reference' "$log" | head -n 40 >&2 || tail -n 30 "$log" >&2
		mpmFail "the build failed; all it said is in $log"
		return 1
	fi
}

mpmSetup() {
	mpmInstall && mpmBuild "$@"
}

if [ "${BASH_SOURCE[0]}" = "$0" ]; then
	set -euo pipefail
	mpmSetup "$@"
fi
