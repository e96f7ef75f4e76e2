#!/usr/bin/env bash
# Fetches Khronos' glTF-Validator for the tests only, by npm, into BUILD_FOLDER/gltf-validator; installs nothing else.
# On failure, prints why to standard error; the tests that need it are skipped then.
# usage: tests/gltf_validator.sh BUILD_FOLDER
set -euo pipefail

version=2.0.0-dev.3.10

giveUp() {
    echo "gltf_validator.sh: $1" >&2
    exit 1
}

(($# == 1)) || giveUp "usage: tests/gltf_validator.sh BUILD_FOLDER"
folder=$1/gltf-validator
if [[ "$(cat "$folder/version" 2>/dev/null || true)" == "$version" ]]; then
    exit 0
fi
for tool in node npm; do
    command -v "$tool" >/dev/null || giveUp "there is no $tool here"
done
mkdir -p "$folder"
npm install --prefix "$folder" --no-save --no-audit --no-fund --ignore-scripts --fetch-retries=0 \
    --fetch-timeout=20000 "gltf-validator@$version" >"$folder/npm.log" 2>&1 ||
    giveUp "npm cannot get gltf-validator $version, see $folder/npm.log"
echo "$version" >"$folder/version"
