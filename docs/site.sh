#!/usr/bin/env bash
# Makes the documentation's site: out/site/index.html, which works from a folder and on any static host.
#   docs/site.sh [FOLDER [REPORT]]    FOLDER: default out/site; REPORT: folder of a page of `reflet report`, the gallery
# Needs mkdocs; with doxygen the reference of the API is in it (apt install mkdocs doxygen). See docs/site.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
site=$(realpath -m "${1-out/site}")
report=${2-out/accuracy}

command -v mkdocs >/dev/null || { echo "site.sh: there is no mkdocs: apt install mkdocs doxygen" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
gallery=()
[[ ! -f "$report/index.html" ]] || gallery=(--gallery)
doxygen=()
! command -v doxygen >/dev/null || doxygen=(--api)

python3 docs/site/pages.py "$work" "$site" "${gallery[@]}" "${doxygen[@]}"
mkdocs build --quiet --strict --config-file "$work/mkdocs.yml"
python3 docs/site/search_index.py "$site"
if ((${#doxygen[@]})); then
    cat >"$work/Doxyfile" <<END
PROJECT_NAME = Reflet
INPUT = include/reflet
OUTPUT_DIRECTORY = $site
HTML_OUTPUT = api
GENERATE_LATEX = NO
OPTIMIZE_OUTPUT_FOR_C = YES
JAVADOC_AUTOBRIEF = YES
MACRO_EXPANSION = YES
EXPAND_ONLY_PREDEF = YES
PREDEFINED = REFLET_API=
WARN_AS_ERROR = YES
QUIET = YES
HTML_TIMESTAMP = NO
HAVE_DOT = NO
END
    doxygen "$work/Doxyfile"
    # Doxygen's pages have scripts and styles in them; their search has frames, and evaluates strings.
    policy="default-src 'none'; script-src 'self' file: 'unsafe-inline' 'unsafe-eval'; \
style-src 'self' file: 'unsafe-inline'; img-src 'self' file: data:; frame-src 'self' file:; base-uri 'none'; form-action 'none'"
    find "$site/api" -name '*.html' -exec \
        sed -i "0,/<head>/s|<head>|<head><meta http-equiv=\"Content-Security-Policy\" content=\"$policy\"/>|" {} +
fi
if ((${#gallery[@]})); then
    cp -r "$report" "$site/gallery"
fi
rm -f "$site/sitemap.xml" "$site/sitemap.xml.gz"  # they have no address
echo "$site/index.html"
