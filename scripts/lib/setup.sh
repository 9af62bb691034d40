#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
#
# Makes a fresh Debian 12 or 13 ready and builds into build/. Says nothing and takes no time where nothing is to be done.
# Sourced by scripts/demo and scripts/test, or run by itself:  scripts/lib/setup.sh [--yade PROGRAM] [--source TREE] [target ...]
#
#   mpmOptions "$@"       takes --yade and --source from a command line, leaves the rest in mpmRest
#   mpmInstall            installs what is missing of mpmPackages
#   mpmBuild [target...]  configures where needed and builds; mpmPreset=sanitize mpmBuild: the kernel with sanitizers, in build/sanitize
#   mpmSetup [target...]  both
#
# --yade PROGRAM builds for another YADE than the installed one, --source TREE against the headers of the tree that it was
# built from (default: the tree that the program names, where it is there). A build stays with its YADE until one is named anew.

mpmRoot=$(cd "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../.." && pwd)
mpmBuildFolder=${YADE_MPM_BUILD:-$mpmRoot/build}
mpmYade= mpmSource= mpmRest=()

# The releases whose packages have these names.
mpmReleases=(bookworm trixie forky sid)
mpmYadePackages=(yade python3-yade libyade)
# Everything else the project needs, and nothing that one of these brings along.
mpmPackages=(
	# to build the plugin
	g++ cmake ninja-build libeigen3-dev libboost-python-dev libboost-serialization-dev libpython3-dev libvtk9-dev
	# tests and micro-benchmarks
	libgtest-dev libbenchmark-dev xvfb xauth
	# the manual
	python3-sphinx python3-myst-parser
	# the Python face, plots, STL files, mpm.calibrate
	python3-numpy python3-matplotlib python3-vtk9 python3-scipy
)
# What YADE's own headers include beside that.
mpmSourcePackages=(libopenmpi-dev libboost-log-dev libboost-thread-dev libmpfr-dev libmpfrc++-dev libmpc-dev libgmp-dev)

mpmFail() {
	echo "yade-mpm: $*" >&2
	return 1
}

mpmOptions() {
	mpmRest=()
	while [ "$#" -gt 0 ]; do
		case $1 in
			--yade | --source)
				[ -n "${2:-}" ] || { mpmFail "$1 needs a path: --yade PROGRAM, --source TREE"; return 1; }
				if [ "$1" = --yade ]; then
					# a name without a slash is a command on PATH
					mpmYade=$(command -v -- "$2") || { mpmFail "there is no YADE program $2: name an executable file or a command with --yade"; return 1; }
					mpmYade=$(realpath -s -- "$mpmYade")
				else
					[ -d "$2" ] || { mpmFail "there is no folder $2: name the source tree of YADE with --source"; return 1; }
					mpmSource=$(realpath -- "$2")
				fi
				shift
				;;
			*) mpmRest+=("$1") ;;
		esac
		shift
	done
}

# Packages of the list that are not installed, one a line; those that dpkg has left half-way are followed by " partly".
mpmMissing() {
	local package status
	local -A found=()
	while IFS=$'\t' read -r package status; do
		found[${package%%:*}]=$status
	done < <(dpkg-query -W -f '${Package}\t${db:Status-Status}\n' "$@" 2>/dev/null)
	for package in "$@"; do
		case ${found[$package]:-} in
			installed) ;;
			half-installed | unpacked | half-configured | triggers-*) echo "$package partly" ;;
			*) echo "$package" ;;
		esac
	done
}

