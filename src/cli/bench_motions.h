// `reflet bench --motions`: faults in hard motion.
#pragma once

#include "cli/bench_options.h"
#include "measure/bench/output.h"
#include "measure/motions/work.h"

namespace reflet {

/// truth, variants: those of the command. Tries the output files. Throws UsageError.
MotionsPlan motionsPlan(const BenchCommand& command, TruthOptions truth, std::vector<Variant> variants);

/// Measures, prints tables and writes files.
void benchMotions(const BenchCommand& command, const MotionsPlan& plan, const BenchHead& head, gpu::Device& device);

}  // namespace reflet
