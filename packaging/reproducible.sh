#!/usr/bin/env bash
# Builds twice, from copies of the sources in folders of other names at other times, and compares byte by byte.
#   packaging/reproducible.sh [TARGET...]    default: reflet, the shared library, with everything it is made of
# Compares archives, shared libraries and generated sources (shaders, noise, presets), with the options of the packages.
# Needs no git. Prints what differs, status 1 then. REFLET_REPRODUCIBLE_FOLDER: where to work, kept afterwards.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
targets=("$@")
((${#targets[@]})) || targets=(reflet)
if [[ -n ${REFLET_REPRODUCIBLE_FOLDER-} ]]; then
    work=$(realpath -m "$REFLET_REPRODUCIBLE_FOLDER")
    mkdir -p "$work"
else
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
fi
copies=("$work/a" "$work/another folder/of a longer name")
built=(build made/elsewhere)

copy() {  # folder
    mkdir -p "$1"
    cp -r CMakeLists.txt cmake include src CHANGELOG.md LICENSE packaging "$1"
}
for copy in "${copies[@]}"; do
    copy "$copy"
done
find "${copies[1]}" -type f -exec touch -d '2001-02-03 04:05:06' {} +
for i in 0 1; do
    copy=${copies[i]}
    # No compiler cache: it would compare a file with itself. Another umask, time zone and language.
    (
        if [[ $i == 1 ]]; then
            umask 077
            export TZ=Asia/Tokyo LC_ALL=C.UTF-8
        fi
        export CCACHE_DISABLE=1
        cmake -S "$copy" -B "$copy/${built[i]}" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON -DREFLET_PACKAGE=ON \
            -DREFLET_PROGRAM="${REFLET_REPRODUCIBLE_PROGRAM-OFF}" -DREFLET_TESTS=OFF >"$work/log" 2>&1 &&
            cmake --build "$copy/${built[i]}" --parallel "${REFLET_JOBS-2}" --target "${targets[@]}" >>"$work/log" 2>&1
    ) || { tail -n 20 "$work/log" >&2; exit 1; }
done

list() { (cd "$1" && find . -type f \( -name '*.a' -o -name '*.so.*' -o -name '*.inc' -o -name '*.spv' -o -path './bin/*' \) | LC_ALL=C sort); }
first=${copies[0]}/${built[0]}
second=${copies[1]}/${built[1]}
[[ $(list "$first") == "$(list "$second")" ]] || { echo "reproducible.sh: the builds have other files" >&2; exit 1; }
compared=0
different=0
while read -r file; do
    compared=$((compared + 1))
    cmp -s "$first/$file" "$second/$file" || { echo "reproducible.sh: $file differs" >&2; different=1; }
    if LC_ALL=C grep -qaF "$work/" "$first/$file"; then
        echo "reproducible.sh: $file names the folder that it was built in" >&2
        different=1
    fi
done < <(list "$first")
((compared)) || { echo "reproducible.sh: nothing was built" >&2; exit 1; }
((different)) || echo "$compared files, the same bytes twice"
exit "$different"