mpmInstall() {
	local missing partly log packages=("${mpmPackages[@]}") ID= VERSION_CODENAME= PRETTY_NAME="not Debian"
	# a YADE of one's own is not the packages'
	[ -n "$mpmYade" ] || packages=("${mpmYadePackages[@]}" "${packages[@]}")
	[ -z "$mpmYade$mpmSource" ] || packages+=("${mpmSourcePackages[@]}")
	[ ! -r "${MPM_OS_RELEASE:-/etc/os-release}" ] || . "${MPM_OS_RELEASE:-/etc/os-release}"
	if [ "$ID" != debian ] || ! command -v dpkg-query >/dev/null; then
		# what is missing there, CMake finds out
		[ -z "$mpmYade" ] || return 0
		mpmFail "this system is $PRETTY_NAME, and packages are installed on Debian 12 and 13 only: build or install YADE yourself and name it, $0 --yade PROGRAM [--source TREE]"
		return 1
	fi
	mapfile -t missing < <(mpmMissing "${packages[@]}")
	[ "${#missing[@]}" -gt 0 ] || return 0
	mapfile -t partly < <(printf '%s\n' "${missing[@]}" | sed -n 's/ partly$//p')
	if [ "${#partly[@]}" -gt 0 ]; then
		mpmFail "these packages are installed in part only: ${partly[*]}; finish that as root with: dpkg --configure -a && apt-get -f install"
		return 1
	fi
	if [[ " ${mpmReleases[*]} " != *" ${VERSION_CODENAME:-none} "* ]]; then
		mpmFail "this system is $PRETTY_NAME, and the package names are known for Debian 12 and 13 only; these or their like are missing: ${missing[*]}"
		return 1
	fi
	if [ "$(id -u)" != 0 ]; then
		mpmFail "these packages are missing: ${missing[*]}
Install them as root, then start this again:
    apt-get update && apt-get install --no-install-recommends ${missing[*]}"
		return 1
	fi
	echo "yade-mpm: installing ${missing[*]} (about a minute)" >&2
	log=$(mktemp)
	if ! DEBIAN_FRONTEND=noninteractive apt-get -o APT::Update::Error-Mode=any -q update >"$log" 2>&1; then
		grep -E '^[EW]:' "$log" | tail -n 3 >&2
		rm -f "$log"
		mpmFail "the package server cannot be reached (apt-get update failed): connect this machine to it, or install ${missing[*]} by other means"
		return 1
	fi
	if ! DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}" >>"$log" 2>&1; then
		tail -n 15 "$log" >&2
		rm -f "$log"
		mpmFail "apt-get could not install ${missing[*]}: see its message above"
		return 1
	fi
	rm -f "$log"
}

# CMake leaves the sentence here when it cannot build for this YADE (pkg/yade/CMakeLists.txt).
mpmRefused() {
	[ -s "$1/refusal" ] || return 1
	mpmFail "$(<"$1/refusal")" || true
}

mpmBuild() {
	local folder=$mpmBuildFolder preset=${mpmPreset:-release} log target targets=() options=()
	[ "$preset" = release ] || folder=$mpmBuildFolder/$preset
	log=$folder/setup.log
	for target in "$@"; do targets+=(--target "$target"); done
	mkdir -p "$folder"
	if [ "$preset" = release ]; then
		[ -z "$mpmYade" ] || options+=("-DYADE=$mpmYade")
		[ -z "$mpmYade$mpmSource" ] || options+=("-DYADE_SOURCE_DIR=$mpmSource")
	fi
	if [ ! -f "$folder/build.ninja" ] || [ "${#options[@]}" -gt 0 ]; then
		if ! (cd "$mpmRoot" && cmake --preset "$preset" -B "$folder" "${options[@]}") >"$log" 2>&1; then
			mpmRefused "$folder" && return 1
			tail -n 30 "$log" >&2
			mpmFail "CMake failed; all it said is in $log"
			return 1
		fi
		echo "yade-mpm: building in $folder (some minutes the first time)" >&2
	fi
	if ! cmake --build "$folder" --parallel "${MPM_JOBS:-$(nproc)}" "${targets[@]}" >"$log" 2>&1; then
		mpmRefused "$folder" && return 1
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
	mpmOptions "$@"
	mpmSetup "${mpmRest[@]}"
fi
