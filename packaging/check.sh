#!/usr/bin/env bash
# Makes the packages and tries them on a clean Debian: contents, lintian, installation, the program, the example in C.
#   packaging/check.sh [ROOT]    ROOT: folder for the clean system, made anew; without it, that part is left out
# The clean system needs root and debootstrap; it uses the package sources of this machine.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root=${1-}
built=build-package

cmake --preset package >/dev/null
cmake --build --preset package
rm -rf "$built/packages"
(cd "$built" && cpack -B packages)
packages=("$built"/packages/*.deb)
((${#packages[@]} == 4)) || { echo "check.sh: ${#packages[@]} packages, not 4" >&2; exit 1; }

expect() {  # package file...
    local package=$1 file list
    shift
    list=$(dpkg-deb --fsys-tarfile "$built"/packages/"$package"_*.deb | tar -t)
    for file; do
        grep -qE "^\./$file\$" <<<"$list" || { echo "check.sh: $package has no $file" >&2; exit 1; }
    done
}
lib=usr/lib/[^/]+
expect reflet usr/bin/reflet usr/share/man/man1/reflet.1.gz usr/share/bash-completion/completions/reflet \
    usr/share/applications/org.reflet.Reflet.desktop usr/share/icons/hicolor/scalable/apps/org.reflet.Reflet.svg \
    usr/share/metainfo/org.reflet.Reflet.metainfo.xml usr/share/doc/reflet/copyright
expect libreflet0 "$lib/libreflet.so.0" usr/share/doc/libreflet0/copyright
expect libreflet-dev usr/include/reflet/reflet.h "$lib/libreflet.so" "$lib/pkgconfig/reflet.pc" \
    "$lib/cmake/reflet/refletConfig.cmake"
expect python3-reflet usr/lib/python3/dist-packages/reflet/__init__.py usr/lib/python3/dist-packages/reflet/__main__.py \
    usr/share/doc/python3-reflet/copyright
packaging/hardened.sh full "$built/bin/reflet" "$(find "$built" -name 'libreflet.so.0' | head -n 1)" "$built"/libreflet_{base,scene,effects}.a
packaging/sbom.sh "$built/packages" >"$built/packages/reflet.spdx"
packaging/sbom_check.py "$built/packages/reflet.spdx" "$built/packages" "$built"
if command -v lintian >/dev/null; then
    lintian --fail-on error "${packages[@]}"
else
    echo "check.sh: lintian is not installed, and left out"
fi
[[ -n "$root" ]] || exit 0

release=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release)
source=$(apt-get indextargets --format '$(REPO_URI) $(RELEASE) $(COMPONENT)' | awk -v r="$release" '$2 == r && $3 == "main" { print $1; exit }')
rm -rf "$root"
debootstrap --variant=minbase "$release" "$root" "$source" >/dev/null
cp -a /etc/apt/. "$root/etc/apt/"
cp /etc/resolv.conf /etc/hosts "$root/etc/"
mkdir "$root/packages" "$root/example"
cp "${packages[@]}" "$root/packages/"
cp -r examples/c examples/common "$root/example/"
mount -t proc proc "$root/proc"
trap 'umount "$root/proc"' EXIT
inside() { chroot "$root" env DEBIAN_FRONTEND=noninteractive HOME=/root LC_ALL=C.UTF-8 sh -ec "$1"; }
inside 'apt-get -q update >/dev/null
    cd /packages && apt-get -qq install -y ./*.deb >/dev/null
    reflet --version
    reflet render builtin:cubes --size 64x36 -o /cubes.png
    test -s /cubes.png
    reflet reference builtin:cubes --size 64x36 --spp 4 -o /reference.png
    reflet dataset builtin:cubes -o /data --size 32x18 --frames 2 --spp 2 --noisy 1
    python3 -m reflet check /data'
inside 'apt-get -qq install -y --no-install-recommends cmake ninja-build gcc g++ glslc pkg-config >/dev/null
    cmake -S /example/c -B /built -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
    cmake --build /built >/dev/null
    /built/reflet_c_example /room.ppm 128 72 4
    ldd /built/reflet_c_example | grep libreflet.so.0
    printf "#include <reflet/reflet.h>\nint main(void) { return refletVersion() == REFLET_VERSION ? 0 : 1; }\n" >/use.c
    cc /use.c $(pkg-config --cflags --libs reflet) -o /use && /use
    apt-get -qq purge -y reflet python3-reflet libreflet0 libreflet-dev >/dev/null
    test -z "$(find /usr -name "*reflet*")"'
echo "the packages install, run, are built against and leave nothing behind on a clean $release"
