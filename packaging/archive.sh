#!/usr/bin/env bash
# Makes the source archive of a commit with its checksums; it builds without git.
#   packaging/archive.sh [COMMIT [FOLDER]]    default: HEAD, out/release
# Writes reflet-VERSION.tar.gz, reflet-VERSION.tar.xz and SHA256SUMS. The same commit gives the same bytes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
commit=${1-HEAD}
folder=${2-out/release}

version=$(git show "$commit:CMakeLists.txt" | sed -n 's/^project(reflet VERSION \([0-9.]*\) .*/\1/p')
[[ -n "$version" ]] || { echo "archive.sh: $commit has no version in CMakeLists.txt" >&2; exit 1; }
mkdir -p "$folder"
name=reflet-$version
git archive --format=tar --prefix="$name/" "$commit" >"$folder/$name.tar"
gzip -9 -n -k -f "$folder/$name.tar"  # -n: no name and no time in it
xz -9 -k -f -T1 "$folder/$name.tar"
rm "$folder/$name.tar"
(cd "$folder" && sha256sum "$name.tar.gz" "$name.tar.xz" >SHA256SUMS && cat SHA256SUMS)
