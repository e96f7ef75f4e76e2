#!/usr/bin/env bash
# Installs what is missing, builds reflet, renders the built-in scenes to out/ and makes a page of them: out/index.html.
# A second run installs, builds and renders only what is missing or older than the program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

step() {  # text
    printf '\n[%d:%02d] %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$1"
}

cores=$(nproc)
fast=$(((250 / cores + 270 + 59) / 60)) # minutes, on a machine of our time that does nothing else
echo "Reflet's demo: packages, build, pictures. On a fresh machine with $cores cores $fast to $((2 * fast)) minutes, and less the next"
echo "time; it says how much is left once it has measured. Everything but the packages stays in this folder (build/, out/)."

step "1 of 3: packages that the build needs (apt; about a minute if they are missing)"
./setup.sh
step "2 of 3: build"
# Ninja's lines, and every 20 s how long the rest takes by the C++ files so far, which are most of the work.
showBuild() {  # C++ files; 0: unknown
    local line files=$1 made=0 start=$SECONDS next=$((SECONDS + 20))
    while IFS= read -r line; do
        printf '%s\n' "$line"
        [[ "$line" != *"Building CXX object"* ]] || made=$((made + 1))
        if ((files > made && made > 0 && SECONDS >= next)); then
            echo "demo.sh: $made of $files C++ files in $((SECONDS - start)) s: about $(((SECONDS - start) * (files - made) / made)) s left"
            next=$((SECONDS + 20))
        fi
    done
}
# The first time without the tests, which need more packages; a build that has them keeps them.
if [[ ! -f build/build.ninja ]]; then
    mkdir -p build
    cmake --preset release -DREFLET_TESTS=OFF >build/configure.log 2>&1 || { cat build/configure.log >&2; exit 1; }
fi
files=0
if [[ ! -f build/bin/reflet ]]; then
    files=$(ninja -C build -t commands reflet_program | grep -cE -- ' -c [^ ]+\.(cxx|cpp)$' || true)
fi
cmake --build --preset release --parallel "$cores" --target reflet_program | showBuild "$files"

step "3 of 3: pictures"
reflet=build/bin/reflet
mkdir -p out
cards=""

# Renders a picture unless there is one newer than the program, and adds it to the page. Work: what it takes in times of
# a still; spent and left are of those that are rendered.
spent=0
made=0
left=0
picture() {  # work, file, caption, arguments of reflet render...
    local work=$1 file=$2 caption=$3 start=$SECONDS
    shift 3
    left=$((left - work))
    if [[ "out/$file" -nt "$reflet" ]]; then
        echo "out/$file is up to date"
    else
        "$reflet" render "$@" --quiet -o "out/$file"
        spent=$((spent + SECONDS - start))
        made=$((made + work))
        echo "out/$file ($((SECONDS - start)) s); about $((left * spent / made)) s left"
    fi
    local command="reflet render $* -o $file"
    cards+="<figure><a href=\"$file\"><img src=\"$file\" alt=\"$caption\" loading=\"lazy\"></a>"
    cards+="<figcaption>$caption<code>$command</code></figcaption></figure>"$'\n'
}

# To a variable first: a failure within `for … in $(…)` would go unnoticed.
scenes=$("$reflet" list scenes | grep -v '^builtin:street ')
left=$((6 + $(wc -l <<<"$scenes") + 1 + 3))
echo "$(($(wc -l <<<"$scenes") + 3)) pictures; the first takes longest"
picture 6 first.png "First look: a wet street at night, a frame of the default preset" builtin:street --preset balanced --size 640x360
while read -r scene description; do
    picture 1 "${scene#builtin:}.png" "${scene#builtin:}: $description" "$scene" --size 480x270 --seconds 10
done <<<"$scenes"
picture 1 cave-direct.png "cave, direct light only: what indirect light adds is the difference" builtin:cave \
    --preset direct --size 480x270
picture 3 mirror-hall-hybrid.png "mirror-hall with planar reflections, ray tracing and probes where the screen has no data" \
    builtin:mirror-hall --preset hybrid --size 320x180

cat >out/index.html.part <<HTML
<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Reflet: built-in scenes</title>
<style>
body { margin: 2rem; background: #15171a; color: #dde; font: 16px/1.4 system-ui, sans-serif; }
main { display: grid; gap: 1.5rem; grid-template-columns: repeat(auto-fill, minmax(22rem, 1fr)); }
figure { margin: 0; } img { width: 100%; display: block; } code { display: block; color: #9ab; font-size: 12px; margin-top: .3rem; }
</style>
<h1>Reflet: built-in scenes</h1>
<p>Made by demo.sh with $("$reflet" --version) on $("$reflet" list devices | head -n 1 | sed 's/^[0-9]* *//'). A click shows a picture in full.</p>
<main>
$cards</main>
</html>
HTML
mv out/index.html.part out/index.html

step "done"
cat <<END
The pictures and a page of them: $PWD/out/index.html

Try next:
  $reflet view builtin:cave                                        # a window: turn the camera, change settings
  $reflet render YOUR.glb -o picture.png                           # your own glTF scene
  $reflet report builtin:cubes -o report --preset fast,balanced    # pictures, error against the reference, times
END
