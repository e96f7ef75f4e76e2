// Writes the tables of a scene in the report's page, as HTML.
#pragma once

#include "measure/report/page.h"

#include <string>

namespace reflet {

/// A row for each variant: error against ground truth and visible-only, time. The best of each column is marked.
std::string errorTable(const ReportScene& scene);

/// A row for each pass, a column for each variant: milliseconds.
std::string passTable(const ReportScene& scene);

}  // namespace reflet
