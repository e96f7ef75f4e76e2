// Shaders of tests that record their own passes into frames.
#pragma once

#include "gpu/shader.h"

std::span<const reflet::gpu::EmbeddedShader> passTestShaders();

namespace reflet::test {

inline void registerPassTestShaders() {
    static const bool registered = (gpu::registerShaders(passTestShaders()), true);
    (void)registered;
}

}  // namespace reflet::test
