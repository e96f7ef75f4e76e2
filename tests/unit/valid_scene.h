// Checks that a loaded scene keeps the promises of scene/scene.h.
#pragma once

#include "scene/scene.h"

namespace reflet::test {

/// All indices are in range, all numbers finite and all directions of unit length, at several times.
void expectValid(const Scene& scene);

}  // namespace reflet::test
