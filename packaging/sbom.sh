#!/usr/bin/env bash
# Writes a bill of materials (SBOM, SPDX 2.3, tag-value) of the Debian packages in a folder to standard output: the packages and their
# files with checksums, the packages that they need to run, and those that were compiled or linked into them, with licenses.
#   packaging/sbom.sh [FOLDER]    default: build-package/packages
# The same packages give the same text: SOURCE_DATE_EPOCH, or the time of the last commit, dates it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=${1-build-package/packages}
packages=("$folder"/*.deb)
[[ -e "${packages[0]}" ]] || { echo "sbom.sh: there are no packages in $folder; packaging/check.sh makes them" >&2; exit 1; }

# Headers and static libraries whose code is in the packages' files, where no shared library of theirs is needed to run.
# The test Sbom compares them with what the compiler read.
compiledLibrary=(libfmt-dev libglm-dev libvulkan-dev nlohmann-json3-dev)
compiledProgram=("${compiledLibrary[@]}" libcli11-dev libimath-dev libimgui-dev libvulkan-volk-dev)
epoch=${SOURCE_DATE_EPOCH-$(git log -1 --format=%ct 2>/dev/null || echo 0)}
version=$(dpkg-deb -f "${packages[0]}" Version)
id() { printf 'SPDXRef-%s' "${1//[^A-Za-z0-9.-]/-}"; }

cat <<HEAD
SPDXVersion: SPDX-2.3
DataLicense: CC0-1.0
SPDXID: SPDXRef-DOCUMENT
DocumentName: reflet-$version
DocumentNamespace: https://reflet.invalid/spdx/reflet-$version-$(cat "${packages[@]}" | sha256sum | cut -c1-16)
Creator: Tool: packaging/sbom.sh
Created: $(date -u -d "@$epoch" +%Y-%m-%dT%H:%M:%SZ)
HEAD

licenseOf() {  # a package of the distribution
    local source found
    source=$(dpkg-query -W -f '${source:Package}' "$1" 2>/dev/null || true)
    found=$(sed -n "s/^${source:-$1} //p" packaging/licenses.txt)
    echo "${found:-NOASSERTION}"
}

declare -A known=()
other() {  # a package of the distribution
    [[ -z ${known[$1]-} ]] || return 0
    known[$1]=1
    local found
    found=$(dpkg-query -W -f '${Version}' "$1" 2>/dev/null || true)
    printf '\nPackageName: %s\nSPDXID: %s\nPackageVersion: %s\nPackageDownloadLocation: NOASSERTION\nFilesAnalyzed: false\nPackageLicenseConcluded: NOASSERTION\nPackageLicenseDeclared: %s\nPackageCopyrightText: NOASSERTION\n' \
        "$1" "$(id "$1")" "${found:-NOASSERTION}" "$(licenseOf "$1")"
}

unpacked=$(mktemp -d)
trap 'rm -rf "$unpacked"' EXIT
for package in "${packages[@]}"; do
    name=$(dpkg-deb -f "$package" Package)
    known[$name]=1
    rm -rf "${unpacked:?}/files"
    dpkg-deb -x "$package" "$unpacked/files"
    mapfile -t files < <(cd "$unpacked/files" && find . -type f | LC_ALL=C sort)
    sums=$(for file in "${files[@]}"; do sha1sum "$unpacked/files/$file" | cut -c1-40; done | LC_ALL=C sort | tr -d '\n')
    printf '\nPackageName: %s\nSPDXID: %s\nPackageVersion: %s\nPackageFileName: %s\nPackageDownloadLocation: NOASSERTION\nFilesAnalyzed: true\nPackageVerificationCode: %s\nPackageChecksum: SHA256: %s\nPackageLicenseConcluded: MIT\nPackageLicenseInfoFromFiles: NOASSERTION\nPackageLicenseDeclared: MIT\nPackageCopyrightText: NOASSERTION\nRelationship: SPDXRef-DOCUMENT DESCRIBES %s\n' \
        "$name" "$(id "$name")" "$(dpkg-deb -f "$package" Version)" "$(basename "$package")" "$(printf '%s' "$sums" | sha1sum | cut -c1-40)" \
        "$(sha256sum "$package" | cut -c1-64)" "$(id "$name")"
    for file in "${files[@]}"; do
        printf '\nFileName: %s\nSPDXID: %s\nFileChecksum: SHA1: %s\nFileChecksum: SHA256: %s\nLicenseConcluded: NOASSERTION\nLicenseInfoInFile: NOASSERTION\nFileCopyrightText: NOASSERTION\n' \
            "$file" "$(id "$name-${file#./}")" "$(sha1sum "$unpacked/files/$file" | cut -c1-40)" "$(sha256sum "$unpacked/files/$file" | cut -c1-64)"
    done
done

for package in "${packages[@]}"; do
    name=$(dpkg-deb -f "$package" Package)
    # The first of alternatives, without versions.
    for needed in $(dpkg-deb -f "$package" Depends | tr ',' '\n' | sed 's/|.*//; s/(.*//; s/:any//; s/ //g'); do
        other "$needed"
        printf 'Relationship: %s DEPENDS_ON %s\n' "$(id "$name")" "$(id "$needed")"
    done
    case $name in
        reflet) compiled=("${compiledProgram[@]}") ;;
        libreflet?) compiled=("${compiledLibrary[@]}") ;;
        *) continue ;;
    esac
    for needed in "${compiled[@]}"; do
        other "$needed"
        printf 'Relationship: %s STATIC_LINK %s\n' "$(id "$name")" "$(id "$needed")"
    done
done
