#!/usr/bin/env bash
# Fuzzes every reader of input files, and the C API, in turn, MINUTES in all: ./fuzz.sh 150. Needs clang (with libFuzzer) and the packages
# of setup.sh. A target's name as the second argument runs that one alone; `./fuzz.sh smoke` gives each 20 s. The folder
# build-fuzz/corpus keeps the smallest inputs that reach all code reached so far, so that the next run goes on from
# there; build-fuzz/findings has logs, and inputs that crash, hang or take more than 2 GiB. Repeat a finding with
# REFLET_MEMORY_LIMIT=0.05 build-fuzz/bin/fuzz_TARGET FILE. docs/fuzzing.md has more.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
minutes=${1:?usage: ./fuzz.sh MINUTES [TARGET], or ./fuzz.sh smoke [TARGET]}
targets=(gltf draco meshopt fingerprint png jpeg webp ktx2 hdr exr view_file camera_path settings sequence_record saved_state api)
if [ $# -gt 1 ]; then
    targets=("$2")
fi
if [ "$minutes" = smoke ]; then
    seconds=20
else
    seconds=$((minutes * 60 / ${#targets[@]}))
fi

probe='extern "C" int LLVMFuzzerTestOneInput(const unsigned char*, unsigned long) { return 0; }'
if ! clang++ -fsanitize=fuzzer -x c++ -o /dev/null - <<<"$probe" 2>/dev/null; then
    echo "fuzz.sh: needs clang++ with libFuzzer; on Debian: apt install clang" >&2
    exit 3
fi
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target fuzz_seeds "${targets[@]/#/fuzz_}" >build-fuzz/build.log 2>&1 || {
    tail -n 30 build-fuzz/build.log >&2
    exit 1
}
mkdir -p build-fuzz/findings
# The options of the sanitizers are for libraries, too: libFuzzer reports leaks of the last input at its end.
build-fuzz/bin/fuzz_seeds build-fuzz/seeds
# A lower limit of memory than the program's: what is charged must stay below what libFuzzer allows, and memory that is
# only claimed is slow with AddressSanitizer. So are long stacks of allocations, and libFuzzer's weights for inputs.
export REFLET_MEMORY_LIMIT=0.05 ASAN_OPTIONS=malloc_context_size=2:quarantine_size_mb=16
limits=(-timeout=25 -rss_limit_mb=2048 -entropic=0)

# Keeps of the corpus what reaches code that smaller inputs do not.
shrink() {  # target
    local corpus=build-fuzz/corpus/$1
    rm -rf "$corpus.new"
    mkdir -p "$corpus.new"
    if "build-fuzz/bin/fuzz_$1" -merge=1 -max_len=65536 "${limits[@]}" "$corpus.new" "$corpus" "build-fuzz/seeds/$1" \
        >"build-fuzz/findings/$1.merge.log" 2>&1; then
        rm -rf "$corpus"
        mv "$corpus.new" "$corpus"
    else
        rm -rf "$corpus.new"
    fi
}

failed=0
for target in "${targets[@]}"; do
    mkdir -p "build-fuzz/corpus/$target"
    log="build-fuzz/findings/$target.log"
    longest=65536
    [ "$target" != fingerprint ] || longest=256 # each line of it is a file to look for
    [ "$target" != api ] || longest=300 # a frame takes some 20 bytes, and milliseconds
    if "build-fuzz/bin/fuzz_$target" -max_total_time="$seconds" "${limits[@]}" -max_len="$longest" -print_final_stats=1 \
        -artifact_prefix="build-fuzz/findings/$target-" "build-fuzz/corpus/$target" "build-fuzz/seeds/$target" \
        >"$log" 2>&1; then
        [ "$minutes" = smoke ] || shrink "$target"
        coverage=$(grep -oE 'cov: [0-9]+ ft: [0-9]+' "$log" | tail -n 1)
        echo "$target: nothing found; $(grep -oE 'Done [0-9]+ runs in [0-9]+ second' "$log")s, $coverage," \
            "$(find "build-fuzz/corpus/$target" -type f | wc -l) inputs kept"
    else
        echo "$target: FOUND, see $log"
        failed=1
    fi
done
exit "$failed"
