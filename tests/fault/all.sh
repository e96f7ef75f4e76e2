#!/usr/bin/env bash
# Makes many Vulkan calls and allocations fail, for render, bench, view and the library, and prints what came of it:
#   tests/fault/all.sh [N [FILTER]]
# N: calls of each function between the first and the last [3]: then it takes about half an hour of one core, where test.sh
# takes half a minute for one fault of each function. FILTER: as --gtest_filter, such as 'FaultyWindow.*'. Builds first.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cmake --preset release -DREFLET_TESTS=ON
cmake --build --preset release --target fault_tests
# Without LLVM's optimization most processes take a second.
export REFLET_FAULT_ALL=${1-3} GALLIVM_PERF=${GALLIVM_PERF-nopt} LP_NUM_THREADS=${LP_NUM_THREADS-1}
exec build/bin/fault_tests "--gtest_filter=${2-*}"
