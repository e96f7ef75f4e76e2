#!/usr/bin/env bash
# Makes many Vulkan calls and allocations fail, for render, bench, view and the library, and prints what came of it: takes
# an hour of one core or so, where test.sh takes half a minute for a few of them. Builds first.
# Arguments filter the tests, as --gtest_filter does: tests/fault/all.sh 'FaultyWindow.*'
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset release -DREFLET_TESTS=ON
cmake --build --preset release --target fault_tests
# Without LLVM's optimization most processes take a second.
export REFLET_FAULT_ALL=1 GALLIVM_PERF=${GALLIVM_PERF-nopt} LP_NUM_THREADS=${LP_NUM_THREADS-1}
exec build/bin/fault_tests "--gtest_filter=${1-*}"
