#!/usr/bin/env bash
# Builds with sanitizers, and runs tests:
#   tests/sanitize.sh address [FILTER]   every test with AddressSanitizer, LeakSanitizer and UndefinedBehaviorSanitizer
#   tests/sanitize.sh thread [FILTER]    what has threads (the window, jobs, the library) with ThreadSanitizer
# FILTER: as --gtest_filter. What other libraries leak or share belongs into tests/sanitize/, one by one. Logs:
# build-sanitize/test-logs or build-thread/test-logs. The last line says "N passed, N failed".
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
kind=${1-}
case $kind in
    address) build=build-sanitize preset=sanitize filter=${2-*} ;;
    thread) build=build-thread preset=thread filter=${2-View.*:Monkey.*:Sequence.*:ReferenceSequence.*:*Threads*} ;;
    *)
        echo "usage: tests/sanitize.sh address|thread [FILTER]" >&2
        exit 2
        ;;
esac
cmake --preset "$preset" -DREFLET_TESTS=ON -DREFLET_UNITY=ON -DREFLET_PRECOMPILE=ON
cmake --build --preset "$preset" --parallel "$(nproc)"

export ASAN_OPTIONS=detect_leaks=1:detect_stack_use_after_return=0:allocator_may_return_null=1
export LSAN_OPTIONS=suppressions=$PWD/tests/sanitize/leaks.txt:print_suppressions=0
export UBSAN_OPTIONS=print_stacktrace=1
export TSAN_OPTIONS=suppressions=$PWD/tests/sanitize/threads.txt:halt_on_error=1:second_deadlock_stack=1
# As in test.sh.
export LP_NUM_THREADS=${LP_NUM_THREADS-1} GALLIVM_PERF=${GALLIVM_PERF-nopt}
logs=$build/test-logs
rm -rf "$logs"
mkdir -p "$logs"
run() {  # program shard shards
    GTEST_TOTAL_SHARDS=$3 GTEST_SHARD_INDEX=$2 "$build/bin/$1" "--gtest_filter=$filter" >"$logs/$1.$2.log" 2>&1 ||
        echo "$1, shard $2: status $?, see $logs/$1.$2.log"
}
for shard in cli_tests:4 pass_tests:6 library_tests:2 fault_tests:2 shader_tests:1 reference_tests:1 unit_tests:1; do
    for ((i = 0; i < ${shard#*:}; ++i)); do
        while (($(jobs -rp | wc -l) > $(nproc))); do
            wait -n || true
        done
        run "${shard%:*}" "$i" "${shard#*:}" &
    done
done
wait
passed=$(cat "$logs"/*.log | grep -ac '^\[       OK \]' || true)
mapfile -t failures < <(cat "$logs"/*.log | sed -nE 's/^\[  FAILED  \] (.*) \([0-9]+ ms\)$/\1/p')
# A report of a sanitizer ends a program: the test that ran has failed.
for log in "$logs"/*.log; do
    grep -aq '^\[  PASSED  \]\|^\[  FAILED  \]' "$log" ||
        failures+=("$(sed -nE 's/^\[ RUN      \] //p' "$log" | tail -n 1), which ended $(basename "$log" .log)")
done
((${#failures[@]} == 0)) || printf 'failed: %s\n' "${failures[@]}"
grep -ah 'ERROR: \(Address\|Leak\)Sanitizer\|runtime error:\|WARNING: ThreadSanitizer' "$logs"/*.log | sort | uniq -c || true
echo "$passed passed, ${#failures[@]} failed"
exit "$((passed == 0 || ${#failures[@]} > 0))"
