// Formats the results of `reflet bench --motions`: JSON, tables, strips of pictures.
#pragma once

#include "base/document.h"
#include "base/image_file.h"
#include "measure/bench/output.h"
#include "measure/motions/work.h"

#include <string>
#include <vector>

namespace reflet {

/// The keys are described in docs/bench.md.
std::string motionsJson(const BenchHead& head, const MotionsPlan& plan, const MotionsResult& result);

/// A table of all cases for each variant. Numbers beyond their target are emphasised.
std::vector<Section> motionsDocument(const BenchHead& head, const MotionsPlan& plan, const MotionsResult& result);

/// The pictures of one case: the reference in the first row, then a row for each variant; columns: stripFrames.
/// `which`: index into plan.cases.
Bitmap motionsStrip(const MotionsPlan& plan, const MotionsResult& result, size_t which);

}  // namespace reflet
