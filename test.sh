#!/usr/bin/env bash
# Builds everything and runs every test. The last line says "N passed, N failed"; the exit status is 0 only if tests
# ran and none failed. Each test program runs as several processes, one more at a time than there are cores. Full
# output: build/test-logs/. Arguments filter the tests, as --gtest_filter does: ./test.sh 'Sweep.*'
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
filter=${1-*}

finish() {  # passed failed
    echo "$1 passed, $2 failed"
    exit "$(($1 == 0 || $2 > 0))"
}

cores=$(nproc)
build() {
    ./setup.sh --tests && cmake --preset release -DREFLET_TESTS=ON &&
        cmake --build --preset release --parallel "$cores"
}
if ! build; then
    echo "test.sh: the build failed" >&2
    finish 0 1
fi
tests/gltf_validator.sh build || echo "the test against glTF-Validator is skipped"
built=$SECONDS
jobs=$((cores + 1)) # tests of the window mostly wait
echo "built in $built s; now the tests, $jobs at a time"

logs=build/test-logs
rm -rf "$logs"
mkdir -p "$logs"
limit=1800 # seconds for one process; one that hangs has failed
passed=0
failed=0
skipped=0
failures=()
declare -A seconds=() good=() bad=()
# Shards run side by side: a driver that renders on the CPU gets its share of the cores.
export LP_NUM_THREADS=${LP_NUM_THREADS-1}
# Mesa's CPU driver compiles shaders without LLVM's optimization: tests compile much and render little.
export GALLIVM_PERF=${GALLIVM_PERF-nopt}
# That driver takes and returns much memory: huge pages that stay with the process halve the time that this takes.
glibc=glibc.malloc
export GLIBC_TUNABLES=${GLIBC_TUNABLES-$glibc.hugetlb=1:$glibc.top_pad=67108864:$glibc.trim_threshold=1000000000:$glibc.mmap_threshold=1000000000}

# A number from the head of a GoogleTest report, which holds the totals.
total() {  # report key
    grep -m 1 "\"$2\":" "$1" | tr -dc '0-9'
}

runShard() {  # name program filter shard shards
    local base=$logs/$1.$4 start=$SECONDS status=0
    [[ "$5" == 1 ]] || export GTEST_TOTAL_SHARDS=$5 GTEST_SHARD_INDEX=$4
    timeout "$limit" "$2" "--gtest_filter=$3" \
        "--gtest_output=json:$base.json" >"$base.log" 2>&1 || status=$?
    echo "$status $((SECONDS - start))" >"$base.status"
    # Shows all but what went well.
    grep -avE '^\[ *(RUN|OK|-+|=+|PASSED|SKIPPED) *\]|^Running main|^Note: |^ *$|^ *[0-9]+ FAILED|: Skipped$|^this device has no ray query$' "$base.log" || true
}

readShard() {  # name shard
    local base=$logs/$1.$2 status took ok failedHere skippedHere=0 names
    read -r status took <"$base.status"
    names=$(sed -nE 's/^\[  FAILED  \] (.*) \([0-9]+ ms\)$/\1/p' "$base.log")
    [[ -z "$names" ]] || mapfile -t -O "${#failures[@]}" failures <<<"$names"
    if [[ -f "$base.json" ]]; then
        skippedHere=$(grep -c '"result": "SKIPPED"' "$base.json" || true)
        failedHere=$(total "$base.json" failures)
        ok=$(($(total "$base.json" tests) - failedHere - $(total "$base.json" disabled) - skippedHere))
    else # it did not come to its end
        ok=$(grep -ac '^\[       OK \]' "$base.log" || true)
        failedHere=$(grep -acE '^\[  FAILED  \] .* ms\)$' "$base.log" || true)
    fi
    if [[ ! -f "$base.json" ]] || ((status != 0 && failedHere == 0)); then
        local last
        last=$(sed -nE 's/^\[ RUN      \] //p' "$base.log" | tail -n 1)
        failures+=("$1 ended with status $status, last in ${last:-no test}")
        failedHere=$((failedHere + 1))
    fi
    passed=$((passed + ok))
    failed=$((failed + failedHere))
    skipped=$((skipped + skippedHere))
    seconds[$1]=$((${seconds[$1]-0} + took))
    good[$1]=$((${good[$1]-0} + ok))
    bad[$1]=$((${bad[$1]-0} + failedHere))
}

