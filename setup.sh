#!/usr/bin/env bash
# Installs missing build dependencies through apt. With --tests: also those of the tests. Does nothing, and asks for
# nothing, if all are installed. Tried on Debian 12 and 13.
set -euo pipefail

needed=(
    "build-essential: C++ compiler"
    "cmake: build"
    "ninja-build: build"
    "pkg-config: finds libraries"
    "glslc: compiles shaders"
    "libvulkan-dev: Vulkan headers"
    "libvulkan1: Vulkan loader"
    "libvulkan-volk-dev: loads Vulkan's functions"
    "mesa-vulkan-drivers: Vulkan devices, one that runs on the CPU among them"
    "libspirv-cross-c-shared-dev: reflects shaders"
    "libglm-dev: vectors and matrices"
    "libtinygltf-dev: reads glTF"
    "libdraco-dev: decodes compressed meshes"
    "libmeshoptimizer-dev: decodes compressed meshes"
    "libwebp-dev: reads WebP, writes WebP animations"
    "libzstd-dev: reads compressed KTX 2"
    "libopenexr-dev: writes and reads EXR"
    "libspng-dev: reads and writes PNG"
    "libjpeg-dev: reads JPEG"
    "libxxhash-dev: hashes"
    "libstb-dev: draws letters into pictures"
    "libembree-dev: finds what rays hit, for the reference"
    "libtbb-dev: threads"
    "libcli11-dev: command line"
    "nlohmann-json3-dev: JSON"
    "libfmt-dev: text"
    "libglfw3-dev: windows"
    "libimgui-dev: the user interface in them"
    "fonts-dejavu-core: its letters"
)
neededByTests=(
    "libgtest-dev: tests"
    "chromium: opens the pages that reflet report writes"
    "xvfb: a desktop for tests of the window"
    "xdotool: its mouse and keys"
    "fuse3: a file system that fails"
    "libfuse3-dev: the same"
    "spirv-tools: checks compiled shaders"
    "python3-numpy: tests of the Python package"
    "vulkan-validationlayers: checks in tests that Vulkan is used as it wants to be"
)

case "${1-}" in
    "") ;;
    --tests) needed+=("${neededByTests[@]}") ;;
    *)
        echo "usage: ./setup.sh [--tests]" >&2
        exit 2
        ;;
esac

if ! command -v dpkg-query >/dev/null; then
    echo "setup.sh: this is not Debian or Ubuntu; install your system's counterparts of these packages: ${needed[*]%%:*}" >&2
    exit 0
fi

missing=()
for entry in "${needed[@]}"; do
    package=${entry%%:*}
    if ! dpkg-query -W -f '${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed; then
        missing+=("$package")
        echo "setup.sh: to install: $package (${entry#*: })"
    fi
done
if ((${#missing[@]} == 0)); then
    echo "setup.sh: all packages are installed"
    exit 0
fi

giveUp() {
    echo "setup.sh: $1; install these and try again: ${missing[*]}" >&2
    exit 1
}

command -v apt-get >/dev/null || giveUp "there is no apt-get"
asRoot=()
if ((EUID != 0)); then
    command -v sudo >/dev/null || giveUp "only root can install, and there is no sudo"
    asRoot=(sudo)
    [[ -t 0 ]] || asRoot+=(-n)
fi
apt() {
    "${asRoot[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 "$@"
}

# If updating the lists fails (no network, say), the install below may still work, or reports why not.
apt update || true

known=()
for package in "${missing[@]}"; do
    if apt-cache show "$package" >/dev/null 2>&1; then
        known+=("$package")
    else
        echo "setup.sh: apt does not know $package here; going on without it: CMake will tell if it is needed" >&2
    fi
done
if ((${#known[@]} == 0)); then
    giveUp "apt knows none of what is missing (is there a network?)"
fi
apt install -y --no-install-recommends "${known[@]}" || giveUp "apt-get could not install"
echo "setup.sh: installed ${#known[@]} packages"
