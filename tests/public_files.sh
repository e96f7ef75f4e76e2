#!/usr/bin/env bash
# Renders every glTF file below a folder with no options, in presets and with the reference path tracer, and writes a
# table and a contact sheet. Not a test: the files are not in the repository. Needs a built program (./demo.sh), Python,
# and for the contact sheet ImageMagick's montage.
# usage: tests/public_files.sh FOLDER [-o OUT] [--size WxH] [--spp N] [--presets fast,balanced,…] [--match TEXT]
set -euo pipefail
exec python3 "$(dirname "${BASH_SOURCE[0]}")/public_files.py" "$@"