shards=() # name program filter shard shards
addShards() {  # name program filter count
    local shard
    for ((shard = 0; shard < $4; ++shard)); do
        shards+=("$1 $2 $3 $shard $4")
    done
}
# One process with all tests that fit, so that tests which need the same pipelines share them. Mesa's cache of shaders
# on disk saves processes less than half of that time.
addGroup() {  # name program filter number
    shards+=("$1 $2 $3 $4 1")
}
# A program that runs another one with a Vulkan driver that is not the machine's.
withDriver() {  # manifest program name
    printf '#!/bin/sh\nVK_DRIVER_FILES=%q VK_ICD_FILENAMES=%q exec %q "$@"\n' "$1" "$1" "$PWD/build/bin/$2" >"build/$3"
    chmod +x "build/$3"
}
# The longest first.
if [[ "$filter" != "*" ]]; then
    addShards cli_tests build/bin/cli_tests "$filter" 4
    addShards pass_tests build/bin/pass_tests "$filter" 4
else
    # Of whole presets, which need the same pipelines; of one effect after the other; of many scenes and settings.
    presets='*SweepOfScene*:*Transients*:*LibraryPicture*:*SteadyState*:*PathTracing*:*Hybrid*:*SceneRays*:*TraceScene*:*ScaleMatrix*:*PictureSizes*'
    addGroup pass_tests build/bin/pass_tests "*-*/*:$presets" 0
    addShards cli_tests build/bin/cli_tests "$filter" 4
    addGroup pass_tests build/bin/pass_tests "$presets" 1
    addGroup pass_tests build/bin/pass_tests "*/*-$presets" 2
    # Some on another CPU driver than llvmpipe, which comes with Chromium: docs/devices.md says what differs there.
    swiftshader=/usr/lib/chromium/vk_swiftshader_icd.json
    if [[ -f "$swiftshader" ]]; then
        withDriver "$swiftshader" shader_tests shader_tests_swiftshader
        withDriver "$swiftshader" pass_tests pass_tests_swiftshader
        addShards shader_tests_swiftshader build/shader_tests_swiftshader \
            '-*CubeLobes*:*FarFewerSteps*:*upToTheBackFace*:CubeMaps.a*:CubeMaps.c*:CubeMaps.f*:Exposure.IsFinite*:Sampling.spreads*:Sampling.givesDirections*' 1
        addShards pass_tests_swiftshader build/pass_tests_swiftshader 'Direct.*:Pyramid*:Sweep.AnEmptyScene*' 1
    else
        echo "tests on SwiftShader are skipped: there is no $swiftshader (Debian: chromium)"
    fi
    # What needs ray query, where the machine's own driver has none. Its frames are small: most of the time is compiling.
    if driver=$(tests/second_driver.sh build); then
        withDriver "$driver" pass_tests pass_tests_ray_query
        addShards pass_tests_ray_query build/pass_tests_ray_query '*SceneRays*' 1
        # That driver keeps nothing, so that any memory that grows is ours.
        withDriver "$driver" fault_tests fault_tests_second_driver
        addShards fault_tests_second_driver build/fault_tests_second_driver 'LongRun*' 1
        ofFaults='-LongRun*'
    else
        echo "tests by ray query and on a newer driver are skipped"
    fi
