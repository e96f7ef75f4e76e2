#!/usr/bin/env bash
# Downloads a second Vulkan driver for the tests only: the CPU driver of a newer Mesa, which supports ray query, from
# the backports of this Debian release. Prints the path of its ICD manifest (for VK_DRIVER_FILES); on failure, prints
# why to standard error. Installs nothing: everything stays in BUILD_FOLDER/second-driver.
# usage: tests/second_driver.sh BUILD_FOLDER
set -euo pipefail

giveUp() {
    echo "second_driver.sh: $1" >&2
    exit 1
}

(($# == 1)) || giveUp "usage: tests/second_driver.sh BUILD_FOLDER"
mkdir -p "$1/second-driver"
folder=$(cd "$1/second-driver" && pwd)
description=$folder/driver.json
if [[ -f "$description" ]]; then
    echo "$description"
    exit 0
fi
for tool in apt-get dpkg-deb ldd; do
    command -v "$tool" >/dev/null || giveUp "there is no $tool here"
done

# Backports are on the same server as the release, in another suite.
# shellcheck source=/dev/null
codename=$(. /etc/os-release && echo "${VERSION_CODENAME-}")
place=$(apt-get indextargets --format '$(RELEASE) $(COMPONENT) $(REPO_URI)' 'Created-By: Packages' |
    awk -v release="$codename" '$1 == release && $2 == "main" { print $3; exit }')
[[ -n "$codename" && -n "$place" ]] || giveUp "apt's sources do not name this machine's release"
keys=/usr/share/keyrings/debian-archive-keyring.gpg
[[ -f "$keys" ]] || giveUp "there is no $keys (Debian: debian-archive-keyring)"
echo "deb [signed-by=$keys] $place $codename-backports main" >"$folder/backports.list"

mkdir -p "$folder/lists/partial" "$folder/cache/archives/partial" "$folder/files"
log=$folder/apt.log
backports() {
    apt-get -q -o Dir::Etc::SourceList="$folder/backports.list" -o Dir::Etc::SourceParts=/dev/null \
        -o Dir::State::Lists="$folder/lists" -o Dir::Cache="$folder/cache" -o APT::Sandbox::User= \
        -o Acquire::Retries=2 -o Acquire::http::Timeout=30 "$@" >>"$log" 2>&1
}
: >"$log"
backports update -o APT::Update::Error-Mode=any || giveUp "no lists of $codename-backports, see $log"
(cd "$folder" && rm -f ./*.deb && backports -t "$codename-backports" download mesa-vulkan-drivers) ||
    giveUp "$codename-backports has no mesa-vulkan-drivers, see $log"
dpkg-deb -x "$folder"/mesa-vulkan-drivers_*.deb "$folder/files"

library=$(find "$folder/files" -name 'libvulkan_lvp.so' -print -quit)
original=$(find "$folder/files" -name 'lvp_icd*.json' -print -quit)
[[ -n "$library" && -n "$original" ]] || giveUp "mesa-vulkan-drivers of $codename-backports has no CPU driver"
lacking=$(ldd "$library" | sed -nE 's/^\s*(\S+) => not found$/\1/p' | tr '\n' ' ')
[[ -z "$lacking" ]] || giveUp "the driver of $codename-backports needs libraries that are not installed: $lacking"
sed -E "s#(\"library_path\": \")[^\"]*#\1$library#" "$original" >"$description.part"
mv "$description.part" "$description"
echo "$description"
