#!/usr/bin/env bash
# Builds everything and runs every test. The last line says "N passed, N failed"; the exit status is 0 only if tests
# ran and none failed. Full output of each test program: build/test-logs/.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"

finish() {  # passed failed
    echo "$1 passed, $2 failed"
    exit "$(($1 == 0 || $2 > 0))"
}

build() {
    ./setup.sh --tests && cmake --preset release -DREFLET_TESTS=ON &&
        cmake --build --preset release --parallel "$(nproc)"
}
if ! build; then
    echo "test.sh: the build failed" >&2
    finish 0 1
fi
echo "built in $SECONDS s"

logs=build/test-logs
mkdir -p "$logs"
limit=1800 # seconds per test program; one that hangs has failed
passed=0
failed=0
skipped=0
failures=()

# A total from the head of a GoogleTest report.
total() {  # report key
    grep -m 1 "\"$2\":" "$1" | tr -dc '0-9'
}

runTests() {  # program [name filter]
    local name=${2-${1##*/}} filter=${3-*} status=0 start=$SECONDS ok bad
    local log="$logs/$name.log" report="$logs/$name.json"
    rm -f "$report"
    echo "== $name"
    # Shows everything but passed tests.
    timeout "$limit" "$1" "--gtest_filter=$filter" "--gtest_output=json:$report" 2>&1 | tee "$log" |
        { grep -avE '^\[( RUN      |       OK |----------|==========)\]|^Running main|^$' || true; } || status=$?
    local names
    names=$(sed -nE 's/^\[  FAILED  \] (.*) \([0-9]+ ms\)$/\1/p' "$log")
    [[ -z "$names" ]] || mapfile -t -O "${#failures[@]}" failures <<<"$names"
    if [[ -f "$report" ]]; then
        local skippedHere
        skippedHere=$(grep -c '"result": "SKIPPED"' "$report" || true)
        bad=$(total "$report" failures)
        ok=$(($(total "$report" tests) - bad - $(total "$report" disabled) - skippedHere))
        skipped=$((skipped + skippedHere))
    else # it did not finish
        ok=$(grep -ac '^\[       OK \]' "$log" || true)
        bad=$(grep -acE '^\[  FAILED  \] .* ms\)$' "$log" || true)
    fi
    if [[ ! -f "$report" ]] || ((status != 0 && bad == 0)); then
        local last
        last=$(sed -nE 's/^\[ RUN      \] //p' "$log" | tail -n 1)
        failures+=("$name ended with status $status, last in ${last:-no test}")
        bad=$((bad + 1))
    fi
    passed=$((passed + ok))
    failed=$((failed + bad))
    echo "$name: $ok passed, $bad failed, $((SECONDS - start)) s"
}

for program in build/bin/*_tests; do
    if [[ -x "$program" ]]; then
        runTests "$program"
    fi
done

# Tests that need ray query, if the installed driver does not support it.
if driver=$(tests/second_driver.sh build); then
    VK_DRIVER_FILES=$driver VK_ICD_FILENAMES=$driver runTests build/bin/pass_tests pass_tests_ray_query '*SceneRays*'
else
    echo "tests by ray query are skipped"
fi

((${#failures[@]} == 0)) || printf 'failed: %s\n' "${failures[@]}"
((skipped == 0)) || echo "$skipped skipped"
finish "$passed" "$failed"