fi
addShards library_tests build/bin/library_tests "$filter" 2
addShards fault_tests build/bin/fault_tests "${ofFaults-$filter}" 1
addShards shader_tests build/bin/shader_tests "$filter" 1
addShards reference_tests build/bin/reference_tests "$filter" 1
addShards unit_tests build/bin/unit_tests "$filter" 1
addShards gpu_compiler_tests build/bin/gpu_compiler_tests "$filter" 1

for shard in "${shards[@]}"; do
    while (($(jobs -rp | wc -l) >= jobs)); do
        wait -n || true
    done
    read -ra words <<<"$shard"
    runShard "${words[@]}" &
done
wait

for shard in "${shards[@]}"; do
    read -ra words <<<"$shard"
    readShard "${words[0]}" "${words[3]}"
done
for name in cli_tests pass_tests pass_tests_swiftshader pass_tests_ray_query library_tests \
    fault_tests fault_tests_second_driver shader_tests shader_tests_swiftshader reference_tests unit_tests gpu_compiler_tests; do
    [[ -z "${seconds[$name]-}" ]] || echo "$name: ${good[$name]} passed, ${bad[$name]} failed, ${seconds[$name]} s of one core"
done
# The Python package on a data set of the program.
python=$(command -v /usr/bin/python3 python3 | head -n 1)
if [[ "$filter" != "*" ]]; then
    :
elif [[ -n "$python" ]] && "$python" -c 'import numpy' 2>/dev/null; then
    start=$SECONDS
    REFLET_PROGRAM=$PWD/build/bin/reflet "$python" -m unittest discover -v -s python/tests >"$logs/python.log" 2>&1 || true
    went=$(grep -c '\.\.\. ok$' "$logs/python.log" || true)
    broke=$(grep -cE '\.\.\. (FAIL|ERROR)$|^ERROR: setUpClass' "$logs/python.log" || true)
    ((went > 0)) || broke=$((broke + 1))
    ((broke == 0)) || failures+=("python: see $logs/python.log")
    passed=$((passed + went))
    failed=$((failed + broke))
    echo "python: $went passed, $broke failed, $((SECONDS - start)) s"
else
    echo "tests of the Python package are skipped: there is no NumPy (Debian: python3-numpy)"
fi
# Other versions of clang-format format differently.
if [[ "$filter" == "*" ]] && clang-format --version 2>/dev/null | grep -q 'version 14\.' && git rev-parse HEAD >/dev/null 2>&1; then
    if git ls-files -z '*.cpp' '*.h' | xargs -0 clang-format --dry-run -Werror 2>"$logs/format.log"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        failures+=("clang-format would change files, see $logs/format.log")
    fi
else
    echo "not checked: the format (clang-format 14, a checkout, no filter)"
fi
# The sanitized build of the fuzz targets takes minutes, and so do they.
if [[ -n "${REFLET_FUZZ_SMOKE-}" ]]; then
    status=0
    ./fuzz.sh smoke | tee "$logs/fuzz.log" || status=$?
    passed=$((passed + $(grep -c ': nothing found' "$logs/fuzz.log" || true)))
    mapfile -t -O "${#failures[@]}" failures < <(grep ': FOUND' "$logs/fuzz.log")
    failed=$((failed + $(grep -c ': FOUND' "$logs/fuzz.log" || true)))
    if ((status != 0 && status != 3)) && ! grep -q ': FOUND' "$logs/fuzz.log"; then
        failures+=("fuzz.sh ended with status $status")
        failed=$((failed + 1))
    fi
else
    echo "not run: the fuzz targets under libFuzzer, 20 s each: REFLET_FUZZ_SMOKE=1 ./test.sh, or ./fuzz.sh smoke (clang)"
fi
echo "build $built s, tests $((SECONDS - built)) s, in all $SECONDS s"
((${#failures[@]} == 0)) || printf 'failed: %s\n' "${failures[@]}"
((skipped == 0)) || echo "$skipped skipped"
finish "$passed" "$failed"
