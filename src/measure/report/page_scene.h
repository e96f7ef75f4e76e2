// Writes a scene of the report's page, as HTML.
#pragma once

#include "measure/report/page.h"

#include <string>

namespace reflet {

/// `id`: the HTML id of the section.
std::string sceneSection(const ReportScene& scene, uvec2 size, const std::string& id);

}  // namespace reflet
