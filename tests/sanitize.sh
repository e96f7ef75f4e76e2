#!/usr/bin/env bash
# Builds with sanitizers, and runs tests:
#   tests/sanitize.sh address [FILTER]   every test with AddressSanitizer, LeakSanitizer and UndefinedBehaviorSanitizer
#   tests/sanitize.sh thread [FILTER]    what has threads (the window, jobs, the library) with ThreadSanitizer
# FILTER: as --gtest_filter. What other libraries leak belongs into tests/sanitize/leaks.txt, one by one. Logs, and the
# sanitizers' reports also of programs that tests start: build-sanitize/test-logs or build-thread/test-logs. The last
# line says "N passed, N failed"; a report is a failure.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
kind=${1-}
case $kind in
    address)
        build=build-sanitize preset=sanitize filter=${2-*}
        shards=(cli_tests:6 pass_tests:6 library_tests:2 fault_tests:2 shader_tests:2 reference_tests:1 unit_tests:2)
        ;;
    thread) # other programs have one thread, apart from the driver's
        build=build-thread preset=thread
        filter=${2-View.*:Monkey.*:Sequence.*:ReferenceSequence.*:*Threads*:Flip.*:Compare.*:ExrFile.*}
        shards=(cli_tests:4 library_tests:1 reference_tests:1 unit_tests:1)
        ;;
    *)
        echo "usage: tests/sanitize.sh address|thread [FILTER]" >&2
        exit 2
        ;;
esac
cores=$(nproc)
cmake --preset "$preset" -DREFLET_TESTS=ON -DREFLET_UNITY=ON -DREFLET_PRECOMPILE=ON
cmake --build --preset "$preset" --parallel "$cores" --target "${shards[@]%:*}"

logs=$PWD/$build/test-logs
rm -rf "$logs"
mkdir -p "$logs"
common=log_path=$logs/report:log_exe_name=1:exitcode=66
# Small blocks that llvmpipe aligns to pages would fill the default quarantine with gigabytes.
export ASAN_OPTIONS=$common:quarantine_size_mb=16:detect_leaks=1:detect_stack_use_after_return=0:allocator_may_return_null=1
export LSAN_OPTIONS=$common:suppressions=$PWD/tests/sanitize/leaks.txt:print_suppressions=0
export UBSAN_OPTIONS=$common:print_stacktrace=1
# The window, asked to end, does not wait for a thread that computes a frame: its thread "leaks".
export TSAN_OPTIONS=$common:report_thread_leaks=0:second_deadlock_stack=1:ignore_noninstrumented_modules=1
# As in test.sh.
export LP_NUM_THREADS=${LP_NUM_THREADS-1} GALLIVM_PERF=${GALLIVM_PERF-nopt}

run() {  # program shard shards
    local log=$logs/$1.$2.log start=$SECONDS status=0
    GTEST_TOTAL_SHARDS=$3 GTEST_SHARD_INDEX=$2 "$build/bin/$1" "--gtest_filter=$filter" >"$log" 2>&1 || status=$?
    echo "$((SECONDS - start))" >"$logs/$1.$2.seconds"
    # A report ends a program: the test that ran has failed. Leaks are reported after the last test.
    ((status == 0)) || grep -aq '^\[  FAILED  \]' "$log" ||
        echo "[  FAILED  ] status $status after $(sed -nE 's/^\[ RUN      \] //p' "$log" | tail -n 1) (0 ms)" >>"$log"
}
for shard in "${shards[@]}"; do
    for ((i = 0; i < ${shard#*:}; ++i)); do
        while (($(jobs -rp | wc -l) >= cores)); do
            wait -n || true
        done
        run "${shard%:*}" "$i" "${shard#*:}" &
    done
done
wait

passed=0
failed=0
for shard in "${shards[@]}"; do
    program=${shard%:*}
    lines=$(cat "$logs/$program".*.log)
    good=$(grep -ac '^\[       OK \]' <<<"$lines" || true)
    bad=$(grep -acE '^\[  FAILED  \] .* \([0-9]+ ms\)$' <<<"$lines" || true)
    skipped=$(grep -acE '^\[  SKIPPED \] .* \([0-9]+ ms\)$' <<<"$lines" || true)
    took=$(cat "$logs/$program".*.seconds | awk '{ s += $1 } END { print s }')
    echo "$program: $good passed, $bad failed, $skipped skipped, $took s of one core"
    sed -nE 's/^\[  FAILED  \] (.*) \([0-9]+ ms\)$/failed: \1/p' <<<"$lines"
    passed=$((passed + good))
    failed=$((failed + bad))
done
for report in "$logs"/report.*; do
    [[ -e "$report" ]] || continue
    echo "$report: $(grep -am 1 'ERROR: \|WARNING: \|runtime error: ' "$report")"
    failed=$((failed + 1))
done
echo "$passed passed, $failed failed"
exit "$((passed == 0 || failed > 0))"
