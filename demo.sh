#!/usr/bin/env bash
# Installs what is missing, builds reflet, renders the built-in scenes to out/ and makes a page of them: out/index.html.
# A second run installs, builds and renders only what is missing or older than the program.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

step() {  # text
    printf '\n[%d:%02d] %s\n' $((SECONDS / 60)) $((SECONDS % 60)) "$1"
}

cores=$(nproc)
echo "Reflet's demo: packages, build, pictures. On a fresh machine with $cores cores about $(((350 / cores + 365 + 59) / 60)) minutes,"
echo "less the next time. Everything but the packages stays in this folder (build/, out/)."

step "1 of 3: packages that the build needs (apt; about a minute if they are missing)"
./setup.sh
step "2 of 3: build (about $((250 / cores)) s the first time)"
# The first time without the tests, which need more packages; a build that has them keeps them.
if [[ ! -f build/build.ninja ]]; then
    mkdir -p build
    cmake --preset release -DREFLET_TESTS=OFF >build/configure.log 2>&1 || { cat build/configure.log >&2; exit 1; }
fi
cmake --build --preset release --parallel "$cores" --target reflet_program

step "3 of 3: pictures (about five minutes on two cores and no GPU)"
reflet=build/bin/reflet
mkdir -p out
cards=""

# Renders a picture unless there is one newer than the program, and adds it to the page.
picture() {  # file, caption, arguments of reflet render...
    local file=$1 caption=$2 start=$SECONDS
    shift 2
    if [[ "out/$file" -nt "$reflet" ]]; then
        echo "out/$file is up to date"
    else
        "$reflet" render "$@" -o "out/$file"
        echo "out/$file ($((SECONDS - start)) s)"
    fi
    local command="reflet render $* -o $file"
    cards+="<figure><a href=\"$file\"><img src=\"$file\" alt=\"$caption\" loading=\"lazy\"></a>"
    cards+="<figcaption>$caption<code>$command</code></figcaption></figure>"$'\n'
}

picture first.png "First look: a wet street at night, a frame of the default preset" builtin:street --preset balanced --size 640x360
# To a variable first: a failure within `for … in $(…)` would go unnoticed.
scenes=$("$reflet" list scenes)
while read -r scene description; do
    picture "${scene#builtin:}.png" "${scene#builtin:}: $description" "$scene" --size 480x270 --seconds 15
done <<<"$scenes"
picture cave-direct.png "cave, direct light only: what indirect light adds is the difference" builtin:cave \
    --preset direct --size 480x270
picture mirror-hall-hybrid.png "mirror-hall with planar reflections, ray tracing and probes where the screen has no data" \
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
