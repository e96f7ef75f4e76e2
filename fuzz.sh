#!/usr/bin/env bash
# Fuzzes every reader of input files in turn, MINUTES in all: ./fuzz.sh 10. Needs clang (with libFuzzer) and the packages
# of setup.sh. The folder build-fuzz/corpus keeps what was found to be interesting, so that the next run goes on from
# there; build-fuzz/findings has inputs that crash, hang (10 s) or take more than 2 GiB. A target's name as the second
# argument runs that one alone; it repeats a finding with build-fuzz/bin/fuzz_TARGET FILE.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
minutes=${1:?usage: ./fuzz.sh MINUTES [TARGET]}
targets=(gltf image view_file camera_path settings sequence_record saved_state)
if [ $# -gt 1 ]; then
    targets=("$2")
fi

cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target fuzz_seeds "${targets[@]/#/fuzz_}"
mkdir -p build-fuzz/findings
# The options of the sanitizers are for libraries, too: libFuzzer reports leaks of the last input at its end.
build-fuzz/bin/fuzz_seeds build-fuzz/seeds

failed=0
seconds=$((minutes * 60 / ${#targets[@]}))
for target in "${targets[@]}"; do
    mkdir -p "build-fuzz/corpus/$target"
    log="build-fuzz/findings/$target.log"
    # A lower limit of memory than the program's: what is charged must stay below what libFuzzer allows.
    if REFLET_MEMORY_LIMIT=0.5 "build-fuzz/bin/fuzz_$target" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 \
        -max_len=65536 -artifact_prefix="build-fuzz/findings/$target-" "build-fuzz/corpus/$target" \
        "build-fuzz/seeds/$target" >"$log" 2>&1; then
        echo "$target: nothing found; $(grep -o 'Done.*' "$log" || tail -n 1 "$log")"
    else
        echo "$target: FOUND, see $log"
        failed=1
    fi
done
exit "$failed"
