// A fictitious report: two scenes, three variants, and names that need escaping.
#pragma once

#include "measure/report/page.h"

#include <string>
#include <vector>

namespace reflet::test {

ReportPage sampleReport();

/// Names of all image files that a report refers to.
std::vector<std::string> pictureFiles(const ReportPage& page);

}  // namespace reflet::test
