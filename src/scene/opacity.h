// Finds materials that are blended by name only.
#pragma once

#include "scene/scene.h"

namespace reflet {

/// Makes blended materials opaque whose alpha is 1 wherever they are used: factor, texture and vertex colours. Many
/// exporters write BLEND for everything; opaque surfaces cost less, and get shadows and indirect light at full quality.
void makeOpaqueWhereAlphaIsOne(Scene& scene);

}  // namespace reflet
