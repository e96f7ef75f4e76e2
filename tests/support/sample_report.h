// A made-up report: two scenes, three variants, names that are as awkward as names can be.
#pragma once

#include "apps/report/page.h"

#include <string>
#include <vector>

namespace reflet::test {

ReportPage sampleReport();

/// Names of all picture files that a report refers to.
std::vector<std::string> pictureFiles(const ReportPage& page);

}  // namespace reflet::test
